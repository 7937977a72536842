#include <fmt/ostream.h>

#include "experiments/commands/commands.h"
#include "experiments/report/own_figures.h"
#include "experiments/runner/shards.h"
#include "experiments/study/study_reader.h"
#include "irk/misuse.h"

namespace irk {

int slurmCommand(const SlurmOptions& options, Streams streams) {
  const Study study = loadStudy(options.study, options.variant);
  (void)figuresOfStudy(study, options.study);  // its mistakes are found before the runs are made
  const int shards = static_cast<int>(parseInteger("n", options.shards, Range::integers(1, 1'000'000)));
  if (static_cast<std::size_t>(shards) > study.series.size()) {
    throw Misuse(fmt::format("n = {}: the study has {} series, and a series is not divided; 1 to {}", shards,
                             study.series.size(), study.series.size()));
  }
  const bool quick = options.variant == StudyVariant::kQuick;
  const std::string flags = (quick ? " --quick" : "") + (" --results " + options.results);
  const auto tree = std::filesystem::path(options.results) / (quick ? "quick" : "");
  const std::string folders = (tree / study.id / fmt::format("shard_*_of_{}", shards)).string();
  streams.out << slurmScript(study, "irk run " + options.study + flags,
                             "irk merge " + folders + " --study " + options.study + flags, shards, options.jobs);
  return 0;
}

}  // namespace irk
