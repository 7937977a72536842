#include "tableaus/analysis/stability_function.h"

#include <algorithm>
#include <limits>

#include "tableaus/analysis/spectrum.h"
#include "tableaus/families/precise.h"

namespace irk {
namespace {

/// R(z) = 1 + z b^T (I - z A)^-1 e.
struct Realization {
  Mat<BigFloat> A;
  Vec<BigFloat> e, b;
};

/// Orthonormal basis of span{x, A x, A^2 x, ...}: Arnoldi's process, orthogonalized twice.
Mat<BigFloat> krylovBasis(const Mat<BigFloat>& A, const Vec<BigFloat>& x, double tolerance) {
  const Index s = x.size();
  const BigFloat negligible = tolerance * A.norm();
  Mat<BigFloat> Q(s, s);
  if (x.norm() == 0) return Q.leftCols(0);
  Q.col(0) = x.normalized();
  for (Index k = 1; k < s; ++k) {
    const auto basis = Q.leftCols(k);
    Vec<BigFloat> next = A * Q.col(k - 1);
    for (int pass = 0; pass < 2; ++pass) next -= basis * (basis.transpose() * next).eval();
    if (next.norm() <= negligible) return Q.leftCols(k);
    Q.col(k) = next.normalized();
  }
  return Q;
}

// Reduces A to the subspace that the vector 1 reaches and b observes; the rest cancels in R. This removes common
// factors of N and D, as reducible methods have them, and zero eigenvalues of A that do not make R grow at infinity.
Realization minimalRealization(const Tableau<BigFloat>& tableau, double tolerance) {
  const auto& A = tableau.A;
  const Vec<BigFloat> ones = Vec<BigFloat>::Ones(tableau.stages());
  const Mat<BigFloat> Q = krylovBasis(A, ones, tolerance);
  const Mat<BigFloat> A_reached = Q.transpose() * A * Q;
  const Vec<BigFloat> b_reached = Q.transpose() * tableau.b;
  const Mat<BigFloat> P = krylovBasis(A_reached.transpose(), b_reached, tolerance);
  const Mat<BigFloat> QP = Q * P;
  return {QP.transpose() * A * QP, QP.transpose() * ones, QP.transpose() * tableau.b};
}

/// The coefficients of prod (1 - z lambda), ascending.
Vec<BigFloat> productOfFactors(const std::vector<Eigenvalue>& values) {
  const auto n = static_cast<Index>(values.size());
  Vec<BigFloat> product = Vec<BigFloat>::Zero(n + 1);
  product[0] = 1;
  Index degree = 0;
  for (const auto& [re, im] : values) {
    if (im < 0) continue;  // included with its conjugate
    const BigFloat linear = im == 0 ? -re : -2 * re, quadratic = im == 0 ? 0 : re * re + im * im;
    degree += im == 0 ? 1 : 2;
    for (Index k = degree; k > 0; --k) {
      product[k] += linear * product[k - 1];
      if (k > 1) product[k] += quadratic * product[k - 2];
    }
  }
  return product;
}

/// A polynomial and the eigenvalues that define it.
struct Factored {
  Vec<BigFloat> coefficients;
  std::vector<Eigenvalue> values;
};

Factored factored(const Mat<BigFloat>& matrix) {
  auto values = eigenvalues(matrix);
  const auto squared = [](const Eigenvalue& x) { return x.re * x.re + x.im * x.im; };
  std::ranges::stable_sort(values, std::greater<>(), squared);
  return {productOfFactors(values), values};
}

// Without common factors at most one of N and D has less than full degree. Its missing coefficients are rounding
// errors, judged relative to the coefficient of the same power in the other polynomial.
void dropLeadingZeros(Factored& less, const Factored& full, double tolerance) {
  Index n = less.coefficients.size() - 1;
  while (n > 0 && abs(less.coefficients[n]) <= tolerance * abs(full.coefficients[n])) --n;
  less.coefficients.conservativeResize(n + 1);
  less.values.resize(static_cast<std::size_t>(n));
}

std::vector<std::complex<double>> reciprocals(const std::vector<Eigenvalue>& values) {
  std::vector<std::complex<double>> result;
  for (const Eigenvalue& value : values) result.push_back(1.0 / value.rounded());
  return result;
}

/// The uncertainty of b^T A^(q-1) 1, to first order, for coefficients with relative error 1: sum_j |b^T A^j| |A|
/// |A^(q-2-j) 1|, and |b^T| |A^(q-1) 1| for b.
class Uncertainty {
 public:
  explicit Uncertainty(const Tableau<BigFloat>& tableau)
      : A_(tableau.A.cast<double>()), A_abs_(A_.cwiseAbs()), b_abs_(tableau.b.cast<double>()) {
    left_.push_back(b_abs_);
    b_abs_ = b_abs_.cwiseAbs().eval();
    right_.push_back(Vec<double>::Ones(b_abs_.size()));
  }
  /// Returns the uncertainties for q = 1, 2, ... one after the other.
  double next() {
    double sum = b_abs_.dot(right_.back().cwiseAbs());
    for (std::size_t j = 0; j + 1 < right_.size(); ++j) {
      sum += left_[j].cwiseAbs().dot(A_abs_ * right_[right_.size() - 2 - j].cwiseAbs());
    }
    left_.push_back(A_.transpose() * left_.back());
    right_.push_back(A_ * right_.back());
    return sum;
  }

 private:
  Mat<double> A_, A_abs_;
  Vec<double> b_abs_;
  std::vector<Vec<double>> left_, right_;  ///< A^T^j b and A^j 1
};

// e^z - R(z) has the coefficients 1/q! - b^T A^(q-1) 1. The smallest known error constants of methods of order q - 1
// are those of Pade approximations, about 2^-q / q!; if the digits do not resolve these, the order is undecided.
void findOrder(const Tableau<BigFloat>& tableau, double tolerance, StabilityFunction& R) {
  const int most = static_cast<int>(2 * tableau.stages()) + 1;
  Uncertainty uncertainty(tableau);
  Vec<BigFloat> power = Vec<BigFloat>::Ones(tableau.stages());
  BigFloat expected = 1;
  R.error_constant = std::numeric_limits<double>::quiet_NaN();
  R.order_resolved = false;
  for (int q = 1; q <= most; ++q) {
    R.order = q - 1;
    expected /= q;
    const BigFloat difference = expected - tableau.b.dot(power);
    const BigFloat noise = tolerance * uncertainty.next();
    if (abs(difference) > noise) {
      R.error_constant = static_cast<double>(difference);
      R.order_resolved = true;
      return;
    }
    if (noise > ldexp(expected, -q)) return;
    power = (tableau.A * power).eval();
  }
}

}  // namespace

double StabilityFunction::atInfinity() const {
  const Index j = numeratorDegree(), k = denominatorDegree();
  if (j < k) return 0;
  const BigFloat ratio = numerator[j] / denominator[k];
  if (j == k) return static_cast<double>(ratio);
  const bool positive = (ratio > 0) == ((j - k) % 2 == 0);
  const double infinity = std::numeric_limits<double>::infinity();
  return positive ? infinity : -infinity;
}

StabilityFunction stabilityFunction(const Tableau<BigFloat>& tableau, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  const auto [A, e, b] = minimalRealization(tableau, tolerance);
  // Rounding A and b by `tolerance` changes a ratio of determinants by tolerance times its condition, about s^2.
  const double negligible = tolerance * static_cast<double>(A.rows() * A.rows());
  Factored D = factored(A), N = factored(A - e * b.transpose());
  const Factored full_D = D;
  if (abs(D.coefficients[A.rows()]) <= negligible * abs(N.coefficients[A.rows()])) {
    dropLeadingZeros(D, N, negligible);
  } else {
    dropLeadingZeros(N, full_D, negligible);
  }
  StabilityFunction R{N.coefficients, D.coefficients, reciprocals(N.values), reciprocals(D.values), 0, 0, false};
  findOrder(tableau, tolerance, R);
  return R;
}

}  // namespace irk
