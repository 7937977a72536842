#include <fmt/ostream.h>

#include <filesystem>
#include <vector>

#include "experiments/base/child_process.h"
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
  // The job may start in another folder.
  const auto results = std::filesystem::absolute(options.results).lexically_normal();
  const bool is_file = std::filesystem::is_regular_file(options.study);
  const std::string named =
      is_file ? std::filesystem::absolute(options.study).lexically_normal().string() : options.study;
  std::vector<std::string> flags{"--results", results};
  if (quick) flags.emplace_back("--quick");
  std::vector<std::string> run{"run", named}, merge{"merge", "--study", named};
  for (auto* words : {&run, &merge}) words->insert(words->end(), flags.begin(), flags.end());
  run.insert(run.end(), {"--shard", fmt::format("auto/{}", shards), "--jobs", std::to_string(options.jobs)});
  const auto folder = (results / (quick ? "quick" : "") / study.id / "").string();
  const std::string folders = shellWord(folder) + fmt::format("shard_*_of_{}", shards);  // the star is the shell's
  streams.out << slurmScript(study, programCommand(run), programCommand(merge) + " -- " + folders, shards,
                             options.jobs);
  return 0;
}

}  // namespace irk
