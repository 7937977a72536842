// Small studies, made for one test.
#pragma once

#include <sstream>
#include <string_view>

#include "experiments/runner.h"
#include "tests/experiments/support.h"

namespace irk {

struct StudyRuns {
  Study study;
  Table runs;
};

/// The study of a TOML text and its runs, made by two threads in a folder that is removed.
inline StudyRuns runsOf(std::string_view toml) {
  const TemporaryFolder folder;
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = 2;
  std::ostringstream quiet;
  StudyRuns made{parseStudy(toml, "small.toml", StudyVariant::kFull), {}};
  made.runs = runStudy(made.study, options, quiet);
  return made;
}

}  // namespace irk
