// A small study whose runs are made and then timed.
#pragma once

#include <sstream>
#include <string>

#include "experiments/runner/timing.h"
#include "tests/experiments/study_runs.h"

namespace irk {

/// The runs of the study of a TOML text in a folder of their own, made when the object is.
struct TimedStudy {
  explicit TimedStudy(const std::string& toml) : study(parseStudy(toml, "small.toml", StudyVariant::kFull)) {
    options.results = folder.path();
    options.jobs = 1;
    made = runStudy(study, options, told);
  }
  store::Store open() { return {folder.path() / "small", study.id, store::Use::kWrite, {}, told}; }
  /// Times the runs and returns the exported table; `told` is what this says.
  Table time(const TimingShare& share = {}, const TimeCall& time_call = timeCall) {
    told.str("");
    store::Store store = open();
    const RunKeys keys = runKeys(study, options);
    timeStudy(study, keys, store, share, told, time_call);
    store.exportTables(keys);
    return readTable(store.folder() / "runs.csv");
  }

  TemporaryFolder folder;
  std::ostringstream told;
  Study study;
  RunnerOptions options;
  Table made;
};

}  // namespace irk
