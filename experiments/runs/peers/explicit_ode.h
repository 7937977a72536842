// y' = f(t, y) with its derivatives, as plain arrays: the interface that ODE codes expect.
#pragma once

#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// The right-hand side f of a system in the formulation `first_order` (nu = nz = 0, residual f - k). Keeps a
/// reference to the system, which must outlive it. Use one object per thread.
class ExplicitOde {
 public:
  explicit ExplicitOde(const System<double>& system);

  Index size() const { return sizes_.nx; }
  const System<double>& system() const { return system_; }
  void setDiscrete(const Vec<double>& d) { d_ = d; }

  /// Writes f(t, y) to `f` (`size` values). Returns false if a value is not finite.
  bool rates(double t, const double* y, double* f);
  /// Writes df/dy (size x size) and df/dt (size values), both exact. Returns false if a value is not finite.
  bool jacobian(double t, const double* y, Eigen::Ref<Mat<double>> dfdy, Vec<double>& dfdt);
  /// Writes the switching functions at (t, y) to `g`.
  void switching(double t, const double* y, double* g) const;

  /// Adds the evaluations since resetCounts.
  void count(Counters& counters) const;
  void resetCounts() { rates_count_ = jacobian_count_ = 0; }

 private:
  Point<double> point(double t, const double* y) const;

  const System<double>& system_;
  Sizes sizes_;
  Vec<double> d_, no_rates_;
  State<Dual<double>> dual_;
  Vec<Dual<double>> f_;
  std::int64_t rates_count_ = 0, jacobian_count_ = 0;
};

}  // namespace irk
