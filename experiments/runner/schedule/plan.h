// How a study would spread over many cores: a plan on paper from the stored times of its runs.
#pragma once

#include <string>

#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk {

/// The time that each number of workers needs for the accuracy runs, simulated by the schedule that makes them.
struct Plan {
  double seconds;  ///< of all runs on one worker
  struct Workers {
    int count;
    double seconds;
    double efficiency;  ///< the seconds of one worker over count * seconds
  };
  std::vector<Workers> workers;
};

/// Every run that counts needs a row.
Plan planOf(const Study& study, const store::RunKeys& keys, const store::Rows& rows, const std::vector<int>& workers);

/// One line.
std::string textOf(const Plan& plan);

}  // namespace irk
