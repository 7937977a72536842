#include "experiments/runner/status.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>
#include <string>

#include "core/base/input_file.h"
#include "experiments/commands/commands.h"
#include "experiments/report/own_figures.h"
#include "experiments/study/study_reader.h"

namespace irk {

int statusCommand(const RunOptions& options, Streams streams) {
  const Study study = loadStudy(options.study, options.variant, options.peers);
  (void)figuresOfStudy(study, options.study);  // its mistakes are found before the runs are made
  const auto folder = studyFolder(study, options.runner);
  const store::Store store(folder, study.id, store::Use::kRead, options.runner.store, streams.err);
  fmt::print(streams.out, "{} in {}\n{}", study.id, folder.string(), textOf(statusOf(study, options.runner, store)));
  if (store.runs().damaged() > 0) {
    fmt::print(streams.out, "  {} rows cannot be read: irk run sets them aside\n", store.runs().damaged());
  }
  requireRegularFile(folder / "lock");
  std::ifstream lock(folder / "lock");
  std::string host, process, date;
  if (lock >> host >> process >> date) {
    fmt::print(streams.out, "  process {} on {} writes there since {}\n", process, host, date);
  }
  return 0;
}

}  // namespace irk
