// Newton's method with one Jacobian: it ends when the increment is below a hundredth of the tolerance, and fails when
// increments do not shrink.
#include <irk/strategies.h>

#include <cmath>

namespace {

class ChordNewton final : public irk::Newton<double> {
 public:
  ChordNewton(const irk::IntegratorOptions& options, const irk::Sizes& sizes, const irk::Scheme<double>& scheme)
      : limit_(options.newton.max_iterations), first_(scheme.first), R_(sizes.n(), scheme.s), weights_(sizes.n()) {}

  irk::NewtonResult solve(irk::NewtonContext<double>& c, irk::Mat<double>& W) override {
    auto& jacobian = c.matrix.shared();
    const bool wanted = jacobian.stale() && c.use == irk::JacobianUse::kRefreshIfStale;
    if (jacobian.version() == 0 || wanted) jacobian.evaluate(c.eq, W);
    irk::NewtonResult result;
    result.outcome = c.matrix.prepare(c.eq.h());
    if (result.outcome != irk::Outcome::kSuccess) return result;
    c.norm.rowWeights(c.eq.h(), weights_);
    double last = 0;
    while (result.iterations < limit_) {
      ++result.iterations;
      ++c.counters.newton_iterations;
      if (!c.eq.residual(W, R_)) return failed(result, irk::Outcome::kNotFinite);
      const irk::Index implicit = W.cols() - first_;
      c.matrix.solve(R_.rightCols(implicit));
      W.rightCols(implicit) -= R_.rightCols(implicit);
      const double increment = c.norm.increment(R_, first_, weights_);
      if (result.iterations > 1) result.theta = increment / last;
      if (!std::isfinite(increment) || result.theta > 1) break;
      if (increment < 0.01) {
        if (result.theta > 0.1) jacobian.markStale();
        return result;
      }
      last = increment;
    }
    jacobian.markStale();
    return failed(result, irk::Outcome::kNewtonFailed);
  }

 private:
  static irk::NewtonResult failed(irk::NewtonResult result, irk::Outcome outcome) {
    result.outcome = outcome;
    return result;
  }

  int limit_;
  irk::Index first_;
  irk::Mat<double> R_;
  irk::Vec<double> weights_;
};

}  // namespace

IRK_REGISTER {
  irk::registerStrategy<irk::NewtonKind>(
      {.id = {"chord"},
       .meaning = "one Jacobian, increments below a hundredth of the tolerance",
       .make = {[](const irk::IntegratorOptions& options, const irk::Sizes& sizes, const irk::Scheme<double>& scheme) {
                  return std::make_unique<ChordNewton>(options, sizes, scheme);
                },
                {}}});
}
