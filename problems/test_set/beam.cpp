// The elastic beam of 40 links, driven at its free end until t = pi. IVP test set, BEAM; HW II (IV.10).
//
// theta'' = C v + D u with C u = D v + theta'^2. Both matrices are tridiagonal. C has the diagonal 1, 2, ..., 2, 3 and
// beside it -cos(theta_l - theta_l+-1); D has the diagonal 0 and beside it -sin(theta_l - theta_l+-1).
#include "irk/scene_file.h"

using namespace irk;

namespace {

constexpr std::size_t kLinks = 40;

template <class Real>
struct Beam {
  Sizes sizes() const { return {.nu = kLinks, .discrete = 1}; }
  std::vector<Real> times() const { return {piOf<Real>()}; }
  template <class T>
  void onTime(Index, const Point<T>&, T* d) const {
    d[0] = T(0.0);  // the force's amplitude
  }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    constexpr double kSquare = kLinks * kLinks;
    const T sine = sin(p.t), force = p.d[0] * (sine * sine);
    std::array<T, kLinks> v, c, s, u, pivot;  // c[l], s[l]: cos and sin of theta_l - theta_l+1
    for (std::size_t l = 0; l < kLinks; ++l) {
      const auto i = static_cast<Index>(l);
      const bool last = l + 1 == kLinks;
      const T& angle = p.u[i];
      const T before = l > 0 ? T(p.u[i - 1] - angle) : T(-2 * angle), after = last ? T(0.0) : T(p.u[i + 1] - angle);
      v[l] = kSquare * (kSquare * (before + after) + force * (cos(angle) + sin(angle)));
      if (!last) c[l] = cos(after);
      if (!last) s[l] = -sin(after);
    }
    const auto apply = [&](const std::array<T, kLinks>& beside, std::size_t l, const std::array<T, kLinks>& y,
                           int sign) {
      // beside[l] is the function at theta_l - theta_l+1; `sign` is 1 for an even function, -1 for an odd one.
      T sum(0.0);
      if (l + 1 < kLinks) sum -= beside[l] * y[l + 1];
      if (l > 0) sum -= sign * (beside[l - 1] * y[l - 1]);
      return sum;
    };
    const auto diagonal = [](std::size_t l) { return l == 0 ? 1 : l + 1 == kLinks ? 3 : 2; };
    for (std::size_t l = 0; l < kLinks; ++l) {
      const auto i = static_cast<Index>(l);
      u[l] = apply(s, l, v, -1) + p.v[i] * p.v[i];
      pivot[l] = T(diagonal(l));
      if (l == 0) continue;
      const T factor = c[l - 1] / pivot[l - 1];
      pivot[l] -= factor * c[l - 1];
      u[l] += factor * u[l - 1];
    }
    for (std::size_t l = kLinks; l-- > 0;) {
      if (l + 1 < kLinks) u[l] += c[l] * u[l + 1];
      u[l] /= pivot[l];
    }
    for (std::size_t l = 0; l < kLinks; ++l) {
      const auto i = static_cast<Index>(l);
      r.u[i] = diagonal(l) * v[l] + apply(c, l, v, 1) + apply(s, l, u, -1) - p.a[i];
    }
  }
  void start(State<Real>& s) const { s.d[0] = Real(1.5); }
  SceneFrame<Real> frame() const { return {.t_end = 5, .u = numbered(kLinks, "theta", "rad")}; }
  static SceneEntry entry() {
    return {.id = "beam",
            .title = "elastic beam of 40 links",
            .shows = "stiff oscillations of second order; a force that ends at t = pi",
            .collections = {"ivp", "multibody"},
            .literature = "IVP test set, BEAM; HW II (IV.10)",
            .panels = {{"angle of the free end", {"theta40"}}},
            .reference_cases = {{.tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(Beam)
