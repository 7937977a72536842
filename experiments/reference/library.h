// The references of runs with `reference = auto`: computed once, kept in the user's cache, shared by threads.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "experiments/reference/making.h"
#include "experiments/runs/references/made_reference.h"

namespace irk {

/// Thread-safe. Several processes may make the same reference at the same time; each then writes its file whole.
class ReferenceLibrary {
 public:
  struct Options {
    int jobs = 1;  ///< threads, > 0
    const std::atomic<bool>* stop = nullptr;
    /// Called with one line for each reference that is made (not for those from the cache), never by two threads at
    /// once.
    std::function<void(const std::string& line)> tell = {};
    /// Called now and then with what is being computed and its CPU time, and with an empty text before `tell` and when
    /// nothing is computed any more; never by two threads at once.
    std::function<void(const std::string& text)> show = {};
    ReferenceLimits limits = {};
  };
  explicit ReferenceLibrary(Options options);

  /// The reference for the run; waits if another thread is making it.
  MadeReference of(const RunSpec& resolved);

  /// Makes the references that these runs need, each once, those of one problem at several times together. Runs that
  /// can never work are left out; they are refused when they are made. `progress` replaces `show`.
  void prepare(const std::vector<RunSpec>& resolved, Progress* progress = nullptr);

 private:
  struct Shelf {
    std::once_flag once;
    std::atomic<bool> filled = false;
    MadeReference reference;
  };
  using Questions = std::vector<ReferenceQuestion>;
  Shelf& shelfOf(const ReferenceQuestion& question);
  static void fill(Shelf& shelf, const std::function<ComputedReference()>& find);
  bool isFilled(const ReferenceQuestion& question);
  std::optional<ComputedReference> kept(const ReferenceQuestion& question);
  std::vector<ComputedReference> made(const Questions& questions, int jobs, Progress* progress);
  void keep(const ReferenceQuestion& question, const ComputedReference& reference);
  void tell(const std::string& line);
  void show(const std::string& text, Progress* progress);

  Options options_;
  std::mutex mutex_;                                       // of the shelves and of what is told
  std::map<std::string, std::unique_ptr<Shelf>> shelves_;  // by keyText
  std::atomic<bool> cache_works_ = true;
};

}  // namespace irk
