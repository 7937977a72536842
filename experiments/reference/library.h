// The references of runs with `reference = auto`: computed once, kept in the user's cache, shared by threads.
#pragma once

#include <atomic>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "experiments/reference/making.h"
#include "experiments/runs/references/made_reference.h"

namespace irk {

/// Thread-safe. Several processes may make the same reference at the same time; each then writes the same file.
class ReferenceLibrary {
 public:
  struct Options {
    int jobs = 1;  ///< threads, > 0
    const std::atomic<bool>* stop = nullptr;
    /// Called with one line for each reference that is made (not for those from the cache), never by two threads at
    /// once.
    std::function<void(const std::string& line)> tell = {};
    ReferenceLimits limits = {};
  };
  explicit ReferenceLibrary(Options options);

  /// The reference for the run; waits if another thread is making it.
  MadeReference of(const RunSpec& resolved);

  /// Makes the references that these runs need, each once, with progress on `out`. Runs that can never work are left
  /// out; they are refused when they are made.
  void prepare(const std::vector<RunSpec>& resolved, const std::string& label, std::ostream& out);

 private:
  struct Shelf {
    std::once_flag once;
    MadeReference reference;
    bool made = false;  // not read from the cache
  };
  Shelf& shelfOf(const ReferenceQuestion& question);
  const Shelf& fill(const ReferenceQuestion& question, int jobs);
  std::optional<ComputedReference> kept(const ReferenceQuestion& question);
  ComputedReference made(const ReferenceQuestion& question, int jobs);
  void keep(const ReferenceQuestion& question, const ComputedReference& reference);
  void tell(const std::string& line);

  Options options_;
  std::mutex mutex_;                                       // of the shelves and of what is told
  std::map<std::string, std::unique_ptr<Shelf>> shelves_;  // by keyText
  std::atomic<bool> cache_works_ = true;
};

}  // namespace irk
