#include "tableaus/analysis/analysis.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "irk/misuse.h"
#include "tableaus/families/precise.h"

namespace irk {
namespace {

constexpr double kRoundingUnits = 50;

void requireShape(const Tableau<BigFloat>& tableau) {
  const Index s = tableau.stages();
  if (s < 1 || tableau.A.rows() != s || tableau.A.cols() != s || tableau.c.size() != s) {
    throw Misuse(fmt::format("tableau '{}': A is {} x {}, b has {}, c has {} entries", tableau.id, tableau.A.rows(),
                             tableau.A.cols(), s, tableau.c.size()));
  }
  const auto finite = [](const Mat<BigFloat>& block) {
    return std::ranges::all_of(block.reshaped(), [](const BigFloat& x) { return isfinite(x); });
  };
  if (!finite(tableau.A) || !finite(tableau.b) || !finite(tableau.c)) {
    throw Misuse(fmt::format("tableau '{}' has a coefficient that is not finite", tableau.id));
  }
}

/// The largest |sum - expected|, each divided by the magnitude of the sum's terms.
template <class Sum, class Magnitude, class Expected>
double residual(const Sum& sum, const Magnitude& magnitude, const Expected& expected) {
  const Vec<BigFloat> error = (sum - expected).cwiseAbs();
  return static_cast<double>(error.cwiseQuotient(magnitude.cwiseMax(BigFloat(1))).maxCoeff());
}

SimplifyingResiduals simplifyingResiduals(const Tableau<BigFloat>& tableau) {
  const auto& [A, b, c] = std::tie(tableau.A, tableau.b, tableau.c);
  const Index s = tableau.stages();
  const Mat<BigFloat> A_abs = A.cwiseAbs();
  SimplifyingResiduals residuals{Vec<double>(2 * s + 1), Vec<double>(s + 1), Vec<double>(s + 1)};
  Vec<BigFloat> power = Vec<BigFloat>::Ones(s);  // c^(k-1)
  for (Index k = 1; k <= 2 * s + 1; ++k) {
    const Vec<BigFloat> b_power = b.cwiseProduct(power);
    const Vec<BigFloat> power_abs = power.cwiseAbs(), b_power_abs = b_power.cwiseAbs();
    const Vec<BigFloat> power_next = power.cwiseProduct(c);
    residuals.B[k - 1] =
        residual(Vec<BigFloat>::Constant(1, b_power.sum()), Vec<BigFloat>::Constant(1, b_power_abs.sum()),
                 Vec<BigFloat>::Constant(1, BigFloat(1) / k));
    if (k <= s + 1) {
      residuals.C[k - 1] =
          residual(Vec<BigFloat>(A * power), Vec<BigFloat>(A_abs * power_abs), Vec<BigFloat>(power_next / k));
      residuals.D[k - 1] =
          residual(Vec<BigFloat>(A.transpose() * b_power), Vec<BigFloat>(A_abs.transpose() * b_power_abs),
                   Vec<BigFloat>(b.cwiseProduct((1 - power_next.array()).matrix()) / k));
    }
    power = power_next;
  }
  return residuals;
}

int countHolding(const Vec<double>& residuals, double tolerance) {
  const auto fails = [&](double residual) { return !(residual <= tolerance); };
  return static_cast<int>(std::find_if(residuals.begin(), residuals.end(), fails) - residuals.begin());
}

double norm1(const Mat<BigFloat>& A) { return static_cast<double>(A.cwiseAbs().colwise().sum().maxCoeff()); }

double reciprocalCondition(const Mat<BigFloat>& A, const Eigen::FullPivLU<Mat<BigFloat>>& lu) {
  return lu.isInvertible() ? 1 / (norm1(A) * norm1(lu.inverse())) : 0;
}

void analyzeRegularity(const Tableau<BigFloat>& tableau, TableauAnalysis& analysis) {
  const Eigen::FullPivLU<Mat<BigFloat>> lu(tableau.A);
  analysis.reciprocal_condition = reciprocalCondition(tableau.A, lu);
  analysis.regular = analysis.reciprocal_condition > analysis.tolerance;
}

void analyzeStructure(const Tableau<BigFloat>& tableau, TableauAnalysis& analysis) {
  const auto& [A, b, c] = std::tie(tableau.A, tableau.b, tableau.c);
  const auto maximum = [](const auto& block) { return static_cast<double>(block.cwiseAbs().maxCoeff()); };
  const Vec<BigFloat> row_sums = A.rowwise().sum();
  analysis.row_sum_errors = (row_sums - c).cwiseAbs().cast<double>();
  analysis.stiffly_accurate = maximum(A.row(A.rows() - 1) - b.transpose()) <= analysis.tolerance;
  analysis.explicit_first_stage = maximum(A.row(0)) == 0;

  const Mat<BigFloat> bA = b.asDiagonal() * A;
  const Mat<BigFloat> M = bA + bA.transpose() - b * b.transpose();
  analysis.symplecticity_error = maximum(M);
  analysis.symplectic = analysis.symplecticity_error <= analysis.tolerance;
  // Rounding may change M by the tolerance, and its eigenvalues are computed in double precision.
  const double slack = std::max(analysis.tolerance, toleranceOfDigits(std::numeric_limits<double>::digits10));
  const Eigen::SelfAdjointEigenSolver<Mat<double>> eigen(M.cast<double>(), Eigen::EigenvaluesOnly);
  analysis.algebraically_stable = b.minCoeff() >= -analysis.tolerance && eigen.eigenvalues().minCoeff() >= -slack;
}

}  // namespace

double toleranceOfDigits(int digits) { return kRoundingUnits * std::pow(10.0, 1 - digits); }

template <class Real>
double roundingTolerance() {
  return kRoundingUnits * static_cast<double>(std::numeric_limits<Real>::epsilon());
}

template <>
double roundingTolerance<BigFloat>() {
  return toleranceOfDigits(kFileDigits);
}

template <class Real>
TableauAnalysis analyzeTableau(const Tableau<Real>& tableau, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  const Tableau<BigFloat> wide = tableau.template cast<BigFloat>();
  requireShape(wide);
  TableauAnalysis analysis{};
  analysis.tolerance = tolerance;
  analysis.residuals = simplifyingResiduals(wide);
  analysis.p = countHolding(analysis.residuals.B, tolerance);
  analysis.q = countHolding(analysis.residuals.C, tolerance);
  analysis.r = countHolding(analysis.residuals.D, tolerance);
  analysis.proven_order =
      std::min({analysis.p, 2 * analysis.q + 2, analysis.q + analysis.r + 1, 2 * static_cast<int>(wide.stages())});
  analyzeRegularity(wide, analysis);
  analyzeStructure(wide, analysis);
  return analysis;
}

template double roundingTolerance<double>();
template double roundingTolerance<BigFloat>();
template TableauAnalysis analyzeTableau(const Tableau<double>&, double);
template TableauAnalysis analyzeTableau(const Tableau<BigFloat>&, double);

}  // namespace irk
