// The comparison of two tables that are not in files.
#pragma once

#include <map>
#include <string>

#include "experiments/compare/compare.h"
#include "experiments/tables/table.h"
#include "tests/experiments/support.h"

namespace irk {

using Processors = std::map<std::string, std::string>;

inline compare::Comparison compared(const Table& first, const Table& second, const compare::Limits& limits,
                                    const Processors& of_first = {}, const Processors& of_second = {}) {
  const TemporaryFolder folder;
  const auto a = folder.path() / "first.csv", b = folder.path() / "second.csv";
  writeTable(a, first);
  writeTable(b, second);
  return compare::compareRuns({a, of_first}, {b, of_second}, limits);
}

}  // namespace irk
