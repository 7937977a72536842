// Shared by the tests of the audit.
#pragma once

#include <gtest/gtest.h>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>

#include "experiments/commands/commands.h"
#include "experiments/runs/configurations.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/table.h"
#include "tests/experiments/study_runs.h"

namespace irk::audit {

// Parses the options of a command line and their values.
inline SolveOptions parsed(const std::string& command) {
  std::istringstream in(command);
  std::string irk, solve, option, value;
  SolveOptions options;
  in >> irk >> solve >> options.scene;
  EXPECT_EQ(irk + " " + solve, "irk solve");
  while (in >> option >> value) {
    std::string field = option.substr(2);
    std::replace(field.begin(), field.end(), '-', '_');
    if (field == kErrorBarKey) field = axisName<ErrorBarUse>();
    if (field == "set") {
      options.settings.push_back(value);
    } else if (field == "tol") {
      options.tol = value;
    } else {
      options.fields.emplace_back(field, value);
    }
  }
  return options;
}

// The states, or the error bars, of an exported states.csv by the keys of their runs.
inline std::map<std::string, Vec<double>> readStates(const std::filesystem::path& file, const char* column = "state") {
  std::map<std::string, Vec<double>> states;
  const Table table = readTable(file);
  for (const auto& row : table.rows) states[textAt(table, row, "key")] = parseVector(textAt(table, row, column));
  return states;
}

}  // namespace irk::audit
