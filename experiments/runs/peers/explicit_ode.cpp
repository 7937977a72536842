#include "experiments/runs/peers/explicit_ode.h"

#include <algorithm>

namespace irk {

ExplicitOde::ExplicitOde(const System<double>& system)
    : system_(system),
      sizes_(system.sizes()),
      d_(Vec<double>::Zero(sizes_.discrete)),
      no_rates_(Vec<double>::Zero(sizes_.nx)),
      dual_(sizes_),
      f_(sizes_.nx) {}

// The residual is f - k; at k = 0 it equals f.
Point<double> ExplicitOde::point(double t, const double* y) const {
  const ConstVec<double> none(nullptr, 0);
  return {t, none, none, {y, sizes_.nx}, none, {no_rates_.data(), sizes_.nx}, none, {d_.data(), sizes_.discrete}};
}

bool ExplicitOde::rates(double t, const double* y, double* f) {
  ++rates_count_;
  VecView<double> rows(f, sizes_.nx);
  system_.evaluate(Level::kFormulated, point(t, y), rows);
  return rows.allFinite();
}

// The directions of differentiation are y and, last, t.
bool ExplicitOde::jacobian(double t, const double* y, Eigen::Ref<Mat<double>> dfdy, Vec<double>& dfdt) {
  ++jacobian_count_;
  const Index n = sizes_.nx, chunk = static_cast<Index>(kChunk);
  dual_.t = Dual<double>(t);
  for (Index i = 0; i < n; ++i) dual_.x[i] = Dual<double>(y[i]);
  for (Index i = 0; i < sizes_.discrete; ++i) dual_.d[i] = Dual<double>(d_[i]);
  const auto variable = [&](Index i) -> Dual<double>& { return i < n ? dual_.x[i] : dual_.t; };
  const auto column = [&](Index i) { return i < n ? dfdy.col(i).data() : dfdt.data(); };
  for (Index first = 0; first <= n; first += chunk) {
    const Index count = std::min(chunk, n + 1 - first);
    for (Index c = 0; c < count; ++c) variable(first + c).d[static_cast<std::size_t>(c)] = 1;
    system_.evaluate(Level::kFormulated, pointOf(dual_), {f_.data(), n});
    for (Index c = 0; c < count; ++c) {
      double* const to = column(first + c);
      for (Index i = 0; i < n; ++i) to[i] = f_[i].d[static_cast<std::size_t>(c)];
      variable(first + c).d[static_cast<std::size_t>(c)] = 0;
    }
  }
  return dfdy.allFinite() && dfdt.allFinite();
}

void ExplicitOde::switching(double t, const double* y, double* g) const {
  system_.switching(point(t, y), {g, sizes_.switches});
}

void ExplicitOde::count(Counters& counters) const {
  counters.residuals += rates_count_;
  counters.jacobians += jacobian_count_;
}

}  // namespace irk
