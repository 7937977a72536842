// One scene behind irk/scene_c.h with values of its parameters: its sizes, and its rows with their derivatives.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "experiments/own/foreign/scene_functions.h"
#include "irk/system.h"

struct irk_table {
  irk::TimeTable<double> table;
};

namespace irk::own {

/// The arguments of all functions in one array: t, y = (u, v, x, z), w = (a, k).
struct PointLayout {
  Index y = 0, w = 0;  ///< their numbers

  std::size_t size() const { return static_cast<std::size_t>(1 + y + w); }
  const double* yOf(const double* point) const { return point + 1; }
  const double* wOf(const double* point) const { return point + 1 + y; }
};

/// Immutable; may be shared by threads: calls wait for each other unless the scene is concurrent.
class ForeignModel {
 public:
  /// Opens the scene. Throws Misuse where it says that it cannot be made, and for sizes that cannot be.
  ForeignModel(const ForeignSource& source, const ParameterValues& values);
  ~ForeignModel();
  ForeignModel(const ForeignModel&) = delete;
  ForeignModel& operator=(const ForeignModel&) = delete;

  const ForeignSource& source() const { return source_; }
  const SceneFunctions& functions() const { return source_.functions; }
  void* self() const { return self_; }
  const Sizes& sizes() const { return sizes_; }
  int outputs() const { return outputs_; }
  int timesCount() const { return times_; }
  /// Of its tables and of those among its parameters, ascending.
  const std::vector<double>& kinks() const { return kinks_; }
  int algebraicIndex() const { return algebraic_index_; }
  const PointLayout& layout() const { return layout_; }
  /// Of the rows besides those of position constraints.
  std::size_t rows() const { return static_cast<std::size_t>(sizes_.n() - sizes_.constraints); }
  /// Columns of the scene's own Jacobian: y, or (y, w) for irk_scene_residual.
  std::size_t columns() const { return layout_.size() - 1 - (functions().rates ? rates() : 0); }
  /// Numbers of w.
  std::size_t rates() const { return static_cast<std::size_t>(layout_.w); }
  const std::vector<int>& entryRows() const { return entry_rows_; }
  bool hasDerivatives() const { return functions().jacobian || functions().product; }
  std::unique_lock<std::mutex> lock() const {
    return concurrent_ ? std::unique_lock<std::mutex>() : std::unique_lock(*source_.one_at_a_time);
  }

  /// Magnitudes of t, y, w, from which the increments of differences follow.
  void setMagnitudes(std::vector<double> magnitudes) { magnitudes_ = std::move(magnitudes); }

  /// Writes the rows at a point. Those that cannot be computed are NaN.
  void evaluate(const double* point, const double* d, double* rows) const;
  /// Writes the derivative of the rows along `direction`, which has the layout of a point.
  void differentiate(const double* point, const double* d, const double* direction, double* derivative) const;
  /// g, dg/dt or d2g/dt2 for level 0, 1, 2.
  void constraints(int level, const double* point, double* g) const;
  void differentiateConstraints(int level, const double* point, const double* direction, double* derivative) const;
  /// The derivative along `direction` by central differences only.
  void difference(const double* point, const double* d, const double* direction, double* derivative) const;
  /// Writes M: all zero before, the identity without irk_scene_mass. Returns whether it could be computed.
  bool mass(const double* point, const double* d, double* M) const;

 private:
  void open(const ParameterValues& values);
  void readSizes();
  void requireFunctions() const;
  void readEntries();
  double increment(const double* point, const double* direction) const;
  void addMassTimes(double factor, const double* point, const double* d, const double* w, double* rows) const;
  bool ownDerivative(const double* point, const double* d, const double* direction, double* derivative) const;
  const std::vector<double>& jacobianAt(const double* point, const double* d) const;

  ForeignSource source_;
  void* self_ = nullptr;
  std::deque<irk_table> tables_;  // which irk_scene_open has opened
  std::vector<double> kinks_;
  Sizes sizes_;
  int outputs_ = 0, times_ = 0, algebraic_index_ = 1;
  bool concurrent_ = false;
  PointLayout layout_;
  std::vector<int> entry_rows_, entry_columns_;
  std::vector<double> magnitudes_;
  std::uint64_t number_;  // of this object, for what threads keep
};

}  // namespace irk::own
