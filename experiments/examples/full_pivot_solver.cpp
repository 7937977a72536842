// A stage solver: LU with full pivoting of the coupled system of all stages. Slow, and right where others are singular.
#include <irk/strategies.h>

#include <Eigen/LU>

namespace {

using Matrix = irk::Mat<double>;

class FullPivotSolver final : public irk::StageSolver<double> {
 public:
  explicit FullPivotSolver(const irk::StageSolverSetup<double>& setup) : setup_(setup), scales_(setup.pattern->n) {}

  irk::Outcome factorize(std::span<const irk::Linearization<double>> at, const double& h) override {
    const irk::Index n = setup_.pattern->n, s = setup_.A.rows();
    irk::rowScales(setup_.row_powers, h, scales_);
    const Matrix A2 = setup_.A * setup_.A;
    Matrix all(s * n, s * n);
    for (irk::Index i = 0; i < s; ++i) {
      const auto& D = at[at.size() == 1 ? 0 : static_cast<std::size_t>(i)];
      for (irk::Index j = 0; j < s; ++j) {
        Matrix block = h * setup_.A(i, j) * D.dense1() + h * h * A2(i, j) * D.dense2();
        if (i == j) block += D.dense0();
        all.block(i * n, j * n, n, n) = scales_.asDiagonal() * block;
      }
    }
    if (!all.allFinite()) return irk::Outcome::kNotFinite;
    lu_.compute(all);
    return lu_.isInvertible() ? irk::Outcome::kSuccess : irk::Outcome::kSingular;
  }

  void solve(Eigen::Ref<Matrix> rhs) override {
    const irk::Vec<double> flat = rhs.reshaped();
    rhs.reshaped() = lu_.solve(flat);
  }

 private:
  irk::StageSolverSetup<double> setup_;
  irk::Vec<double> scales_;
  Eigen::FullPivLU<Matrix> lu_;
};

}  // namespace

IRK_REGISTER {
  irk::registerStrategy<irk::StageSolverKind>(
      {.id = {"full_pivot"},
       .meaning = "LU with full pivoting of the coupled system",
       .coupled = true,
       .storage = irk::Storage::kDense,
       .make = {[](const irk::StageSolverSetup<double>& setup) { return std::make_unique<FullPivotSolver>(setup); },
                {}}});
}
