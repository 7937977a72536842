#include "experiments/own/foreign/foreign_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "experiments/own/foreign/guarded.h"
#include "irk/misuse.h"
#include "irk/system_check.h"

namespace irk::own {
namespace {

// Of central differences: the cube root of the round-off balances it with the error of the formula.
const double kIncrement = std::cbrt(std::numeric_limits<double>::epsilon());
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Numbers of one thread: functions are called millions of times.
struct ThreadScratch {
  std::vector<double> moved, above, below, M;
  std::vector<double> jacobian, at, at_d;  // the Jacobian that was made last, and where
  std::uint64_t model = 0;                 // its model
};
ThreadScratch& scratch() {
  static thread_local ThreadScratch numbers;
  return numbers;
}

bool isZero(const double* values, std::size_t n) {
  return std::all_of(values, values + n, [](double x) { return x == 0; });
}

// (F(p + s direction) - F(p - s direction)) / (2 s).
template <class F>
void centralDifference(const F& evaluate, const double* point, std::size_t n, const double* direction, double s,
                       std::size_t rows, double* derivative) {
  ThreadScratch& own = scratch();
  own.moved.resize(n);
  own.above.resize(rows);
  own.below.resize(rows);
  const auto at = [&](double by, std::vector<double>& values) {
    for (std::size_t i = 0; i < n; ++i) own.moved[i] = point[i] + by * direction[i];
    evaluate(own.moved.data(), values.data());
  };
  at(s, own.above);
  at(-s, own.below);
  for (std::size_t i = 0; i < rows; ++i) derivative[i] = (own.above[i] - own.below[i]) / (2 * s);
}

struct Opening;
thread_local Opening* opening = nullptr;

/// As long as it exists, irk_scene_open is called on this thread.
struct Opening {
  explicit Opening(std::deque<irk_table>& opened) : tables(opened) { opening = this; }
  ~Opening() { opening = nullptr; }
  Opening(const Opening&) = delete;
  Opening& operator=(const Opening&) = delete;

  std::deque<irk_table>& tables;
  std::string refusal;  // why a table cannot be read
};

}  // namespace

// Calls irk_scene_open, which may open tables.
void ForeignModel::open(const ParameterValues& values) {
  GuardedText message("irk_scene_open");
  const Opening now(tables_);
  const int status = source_.open(values, &self_, message.data());
  if (status == 0 && now.refusal.empty()) return;
  const std::string why = now.refusal.empty() ? message.text() : now.refusal;
  throw Misuse(why.empty() ? "irk_scene_open refuses these parameters" : why);
}

ForeignModel::ForeignModel(const ForeignSource& source, const ParameterValues& values) : source_(source) {
  static std::atomic<std::uint64_t> count = 0;
  number_ = ++count;
  const auto guard = std::unique_lock(*source_.one_at_a_time);
  if (source_.open) open(values);
  kinks_ = detail::kinksSoFar<double>();
  try {
    readSizes();
    requireFunctions();
    readEntries();
  } catch (...) {
    if (functions().close) functions().close(self_);
    throw;
  }
  magnitudes_.assign(layout_.size(), 1);
}

void ForeignModel::readSizes() {
  irk_scene_sizes n{};
  functions().size(self_, &n);
  sizes_ = {
      .nu = n.nu, .nx = n.nx, .nz = n.nz, .constraints = n.constraints, .discrete = n.discrete, .switches = n.switches};
  outputs_ = n.outputs;
  times_ = n.times;
  algebraic_index_ = n.algebraic_index == 0 ? 1 : n.algebraic_index;
  concurrent_ = n.concurrent != 0;
  layout_ = {.y = sizes_.components(), .w = sizes_.nu + sizes_.nx};
}

ForeignModel::~ForeignModel() {
  const auto guard = lock();
  if (functions().close) functions().close(self_);
}

void ForeignModel::requireFunctions() const {
  const SceneFunctions& f = functions();
  requireSizes(sizes_, {.constraints = f.constraints != nullptr, .switching = f.switching != nullptr});
  constexpr int kMost = 1'000'000;
  if (outputs_ < 0 || outputs_ > kMost || times_ < 0 || times_ > kMost) {
    throw Misuse(fmt::format("irk_scene_size: outputs = {}, times = {}: 0 to {} is allowed", outputs_, times_, kMost));
  }
  if (algebraic_index_ < 1 || algebraic_index_ > 2) {
    throw Misuse(
        fmt::format("irk_scene_size: algebraic_index = {}: 1 or 2 is allowed (0 counts as 1); position "
                    "constraints, of index 3, come from irk_scene_constraints",
                    algebraic_index_));
  }
  const auto require = [](bool has, const std::string& because, const char* name) {
    if (!has) throw Misuse(because + ", but there is no function " + name);
  };
  require(sizes_.switches == 0 || f.on_switch, fmt::format("switches = {}", sizes_.switches), "irk_scene_on_switch");
  require(times_ == 0 || f.times, fmt::format("times = {}", times_), "irk_scene_times");
  require(outputs_ == 0 || f.outputs, fmt::format("outputs = {}", outputs_), "irk_scene_outputs");
}

void ForeignModel::readEntries() {
  if (!functions().entries) return;
  if (!functions().jacobian) throw Misuse("irk_scene_entries without irk_scene_jacobian: nothing fills its places");
  const int count = functions().entries(self_, nullptr, nullptr);
  const std::size_t most = rows() * columns();
  if (count < 0 || static_cast<std::size_t>(count) > most) {
    throw Misuse(fmt::format("irk_scene_entries returns {} entries; the Jacobian has {} rows and {} columns", count,
                             rows(), columns()));
  }
  entry_rows_.assign(static_cast<std::size_t>(count), -1);
  entry_columns_ = entry_rows_;
  functions().entries(self_, entry_rows_.data(), entry_columns_.data());
  for (std::size_t k = 0; k < entry_rows_.size(); ++k) {
    const int row = entry_rows_[k], column = entry_columns_[k];
    if (row >= 0 && static_cast<std::size_t>(row) < rows() && column >= 0 &&
        static_cast<std::size_t>(column) < columns()) {
      continue;
    }
    throw Misuse(fmt::format("irk_scene_entries: entry {} is at row {}, column {}: 0 to {} and 0 to {} are allowed", k,
                             row, column, rows() - 1, columns() - 1));
  }
}

bool ForeignModel::mass(const double* point, const double* d, double* M) const {
  const std::size_t n = rates();
  std::fill_n(M, n * n, 0.0);
  if (!functions().mass) {
    for (std::size_t i = 0; i < n; ++i) M[i * n + i] = 1;
    return true;
  }
  const auto guard = lock();
  return functions().mass(self_, point[0], layout_.yOf(point), d, M) == 0;
}

// Adds factor * M w to the rows of u'' and x'.
void ForeignModel::addMassTimes(double factor, const double* point, const double* d, const double* w,
                                double* rows) const {
  const std::size_t n = rates();
  if (!functions().mass) {
    for (std::size_t i = 0; i < n; ++i) rows[i] += factor * w[i];
    return;
  }
  std::vector<double>& M = scratch().M;
  M.resize(n * n);
  const bool done = mass(point, d, M.data());
  for (std::size_t j = 0; j < n; ++j) {
    const double by = done ? factor * w[j] : kNaN;
    for (std::size_t i = 0; i < n; ++i) rows[i] += M[j * n + i] * by;
  }
}

void ForeignModel::evaluate(const double* point, const double* d, double* rows) const {
  int status = 0;
  const double *const y = layout_.yOf(point), *const w = layout_.wOf(point);
  {
    const auto guard = lock();
    status = functions().rates ? functions().rates(self_, point[0], y, d, rows)
                               : functions().residual(self_, point[0], y, w, d, rows);
  }
  if (status != 0) {
    std::fill_n(rows, this->rows(), kNaN);
  } else if (functions().rates) {
    addMassTimes(-1, point, d, w, rows);
  }
}

double ForeignModel::increment(const double* point, const double* direction) const {
  double largest = 0;  // of the relative changes along the direction
  for (std::size_t i = 0; i < layout_.size(); ++i) {
    if (direction[i] == 0) continue;
    largest = std::max(largest, std::abs(direction[i]) / std::max(std::abs(point[i]) * (i > 0), magnitudes_[i]));
  }
  return largest > 0 ? kIncrement / largest : kIncrement;
}

void ForeignModel::difference(const double* point, const double* d, const double* direction, double* derivative) const {
  centralDifference([&](const double* at, double* out) { evaluate(at, d, out); }, point, layout_.size(), direction,
                    increment(point, direction), rows(), derivative);
}

const std::vector<double>& ForeignModel::jacobianAt(const double* point, const double* d) const {
  ThreadScratch& own = scratch();
  const auto count_d = static_cast<std::size_t>(sizes_.discrete);
  const auto same = [](const std::vector<double>& kept, const double* given, std::size_t n) {
    return kept.size() == n && (n == 0 || std::memcmp(kept.data(), given, n * sizeof(double)) == 0);
  };
  if (own.model == number_ && same(own.at, point, layout_.size()) && same(own.at_d, d, count_d)) return own.jacobian;
  own.model = 0;
  own.jacobian.assign(functions().entries ? entry_rows_.size() : rows() * columns(), 0);
  own.at.assign(point, point + layout_.size());
  own.at_d.assign(d, d + count_d);
  const auto guard = lock();
  const int status =
      functions().jacobian(self_, point[0], layout_.yOf(point), layout_.wOf(point), d, own.jacobian.data());
  if (status != 0) std::fill(own.jacobian.begin(), own.jacobian.end(), kNaN);
  own.model = number_;
  return own.jacobian;
}

// The part of (y, w) by the scene's own derivatives. Returns false if it has none.
bool ForeignModel::ownDerivative(const double* point, const double* d, const double* direction,
                                 double* derivative) const {
  const double* const along = direction + 1;
  if (functions().jacobian) {
    const std::vector<double>& J = jacobianAt(point, d);
    std::fill_n(derivative, rows(), 0.0);
    if (functions().entries) {
      for (std::size_t k = 0; k < J.size(); ++k) {
        derivative[entry_rows_[k]] += J[k] * along[entry_columns_[k]];
      }
    } else {
      for (std::size_t j = 0; j < columns(); ++j) {
        if (along[j] == 0) continue;
        for (std::size_t i = 0; i < rows(); ++i) derivative[i] += J[j * rows() + i] * along[j];
      }
    }
  } else if (functions().product) {
    const auto guard = lock();
    const double* const dw = functions().rates ? nullptr : layout_.wOf(direction);
    const int status = functions().product(self_, point[0], layout_.yOf(point), layout_.wOf(point), d,
                                           layout_.yOf(direction), dw, derivative);
    if (status != 0) std::fill_n(derivative, rows(), kNaN);
  } else {
    return false;
  }
  if (functions().rates) addMassTimes(-1, point, d, layout_.wOf(direction), derivative);
  return true;
}

void ForeignModel::differentiate(const double* point, const double* d, const double* direction,
                                 double* derivative) const {
  const bool moves_t = direction[0] != 0;
  if (functions().rates && !moves_t && isZero(layout_.yOf(direction), static_cast<std::size_t>(layout_.y))) {
    std::fill_n(derivative, rows(), 0.0);
    addMassTimes(-1, point, d, layout_.wOf(direction), derivative);
    return;
  }
  if (!ownDerivative(point, d, direction, derivative)) {
    difference(point, d, direction, derivative);
  } else if (moves_t) {
    std::vector<double> in_time(layout_.size(), 0), part(rows());
    in_time[0] = direction[0];
    difference(point, d, in_time.data(), part.data());
    for (std::size_t i = 0; i < rows(); ++i) derivative[i] += part[i];
  }
}

void ForeignModel::constraints(int level, const double* point, double* g) const {
  const auto guard = lock();
  const int status = functions().constraints(self_, level, point[0], layout_.yOf(point), layout_.wOf(point), g);
  if (status != 0) std::fill_n(g, sizes_.constraints, kNaN);
}

void ForeignModel::differentiateConstraints(int level, const double* point, const double* direction,
                                            double* derivative) const {
  centralDifference([&](const double* at, double* out) { constraints(level, at, out); }, point, layout_.size(),
                    direction, increment(point, direction), static_cast<std::size_t>(sizes_.constraints), derivative);
}

}  // namespace irk::own

// Exceptions must not pass through code in C.
extern "C" const irk_table* irk_table_open(const char* file, const char* t, const char* y, int cubic) {
  using namespace irk;
  if (!own::opening) return nullptr;
  try {
    const auto by = cubic != 0 ? Interpolation::kCubic : Interpolation::kLinear;
    return &own::opening->tables.emplace_back(irk_table{TimeTable<double>(file, t, y, by)});
  } catch (const std::exception& error) {
    own::opening->refusal = error.what();
    return nullptr;
  }
}

extern "C" double irk_table_value(const irk_table* table, double t) { return table->table(t); }
