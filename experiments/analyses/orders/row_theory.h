// The theoretical order of the system and method of a run's row.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "experiments/analyses/orders/theory.h"
#include "experiments/tables/table.h"
#include "irk/scene.h"

namespace irk {

struct Theory {
  double order = std::numeric_limits<double>::quiet_NaN();
  std::string source;
};

/// The sizes of the scene of a row.
Sizes sizesOf(const Table& runs, const TableRow& row);

/// The setting that makes the scene stiff: `-1e8`, or `-1e8/h` if the stiffness grows as the step shrinks.
std::string stiffnessText(const SceneEntry& scene, const std::string& settings);

/// The kind of the system of a row of runs.csv or orders.csv, whose scene is integrated with steps of about `h`;
/// nullopt if no theory treats it. `h` decides only whether a scene with a stiffness parameter counts as stiff.
std::optional<SystemKind> kindOf(const Table& table, const TableRow& row, double h);

/// The theoretical order. For a user's method it is the order that the tableau declares, for ordinary differential
/// equations only.
Theory theoryFor(const Table& runs, const TableRow& row, std::optional<SystemKind> kind, char component);

}  // namespace irk
