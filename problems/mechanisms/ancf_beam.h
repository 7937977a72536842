// Planar ANCF cable elements, Gerstmayr & Irschik (JSV 318, 2008). Internal to ancf_*.cpp.
//
// The coordinates of a node are r (position) and r' (slope with respect to the arc length x); each element has eight.
// eps = |r'| - 1, K = (r' x r'') / |r'|^2, N = EA eps, Mb = EI K, dW = int (N d eps + Mb d K) dx. Gauss points: 5 for
// the axial strain, 3 for bending. For the mass 4 points would be exact with cubic shape functions; the closed form
// is used instead.
#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "irk/problem.h"
#include "irk/scene_file.h"

namespace irk {

/// The support. It fixes coordinates at zero, which are therefore no unknowns.
enum class AncfSupport {
  kClamped,  ///< r and the y-component of r' at node 0
  kHinged,   ///< r at node 0
};

template <class Real>
struct AncfData {
  Index elements;
  Real L, EA, EI, rhoA;  // m, N, N m^2, kg/m
  Real g;                // m/s^2, downwards
  Real tip_load;         // N, dead load, downwards
  AncfSupport support;

  /// From the parameters elements, L, E, A, I, rho and g; without a load at the tip.
  static AncfData from(const Settings& values, AncfSupport support) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    const Real E = value("E"), A = value("A");
    return {.elements = static_cast<Index>(number<double>(values, "elements")),
            .L = value("L"),
            .EA = E * A,
            .EI = E * value("I"),
            .rhoA = value("rho") * A,
            .g = value("g"),
            .tip_load = Real(0),
            .support = support};
  }
  /// The magnitude of velocities in m/s: that of a rigid rod, sqrt(3 g L) at its tip.
  double speed() const { return std::max(std::sqrt(static_cast<double>(Real(3 * g * L))), 1.0); }
};

/// A problem struct: a beam along x, discretized by equal elements. u holds the free coordinates, node by node
/// (r_x, r_y, r'_x, r'_y).
template <class Real>
class AncfBeam {
 public:
  explicit AncfBeam(const AncfData<Real>& data) : d_(data), le_(data.L / static_cast<double>(data.elements)) {
    const std::size_t supported = d_.support == AncfSupport::kClamped ? 3 : 2;
    const std::size_t fixed[] = {0, 1, 3};
    unknown_.assign(static_cast<std::size_t>(4 * (d_.elements + 1)), 0);
    for (std::size_t i = 0; i < supported; ++i) unknown_[fixed[i]] = kFixed;
    for (Index& index : unknown_) {
      if (index != kFixed) index = nu_++;
    }
    setGaussPoints();
    const Real m = d_.rhoA * le_ / 420;
    const Real mass[4][4] = {{156, 22 * le_, 54, -13 * le_},
                             {22 * le_, 4 * le_ * le_, 13 * le_, -3 * le_ * le_},
                             {54, 13 * le_, 156, -22 * le_},
                             {-13 * le_, -3 * le_ * le_, -22 * le_, 4 * le_ * le_}};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) mass_[i][j] = m * mass[i][j];
    }
    const Real weight = d_.rhoA * d_.g * le_;
    weight_ = {weight / 2, weight * le_ / 12, weight / 2, -weight * le_ / 12};
  }

  Sizes sizes() const { return {.nu = nu_, .nx = 0, .nz = 0, .constraints = 0}; }

  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < nu_; ++i) r.u[i] = T(0.0);
    r.u[tipY()] = T(-d_.tip_load);
    for (Index e = 0; e < d_.elements; ++e) {
      std::array<T, 8> f{};
      addElastic<T>(gather<T>(p.u, e), f);
      addInertia<T>(gather<T>(p.a, e), f);
      for (std::size_t i = 0; i < 8; ++i) {
        const Index row = unknown(e, i);
        if (row != kFixed) r.u[row] -= f[i];
      }
    }
  }

  bool usesVelocity() const { return false; }

  /// The sum of kinetic, elastic and potential energy, in J. The semi-discrete system conserves it.
  Real energy(const Vec<Real>& u, const Vec<Real>& v) const {
    Real sum = d_.tip_load * u[tipY()];
    for (Index e = 0; e < d_.elements; ++e) {
      const auto q = gather<Real>(u, e), rate = gather<Real>(v, e);
      for (const Axial& point : axial_) {
        using std::sqrt;
        const Real x = dot<Real>(point.d1, q, 0), y = dot<Real>(point.d1, q, 1);
        const Real strain = sqrt(x * x + y * y) - 1;
        sum += point.stiffness / 2 * strain * strain;
      }
      for (const Bending& point : bending_) {
        const Real K = Curvature<Real>(point, q).K;
        sum += point.stiffness / 2 * K * K;
      }
      for (std::size_t i = 0; i < 4; ++i) {
        sum += weight_[i] * q[2 * i + 1];
        for (std::size_t j = 0; j < 4; ++j) {
          sum += mass_[i][j] / 2 * (rate[2 * i] * rate[2 * j] + rate[2 * i + 1] * rate[2 * j + 1]);
        }
      }
    }
    return sum;
  }

  /// The beam straight along x and at rest, with the accelerations caused by its loads.
  State<Real> straightStart() const {
    State<Real> s(sizes());
    for (Index n = 0; n <= d_.elements; ++n) {
      const auto node = static_cast<std::size_t>(4 * n);
      if (unknown_[node] != kFixed) s.u[unknown_[node]] = static_cast<double>(n) * le_;
      s.u[unknown_[node + 2]] = Real(1);
    }
    std::vector<Eigen::Triplet<Real>> entries;
    for (Index e = 0; e < d_.elements; ++e) {
      for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t j = i % 2; j < 8; j += 2) {
          const Index row = unknown(e, i), column = unknown(e, j);
          if (row != kFixed && column != kFixed) {
            entries.emplace_back(row, column, mass_[i / 2][j / 2]);
          }
        }
      }
    }
    Eigen::SparseMatrix<Real> M(nu_, nu_);
    M.setFromTriplets(entries.begin(), entries.end());
    Vec<Real> force(nu_);  // the residual at a = 0
    residual<Real>(pointOf(s), Rows<Real>{{force.data(), nu_}, {nullptr, 0}, {nullptr, 0}});
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> ldlt(M);
    s.w = ldlt.solve(force);
    return s;
  }

  /// Names, units and magnitudes of u. r2_x is the x-position of node 2, s2_x its slope; the position of the last
  /// node is tip_x, tip_y. The magnitude of positions and slopes is 1, that of their time derivatives `speed`.
  std::vector<Component> coordinates(double speed) const {
    const char* const axes[] = {"_x", "_y"};
    std::vector<Component> all;
    for (std::size_t i = 0; i < unknown_.size(); ++i) {
      if (unknown_[i] == kFixed) continue;
      const bool position = i % 4 < 2, tip = i / 4 + 1 == unknown_.size() / 4;
      const std::string node = std::to_string(i / 4);
      const std::string name = (position ? (tip ? "tip" : "r" + node) : "s" + node) + axes[i % 2];
      all.push_back({name, position ? "m" : "", 1, speed});
    }
    return all;
  }

  Index tipX() const { return nu_ - 4; }
  Index tipY() const { return nu_ - 3; }

  /// Index of a coordinate that the support fixes.
  static constexpr Index kFixed = -1;
  Index elements() const { return d_.elements; }
  const Real& elementLength() const { return le_; }
  /// The index in u of the coordinate i, 0 to 7, of an element, or kFixed.
  Index unknown(Index element, std::size_t i) const { return unknown_[static_cast<std::size_t>(4 * element) + i]; }
  /// The eight coordinates of an element, or their rates: `from` is u, v or a.
  template <class T, class Vector>
  std::array<T, 8> gather(const Vector& from, Index element) const {
    std::array<T, 8> q;
    for (std::size_t i = 0; i < 8; ++i) {
      const Index index = unknown(element, i);
      q[i] = index == kFixed ? T(0.0) : T(from[index]);
    }
    return q;
  }

  /// The cubic Hermite functions for (r0, r0', r1, r1') at x = le xi, and their derivatives with respect to x.
  template <class T>
  std::array<T, 4> shapes(const T& xi) const {
    const T rest = 1 - xi, left = xi * rest * rest, right = xi * xi * rest;
    return {rest * rest * (1 + 2 * xi), le_ * left, xi * xi * (3 - 2 * xi), -le_ * right};
  }
  template <class T>
  std::array<T, 4> firstDerivatives(const T& xi) const {
    const T bump = 6 * xi * (1 - xi) / le_;
    return {-bump, 1 - 4 * xi + 3 * xi * xi, bump, -2 * xi + 3 * xi * xi};
  }
  template <class T>
  std::array<T, 4> secondDerivatives(const T& xi) const {
    const T jump = (12 * xi - 6) / (le_ * le_);
    return {jump, (6 * xi - 4) / le_, -jump, (6 * xi - 2) / le_};
  }
  /// The sum of four functions times the coordinates of an element along one axis, 0 or 1.
  template <class T, class Shapes>
  static T dot(const Shapes& s, const std::array<T, 8>& q, std::size_t axis) {
    return s[0] * q[axis] + s[1] * q[axis + 2] + s[2] * q[axis + 4] + s[3] * q[axis + 6];
  }

 private:
  using Shape = std::array<Real, 4>;
  struct Axial {
    Real stiffness;  // EA times the weight
    Shape d1;
  };
  struct Bending {
    Real stiffness;  // EI times the weight
    Shape d1, d2;
  };

  // r', r'', 1 / |r'|^2 and K at a Gauss point of bending.
  template <class T>
  struct Curvature {
    T x, y, xx, yy, inverse, K;
    Curvature(const Bending& point, const std::array<T, 8>& q)
        : x(dot<T>(point.d1, q, 0)),
          y(dot<T>(point.d1, q, 1)),
          xx(dot<T>(point.d2, q, 0)),
          yy(dot<T>(point.d2, q, 1)),
          inverse(T(1.0) / (x * x + y * y)),
          K((x * yy - y * xx) * inverse) {}
  };

  template <class T>
  void addElastic(const std::array<T, 8>& q, std::array<T, 8>& f) const {
    using std::sqrt;
    for (const Axial& point : axial_) {
      const T x = dot<T>(point.d1, q, 0), y = dot<T>(point.d1, q, 1);
      const T tension = point.stiffness * (1 - T(1.0) / sqrt(x * x + y * y));
      const T fx = tension * x, fy = tension * y;
      for (std::size_t i = 0; i < 4; ++i) {
        f[2 * i] += point.d1[i] * fx;
        f[2 * i + 1] += point.d1[i] * fy;
      }
    }
    // d K = (d r' x r'' + r' x d r'' - 2 K r'.d r') / |r'|^2
    for (const Bending& point : bending_) {
      const Curvature<T> c(point, q);
      const T moment = point.stiffness * (c.K * c.inverse);
      const T x1 = moment * (c.yy - 2 * (c.K * c.x)), x2 = -moment * c.y;
      const T y1 = -moment * (c.xx + 2 * (c.K * c.y)), y2 = moment * c.x;
      for (std::size_t i = 0; i < 4; ++i) {
        f[2 * i] += point.d1[i] * x1 + point.d2[i] * x2;
        f[2 * i + 1] += point.d1[i] * y1 + point.d2[i] * y2;
      }
    }
  }

  template <class T>
  void addInertia(const std::array<T, 8>& a, std::array<T, 8>& f) const {
    for (std::size_t i = 0; i < 4; ++i) {
      f[2 * i] += dot<T>(mass_[i], a, 0);
      f[2 * i + 1] += dot<T>(mass_[i], a, 1) + weight_[i];
    }
  }

  void setGaussPoints() {
    using std::sqrt;
    const Real near = sqrt(5 - 2 * sqrt(Real(10) / 7)) / 3, far = sqrt(5 + 2 * sqrt(Real(10) / 7)) / 3;
    const Real near_weight = (322 + 13 * sqrt(Real(70))) / 900;
    const Real far_weight = (322 - 13 * sqrt(Real(70))) / 900;
    const Real axial[5][2] = {
        {-far, far_weight}, {-near, near_weight}, {0, Real(128) / 225}, {near, near_weight}, {far, far_weight}};
    for (std::size_t i = 0; i < 5; ++i) {
      axial_[i] = {d_.EA * axial[i][1] * le_ / 2, firstDerivatives<Real>((1 + axial[i][0]) / 2)};
    }
    const Real third = sqrt(Real(3) / 5);
    const Real bending[3][2] = {{-third, Real(5) / 9}, {0, Real(8) / 9}, {third, Real(5) / 9}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Real xi = (1 + bending[i][0]) / 2;
      bending_[i] = {d_.EI * bending[i][1] * le_ / 2, firstDerivatives<Real>(xi), secondDerivatives<Real>(xi)};
    }
  }

  AncfData<Real> d_;
  Real le_;
  Index nu_ = 0;
  std::vector<Index> unknown_;  // by coordinate: its index in u, or kFixed if the support fixes it
  std::array<Axial, 5> axial_;
  std::array<Bending, 3> bending_;
  std::array<Shape, 4> mass_;  // mass matrix of an element for one direction
  Shape weight_;
};

}  // namespace irk
