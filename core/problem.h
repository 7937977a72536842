// From a user's struct to a System: the formulation of its position constraints.
//
// A problem is one struct of about 30 lines:
//
//   struct Pendulum {
//     double m = 1, l = 1, g = 9.81;
//     Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
//     template <class T>
//     void residual(const Point<T>& p, Rows<T> r) const {      // F2 - M a - G^T lambda
//       r.u[0] = -m * p.a[0] - p.u[0] * p.z[0];
//       r.u[1] = -m * p.a[1] - m * g - p.u[1] * p.z[0];
//     }
//     template <class T, class U, class G>
//     void constraints(const T& t, const U& u, G&& g) const {   // g(t, u), index 3
//       g[0] = (u[0] * u[0] + u[1] * u[1] - l * l) * 0.5;
//     }
//   };
//
// Write `using std::sin;` and unqualified calls; T is double, a dual
// number or a multiprecision number. Branches may compare values of T.
#pragma once

#include <memory>
#include <utility>

#include "core/system.h"

namespace irk {

/// How position constraints g(t, u) = 0 enter. Design, section 3.
enum class Formulation { kIndex3, kIndex2 };

/// Whether constraint rows are multiplied by 1/h^power (paper, section 4). Off only to show why.
enum class ConstraintScaling { kOn, kOff };

/// Views of the residual rows that a problem writes. z: the nz - constraints rows of the algebraic
/// equations that are not position constraints.
template <class T>
struct Rows {
  VecView<T> u, x, z;
};

namespace detail {

// g(t, u(t)) with u' = v: views that hand out and take in rates without storing a vector of them.
template <class T>
struct VelocityView {
  const ConstVec<T>& u;
  const ConstVec<T>& v;
  Rate<T> operator[](Index i) const { return {u[i], v[i]}; }
};
template <class T>
struct AccelerationView {
  const ConstVec<T>& u;
  const ConstVec<T>& v;
  const ConstVec<T>& a;
  Rate<Rate<T>> operator[](Index i) const { return {{u[i], v[i]}, {v[i], a[i]}}; }
};

// g[i] = expression stores only the wanted derivative.
template <class T>
struct RateSink {
  T& out;
  void operator=(const Rate<T>& g) { out = g.d[0]; }
};
template <class T>
struct SecondRateSink {
  T& out;
  void operator=(const Rate<Rate<T>>& g) { out = g.d[0].d[0]; }
};
template <class Sink, class T>
struct SinkRow {
  T* data;
  Sink operator[](Index i) const { return Sink{data[i]}; }
};

}  // namespace detail

/// A problem struct P in one formulation, over one scalar.
template <class P, class Real>
class ProblemSystem final : public System<Real> {
 public:
  ProblemSystem(P problem, Formulation formulation, ConstraintScaling scaling)
      : problem_(std::move(problem)), formulation_(formulation), sizes_(problem_.sizes()) {
    const bool index3 = formulation == Formulation::kIndex3;
    row_powers_.assign(static_cast<std::size_t>(sizes_.n()), 0);
    error_powers_.u.assign(static_cast<std::size_t>(sizes_.nu), 0);
    error_powers_.v.assign(static_cast<std::size_t>(sizes_.nu), index3 && hasConstraints() ? 1 : 0);
    error_powers_.x.assign(static_cast<std::size_t>(sizes_.nx), 0);
    error_powers_.z.assign(static_cast<std::size_t>(sizes_.nz), 0);
    for (Index i = 0; i < sizes_.constraints; ++i) {
      if (scaling == ConstraintScaling::kOn) {
        row_powers_[static_cast<std::size_t>(sizes_.nu + sizes_.nx + i)] = index3 ? 2 : 1;
      }
      error_powers_.z[static_cast<std::size_t>(i)] = index3 ? 2 : 1;
    }
  }

  Sizes sizes() const override { return sizes_; }
  void evaluate(Level level, const Point<Real>& p, VecView<Real> r) const override {
    evaluateAt(level, p, r);
  }
  void evaluate(Level level, const Point<Dual<Real>>& p, VecView<Dual<Real>> r) const override {
    evaluateAt(level, p, r);
  }
  const std::vector<int>& rowPowers() const override { return row_powers_; }
  const ErrorPowers& errorPowers() const override { return error_powers_; }
  State<Real> fromScene(const State<Real>& scene) const override { return scene; }
  State<Real> toScene(const State<Real>& state) const override { return state; }

 private:
  bool hasConstraints() const { return sizes_.constraints > 0; }

  template <class T>
  void evaluateAt(Level level, const Point<T>& p, VecView<T> r) const {
    const Index nc = sizes_.constraints;
    T* g = r.data() + sizes_.nu + sizes_.nx;
    problem_.residual(p, Rows<T>{VecView<T>(r.data(), sizes_.nu),
                                 VecView<T>(r.data() + sizes_.nu, sizes_.nx),
                                 VecView<T>(g + nc, sizes_.nz - nc)});
    if constexpr (requires(T* out) { problem_.constraints(p.t, p.u, out); }) {
      if (nc == 0) return;
      switch (constraintLevel(level)) {
        case Level::kFormulated:
        case Level::kPosition:
          problem_.constraints(p.t, p.u, g);
          return;
        case Level::kVelocity: {
          const Rate<T> t{p.t, T(1.0)};
          problem_.constraints(t, detail::VelocityView<T>{p.u, p.v},
                               detail::SinkRow<detail::RateSink<T>, T>{g});
          return;
        }
        case Level::kAcceleration: {
          const Rate<Rate<T>> t{{p.t, T(1.0)}, {T(1.0), T(0.0)}};
          problem_.constraints(t, detail::AccelerationView<T>{p.u, p.v, p.a},
                               detail::SinkRow<detail::SecondRateSink<T>, T>{g});
          return;
        }
      }
    }
  }

  Level constraintLevel(Level level) const {
    if (level != Level::kFormulated) return level;
    switch (formulation_) {
      case Formulation::kIndex3: return Level::kPosition;
      case Formulation::kIndex2: return Level::kVelocity;
    }
    return level;
  }

  P problem_;
  Formulation formulation_;
  Sizes sizes_;
  std::vector<int> row_powers_;
  ErrorPowers error_powers_;
};

template <class Real, class P>
std::shared_ptr<const System<Real>> makeSystem(
    P problem, Formulation formulation = Formulation::kIndex2,
    ConstraintScaling scaling = ConstraintScaling::kOn) {
  return std::make_shared<const ProblemSystem<P, Real>>(std::move(problem), formulation, scaling);
}

}  // namespace irk
