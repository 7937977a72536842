// D0 = dr/d(a,k,z), D1 = dr/d(v,x,.), D2 = dr/d(u,.,.) and where they come from.
#pragma once

#include <memory>
#include <vector>

#include "core/system.h"

namespace irk {

/// Compressed columns shared by D0, D1 and D2 (the union of their patterns), so that
/// D0 + mu D1 + mu^2 D2 is one combination of three value arrays. A full pattern is the dense case:
/// its value array is the column-major n x n matrix itself.
struct Pattern {
  Index n = 0;
  bool full = true;
  std::vector<int> column_start;  ///< n + 1
  std::vector<int> row;           ///< column_start[n]

  static std::shared_ptr<const Pattern> dense(Index n);
  Index nonzeros() const { return static_cast<Index>(row.size()); }
};

/// The three matrices at one point, values in the order of the pattern.
template <class Real>
struct Linearization {
  std::shared_ptr<const Pattern> pattern;
  Vec<Real> d0, d1, d2;

  explicit Linearization(std::shared_ptr<const Pattern> p)
      : pattern(std::move(p)),
        d0(Vec<Real>::Zero(pattern->nonzeros())),
        d1(d0),
        d2(d0) {}
  using DenseView = Eigen::Map<const Mat<Real>>;
  /// n x n views; the pattern must be full.
  DenseView dense0() const { return {d0.data(), pattern->n, pattern->n}; }
  DenseView dense1() const { return {d1.data(), pattern->n, pattern->n}; }
  DenseView dense2() const { return {d2.data(), pattern->n, pattern->n}; }
};

enum class DerivativeSource { kAutomatic, kCentral, kForward };

/// What is left out of (D0, D1, D2), paper (4.4)-(4.8). M a enters the residual linearly in a, so
/// its derivatives are left out by differentiating at a = 0.
enum class JacobianTerms {
  kFull,
  kNoMassVxz,          ///< (4.4): without d(M a)/d(v, x, z)
  kNoConstraintXz,     ///< (4.5): without dG/d(x, z)
  kNoMass,             ///< (4.8) and (4.4): without d(M a)/d(u, v, x, z)
  kConstantStiffness,  ///< (4.7): dF2/du evaluated once
};

/// Evaluates a Linearization. Owns scratch: one per thread. Allocates only in its constructor.
template <class Real>
class Differentiator {
 public:
  /// Keeps a reference to the system.
  Differentiator(const System<Real>& system, DerivativeSource source,
                 JacobianTerms terms = JacobianTerms::kFull);

  /// All three matrices at p; the pattern of `out` must be full (dense) here.
  void evaluate(Level level, const Point<Real>& p, Linearization<Real>& out);
  /// Forgets what `constant_stiffness` keeps: a new integration.
  void forget() { stiffness_known_ = false; }

 private:
  struct Direction {
    int matrix;    // 0, 1, 2: which D the column belongs to
    Index column;  // in 0..n-1
  };
  using Directions = std::vector<Direction>;
  template <class T>
  struct Buffers {  // the numbers below a Point, and the residual
    Vec<T> u, v, x, w, d, r;
    explicit Buffers(const Sizes& n);
    Point<T> point(const Sizes& n, const T& t) const;
    /// The component that a direction perturbs.
    T& component(const Direction& along, const Sizes& n);
  };
  void evaluateGroup(const Directions& group, Level level, const Point<Real>& p,
                     Linearization<Real>& out);
  void evaluateDual(const Directions& group, Level level, Linearization<Real>& out);
  void evaluateDifferences(const Directions& group, Level level, Linearization<Real>& out);
  void dropConstraintXz(Linearization<Real>& out) const;
  void keepStiffness(Linearization<Real>& out);
  void store(const Direction& d, Index row, const Real& value, Linearization<Real>& out) const;

  const System<Real>& system_;
  DerivativeSource source_;
  Sizes sizes_;
  JacobianTerms terms_;
  Directions at_a_, at_zero_;  // differentiated at the point's a, at a = 0
  Directions stiffness_;       // D2, where `constant_stiffness` may evaluate it only once
  Mat<Real> kept_stiffness_;   // nu x nu
  bool stiffness_known_ = false;
  Real t_{};
  Buffers<Dual<Real>> dual_;
  Buffers<Real> real_;
  Vec<Real> base_;
  Vec<Real> zero_a_;
};

}  // namespace irk
