// y' = f(t, y) with its derivatives, as plain arrays: the face that ODE codes want.
#pragma once

#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// f of a system in the formulation `first_order` (nu = nz = 0, rows f - k). Keeps a reference to
/// the system. One per thread.
class ExplicitOde {
 public:
  explicit ExplicitOde(const System<double>& system);

  Index size() const { return sizes_.nx; }
  const System<double>& system() const { return system_; }
  void setDiscrete(const Vec<double>& d) { d_ = d; }

  /// f (size) at (t, y). False where it is not finite.
  bool rates(double t, const double* y, double* f);
  /// df/dy (size x size) and df/dt (size), exact. False where they are not finite.
  bool jacobian(double t, const double* y, Eigen::Ref<Mat<double>> dfdy, Vec<double>& dfdt);
  /// The switching functions at (t, y).
  void switching(double t, const double* y, double* g) const;

  /// Evaluations since resetCounts.
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
