#include "tableaus/analysis/spectrum.h"
#include "tableaus/families/precise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace irk {
namespace {

// Eigen allows 40. Eigenvalues that coincide are found one digit after the other.
constexpr Index kIterationsPerRow = 1000;

constexpr double kLargestCondition = 1e38;  // 80 digits resolve its square

BigFloat magnitude(const BigFloat& re, const BigFloat& im) { return sqrt(re * re + im * im); }

/// Appends the eigenvalues of the 2 x 2 block [a b; c d].
void appendPair(const BigFloat& a, const BigFloat& b, const BigFloat& c, const BigFloat& d,
                std::vector<Eigenvalue>& values) {
  const BigFloat centre = (a + d) / 2, half = (a - d) / 2;
  const BigFloat discriminant = half * half + b * c;
  const BigFloat root = sqrt(abs(discriminant));
  if (discriminant < 0) {
    values.push_back({centre, root});
    values.push_back({centre, -root});
  } else {
    values.push_back({centre + root, 0});
    values.push_back({centre - root, 0});
  }
}

std::vector<Eigenvalue> ofSchurForm(const Mat<BigFloat>& T) {
  std::vector<Eigenvalue> values;
  for (Index i = 0; i < T.rows(); ++i) {
    if (i + 1 < T.rows() && T(i + 1, i) != 0) {
      appendPair(T(i, i), T(i, i + 1), T(i + 1, i), T(i + 1, i + 1), values);
      ++i;
    } else {
      values.push_back({T(i, i), 0});
    }
  }
  return values;
}

double smallestGap(const std::vector<Eigenvalue>& values) {
  BigFloat largest = 0, gap = -1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    largest = std::max(largest, magnitude(values[i].re, values[i].im));
    for (std::size_t j = 0; j < i; ++j) {
      const BigFloat d = magnitude(values[i].re - values[j].re, values[i].im - values[j].im);
      if (gap < 0 || d < gap) gap = d;
    }
  }
  if (gap < 0) return 1;
  return largest == 0 ? 0 : static_cast<double>(gap / largest);
}

// A pair of eigenvectors p +- i q is normalized to (p +- i q) / sqrt(|p|^2 + |q|^2). Equally scaled, sqrt(2) (p, q)
// is a real matrix of the same condition, because it differs by a unitary factor.
Mat<BigFloat> realUnitEigenvectors(const Eigen::EigenSolver<Mat<BigFloat>>& eigen) {
  Mat<BigFloat> V = eigen.pseudoEigenvectors();
  const auto& D = eigen.eigenvalues();
  for (Index k = 0; k < V.cols(); ++k) {
    if (D[k].imag() == 0) {
      V.col(k).normalize();
    } else {
      V.middleCols(k, 2) *= sqrt(BigFloat(2)) / V.middleCols(k, 2).norm();
      ++k;
    }
  }
  return V;
}

double condition2(const Mat<BigFloat>& V) {
  const auto squares = eigenvalues(V.transpose() * V);
  const auto [lowest, highest] = std::ranges::minmax(squares, {}, &Eigenvalue::re);
  const BigFloat low = lowest.re, high = highest.re;
  const bool resolved = low > 0 && high / low < BigFloat(kLargestCondition) * BigFloat(kLargestCondition);
  return resolved ? static_cast<double>(sqrt(high / low)) : std::numeric_limits<double>::infinity();
}

}  // namespace

std::complex<double> Eigenvalue::rounded() const { return {static_cast<double>(re), static_cast<double>(im)}; }

std::vector<Eigenvalue> eigenvalues(const Mat<BigFloat>& matrix) {
  const WorkingDigits digits(kAnalysisDigits);
  if (matrix.rows() == 0) return {};
  Eigen::RealSchur<Mat<BigFloat>> schur(matrix.rows());
  schur.setMaxIterations(kIterationsPerRow * matrix.rows());
  schur.compute(matrix, false);
  if (schur.info() != Eigen::Success) throw std::runtime_error("the QR iteration does not converge");
  return ofSchurForm(schur.matrixT());
}

std::vector<Eigenvalue> polynomialZeros(const Vec<BigFloat>& ascending) {
  const WorkingDigits digits(kAnalysisDigits);
  const Index n = ascending.size() - 1;
  if (n < 1) return {};
  const BigFloat scale = pow(abs(ascending[0] / ascending[n]), BigFloat(1) / n);
  Mat<BigFloat> companion = Mat<BigFloat>::Zero(n, n);
  companion.diagonal(-1).setOnes();
  BigFloat power = 1;  // powers of `scale`
  for (Index k = 0; k < n; ++k, power *= scale) {
    companion(k, n - 1) = -ascending[k] * power;
  }
  companion.col(n - 1) /= ascending[n] * power;
  auto zeros = eigenvalues(companion);
  for (Eigenvalue& zero : zeros) zero = {zero.re * scale, zero.im * scale};
  return zeros;
}

Spectrum spectrum(const Mat<BigFloat>& matrix, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  const Eigen::EigenSolver<Mat<BigFloat>> eigen(matrix);
  if (eigen.info() != Eigen::Success) throw std::runtime_error("the QR iteration does not converge");
  Spectrum result;
  // For a triangular matrix take the diagonal, which is exact. The QR iteration would spread the s equal eigenvalues
  // of an SDIRK method by the s-th root of its rounding errors.
  const Mat<BigFloat> above = matrix.triangularView<Eigen::StrictlyUpper>();
  if (above.isZero(0)) {
    for (const BigFloat& value : matrix.diagonal()) result.values.push_back({value, 0});
  } else {
    for (const auto& value : eigen.eigenvalues()) {
      result.values.push_back({value.real(), value.imag()});
    }
  }
  const double split = std::sqrt(tolerance);
  result.gap = smallestGap(result.values);
  result.eigenvector_condition = condition2(realUnitEigenvectors(eigen));
  result.repeated = result.gap <= split;
  result.defective = result.repeated && result.eigenvector_condition >= 1 / split;
  return result;
}

}  // namespace irk
