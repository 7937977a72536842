#include "experiments/own/foreign/foreign_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/own/foreign/guarded.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

class FunctionCheck {
 public:
  FunctionCheck(const ForeignModel& model, const std::vector<double>& point, const std::vector<double>& d)
      : model_(model), point_(point), d_(d), at_(point), at_d_(d) {}

  void run() {
    const SceneFunctions& f = model_.functions();
    const std::size_t rates = model_.rates();
    const Sizes& n = model_.sizes();
    if (f.rates) {
      written("irk_scene_rates", "f", model_.rows(), [&](double* to) { f.rates(self(), t(), y(), d(), to); });
    } else {
      written("irk_scene_residual", "r", model_.rows(),
              [&](double* to) { f.residual(self(), t(), y(), w(), d(), to); });
    }
    if (f.mass) inside("irk_scene_mass", "M", rates * rates, [&](double* to) { f.mass(self(), t(), y(), d(), to); });
    for (int level = 0; n.constraints > 0 && level <= 2; ++level) {
      written(fmt::format("irk_scene_constraints, level {},", level), "g", size(n.constraints),
              [&](double* to) { f.constraints(self(), level, t(), y(), w(), to); });
    }
    if (n.switches > 0) {
      written("irk_scene_switching", "g", size(n.switches),
              [&](double* to) { f.switching(self(), t(), y(), w(), d(), to); });
    }
    if (model_.outputs() > 0) {
      written("irk_scene_outputs", "values", size(model_.outputs()),
              [&](double* to) { f.outputs(self(), t(), y(), w(), d(), to); });
    }
    derivatives();
  }

 private:
  static std::size_t size(Index n) { return static_cast<std::size_t>(n); }
  void* self() const { return model_.self(); }
  double t() const { return point_[0]; }
  const double* y() const { return model_.layout().yOf(point_.data()); }
  const double* w() const { return model_.layout().wOf(point_.data()); }
  const double* d() const { return d_.data(); }

  template <class Call>
  void written(const std::string& function, const char* name, std::size_t n, const Call& call) {
    GuardedNumbers numbers(function, name, n);
    called(function, numbers, call);
    numbers.requireWritten();
  }
  template <class Call>
  void inside(const std::string& function, const char* name, std::size_t n, const Call& call) {
    const std::vector<double> zeros(n, 0);
    GuardedNumbers numbers(function, name, n, zeros);
    called(function, numbers, call);
  }
  template <class Call>
  void called(const std::string& function, GuardedNumbers& numbers, const Call& call) {
    {
      const auto guard = model_.lock();
      call(numbers.data());
    }
    numbers.requireInside();
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    if (std::equal(point_.begin(), point_.end(), at_.begin(), same) &&
        std::equal(d_.begin(), d_.end(), at_d_.begin(), same)) {
      return;
    }
    throw Misuse(function + " changes y, w or d, which it may only read");
  }

  void derivatives() {
    const SceneFunctions& f = model_.functions();
    if (!model_.hasDerivatives()) return;
    std::vector<double> along(point_.size(), 0);
    for (std::size_t i = 1; i < along.size(); ++i) along[i] = 0.5 + std::fmod(0.618033988749895 * double(i), 1.0);
    if (f.jacobian) {
      const std::size_t n = f.entries ? model_.entryRows().size() : model_.rows() * model_.columns();
      inside("irk_scene_jacobian", "J", n, [&](double* to) { f.jacobian(self(), t(), y(), w(), d(), to); });
    } else {
      const double *const dy = along.data() + 1, *const dw = f.rates ? nullptr : model_.layout().wOf(along.data());
      written("irk_scene_product", "dr", model_.rows(),
              [&](double* to) { f.product(self(), t(), y(), w(), d(), dy, dw, to); });
    }
    compareDerivatives();
  }

  // Each column of the Jacobian beside differences, a little beside the start: at the start itself a derivative may be
  // that of a kink.
  void compareDerivatives() {
    constexpr double kBeside = 1e-3, kTolerance = 1e-3;
    constexpr std::size_t kMostColumns = 500;
    std::vector<double> near = point_;
    for (std::size_t i = 1; i < near.size(); ++i)
      near[i] += kBeside * (1 + std::abs(near[i])) * (0.7 + 0.1 * double(i % 5));
    const std::size_t rows = model_.rows(), columns = std::min(model_.columns(), kMostColumns);
    std::vector<double> direction(near.size(), 0), own(rows), differences(rows), value(rows);
    model_.evaluate(near.data(), d(), value.data());
    for (std::size_t j = 0; j < columns; ++j) {
      direction[1 + j] = 1;
      model_.differentiate(near.data(), d(), direction.data(), own.data());
      model_.difference(near.data(), d(), direction.data(), differences.data());
      direction[1 + j] = 0;
      for (std::size_t i = 0; i < rows; ++i) {
        const double noise = 1e-9 * std::abs(value[i]) / (1e-3 + std::abs(near[1 + j]));
        const double allowed = kTolerance * (std::abs(own[i]) + std::abs(differences[i])) + noise + 1e-7;
        if (!(std::abs(own[i] - differences[i]) > allowed)) continue;
        throw Misuse(fmt::format(
            "{}: row {}, column {} is {:.6g}, but differences of the rows give {:.6g} (t = {:g}, beside the start)",
            model_.source().derivatives, i, j, own[i], differences[i], near[0]));
      }
    }
  }

  const ForeignModel& model_;
  std::vector<double> point_, d_;
  std::vector<double> at_, at_d_;  // as they were
};

}  // namespace

void requireGoodFunctions(const ForeignModel& model, const std::vector<double>& point, const std::vector<double>& d) {
  FunctionCheck(model, point, d).run();
}

}  // namespace irk::own
