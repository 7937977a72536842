// D0 = dr/d(a,k,z), D1 = dr/d(v,x,.), D2 = dr/d(u,.,.) and where they come from.
#pragma once

#include <memory>
#include <vector>

#include "core/derivatives/colouring.h"
#include "core/derivatives/point_buffers.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The three matrices at one point, values in the order of the pattern.
template <class Real>
struct Linearization {
  std::shared_ptr<const Pattern> pattern;
  Vec<Real> d0, d1, d2;

  /// Without a pattern: the first evaluation brings it.
  Linearization() = default;
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

/// Which matrices a Differentiator evaluates; the others stay zero.
enum class Matrices { kAll, kOnlyD0 };

/// Below this many unknowns no pattern is looked for: every column is a direction of its own. From
/// it on `automatic` storage is sparse where no more than kSparseFill of the pattern is filled.
/// Measured: at n = 16 a sparse factorization takes two fifths of the dense one's time on
/// beam_chain (5 entries a row), at n = 18 three fifths on ANCF elements (12 a row).
inline constexpr Index kSparseFrom = 16;
inline constexpr double kSparseFill = 0.5;

/// Evaluates a Linearization. Its first evaluation finds the pattern, and colours it: then a
/// Jacobian takes as many directions as the fullest row needs, whatever n. Every evaluation
/// compares one random combination of the directions with the assembled matrices; where they
/// differ, as after a switch of modes, the pattern is looked for again and grows. Owns scratch: one
/// per thread. Allocates when its pattern changes, never else.
template <class Real>
class Differentiator {
 public:
  /// Keeps a reference to the system. Throws Misuse for storage `sparse` in multiprecision.
  Differentiator(const System<Real>& system, DerivativeSource source,
                 JacobianTerms terms = JacobianTerms::kFull, Storage storage = Storage::kDense,
                 Matrices matrices = Matrices::kAll);

  /// The matrices at p. `out` takes the present pattern where it has another one.
  void evaluate(Level level, const Point<Real>& p, Linearization<Real>& out);
  /// Forgets what `constant_stiffness` keeps: a new mode.
  void forget() { stiffness_known_ = false; }
  /// Forgets the pattern as well: a new integration.
  void forgetPattern();

  /// Null as long as it is unknown: where it may be sparse, before the first evaluation.
  const std::shared_ptr<const Pattern>& pattern() const { return pattern_; }
  /// Directional derivatives in one evaluation; 0 before the first one.
  std::size_t directions() const;

 private:
  struct Group {
    Directions directions;
    RowSets rows;
    ColouredDirections coloured;
  };
  bool detects() const;
  bool look(Level level, const Point<Real>& p);
  void setPattern();
  void differentiate(Level level, const Point<Real>& p, Linearization<Real>& out);
  void evaluateGroup(const Group& group, Level level, const Point<Real>& p,
                     Linearization<Real>& out);
  void evaluateDual(const ColouredDirections& group, Level level, Linearization<Real>& out);
  void evaluateDifferences(const ColouredDirections& group, Level level,
                           Linearization<Real>& out);
  template <class Change>
  void take(const ColouredDirections& group, std::size_t colour, const Change& change,
            Linearization<Real>& out);
  template <class Change>
  void check(const Change& change, Linearization<Real>& out);
  void dropConstraintXz(Linearization<Real>& out) const;
  void keepStiffness(Linearization<Real>& out);

  const System<Real>& system_;
  DerivativeSource source_;
  Sizes sizes_;
  JacobianTerms terms_;
  Storage storage_;
  Group at_a_, at_zero_;  // differentiated at the point's a, at a = 0
  Group stiffness_;       // D2, where `constant_stiffness` may evaluate it only once
  std::shared_ptr<const Pattern> pattern_;
  bool looked_ = false;
  bool incomplete_ = false;  // the last evaluation's check has failed
  double check_tolerance_ = 0;
  Vec<Real> kept_stiffness_;  // values of D2
  bool stiffness_known_ = false;
  Real t_{};
  PointBuffers<Dual<Real>> dual_;
  PointBuffers<Real> real_;
  Vec<Real> base_;
  Vec<Real> zero_a_;
  Vec<Real> y_, delta_;             // of the directions: the component, its increment
  Vec<Real> expected_, magnitude_;  // of the check, by row
};

}  // namespace irk
