#include "problems/support/elliptic.h"

#include <array>
#include <cmath>

#include "irk/multiprecision.h"
#include "irk/scalar.h"

namespace irk {

template <class Real>
JacobiFunctions<Real> jacobiFunctions(const Real& u, const Real& m) {
  using std::asin;
  using std::cos;
  using std::sin;
  using std::sqrt;
  // Arithmetic-geometric mean: c_n is squared in every step, so that 12 steps give thousands of digits.
  constexpr std::size_t kSteps = 12;
  std::array<Real, kSteps> ratio{};  // c_n / a_n
  Real a = 1, b = sqrt(1 - m), factor = 1;
  std::size_t n = 0;
  for (; n < kSteps; ++n) {
    const Real c = (a - b) / 2;
    const Real mean = (a + b) / 2;
    if (c <= Eigen::NumTraits<Real>::epsilon() * mean) break;
    b = sqrt(a * b);
    a = mean;
    factor *= 2;
    ratio[n] = c / a;
  }
  // phi_N = 2^N a_N u, then sin(2 phi_{n-1} - phi_n) = (c_n / a_n) sin phi_n.
  Real phi = factor * a * u;
  while (n > 0) {
    --n;
    phi = (phi + asin(ratio[n] * sin(phi))) / 2;
  }
  const Real sn = sin(phi);
  return {sn, cos(phi), sqrt(1 - m * sn * sn), phi};
}

template JacobiFunctions<double> jacobiFunctions(const double&, const double&);
template JacobiFunctions<BigFloat> jacobiFunctions(const BigFloat&, const BigFloat&);

}  // namespace irk
