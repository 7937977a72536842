// Evaluates the matrices D0 = dr/d(a,k,z), D1 = dr/d(v,x,.), D2 = dr/d(u,.,.).
#pragma once

#include <memory>
#include <vector>

#include "core/derivatives/colouring.h"
#include "core/derivatives/point_buffers.h"
#include "core/options/catalogue.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The three matrices at one point; their values are in the order of the pattern.
template <class Real>
struct Linearization {
  std::shared_ptr<const Pattern> pattern;
  Vec<Real> d0, d1, d2;

  /// Has no pattern yet; the first evaluation sets it.
  Linearization() = default;
  explicit Linearization(std::shared_ptr<const Pattern> p)
      : pattern(std::move(p)), d0(Vec<Real>::Zero(pattern->nonzeros())), d1(d0), d2(d0) {}
  using DenseView = Eigen::Map<const Mat<Real>>;
  /// The matrices as n x n views; the pattern must be full.
  DenseView dense0() const { return {d0.data(), pattern->n, pattern->n}; }
  DenseView dense1() const { return {d1.data(), pattern->n, pattern->n}; }
  DenseView dense2() const { return {d2.data(), pattern->n, pattern->n}; }
};

/// Sets entries of the matrices to zero, or replaces them, after they have been evaluated.
template <class Real>
using JacobianChange = std::function<void(const Sizes&, Linearization<Real>&)>;

/// A simplification of the Jacobian.
template <>
struct Strategy<JacobianTerms> {
  JacobianTerms id;
  std::string meaning;
  Needs needs = {};
  bool mass_without_vxz = false;  ///< derivatives with respect to v, x and z are taken at a = 0
  bool mass_without_u = false;    ///< those with respect to u are
  bool stiffness_once = false;    ///< dF2/du is kept for the whole integration
  PerScalar<JacobianChange> change = {};
};
template <>
Catalogue<JacobianTerms>& catalogue<JacobianTerms>();

/// Which matrices a Differentiator evaluates; the others stay zero.
enum class Matrices { kAll, kOnlyD0 };

/// Below this many unknowns no pattern is searched: each column is a direction of its own. From this number on
/// `automatic` storage is sparse if at most the part kSparseFill of the matrix is filled. Measured: at n = 16 a
/// sparse factorization takes two fifths of the time of a dense one for beam_chain (5 entries per row), at n = 18
/// three fifths for ANCF elements (12 per row).
inline constexpr Index kSparseFrom = 16;
inline constexpr double kSparseFill = 0.5;

/// What an evaluation writes on the way to its result. Differentiators of systems of equal sizes that never evaluate at
/// the same time may share it: with many unknowns it is larger than the matrices.
template <class Real>
struct DifferentiatorScratch {
  DifferentiatorScratch(const Sizes& n, DerivativeSource of)
      : source(of),
        dual(of == DerivativeSource::kAutomatic ? n : Sizes{}),
        real(of == DerivativeSource::kAutomatic ? Sizes{} : n),
        base(real.r.size()),
        expected(n.n()),
        magnitude(n.n()) {}
  DerivativeSource source;
  PointBuffers<Dual<Real>> dual;
  std::vector<PointBuffers<Dual<Real>>> others;  ///< for the other threads
  PointBuffers<Real> real;
  Vec<Real> base;
  Vec<Real> expected, magnitude;  ///< by row, for the check: the sum of its terms, and of their magnitudes
};

/// Evaluates Linearizations of one system. The first evaluation finds the pattern and colours it; from then on the
/// number of directions depends on the fullest row, not on n. Every evaluation compares the derivative along one
/// random combination of all directions with the assembled matrices. If they differ, for example after a switch of
/// modes, the pattern is searched again and grows. Use one object, and one scratch, per thread. Allocates only when the
/// pattern changes. Exact derivatives are evaluated on several threads if asked for: each evaluation of r needs buffers
/// of its own, nine numbers for each component.
template <class Real>
class Differentiator {
 public:
  using Scratch = DifferentiatorScratch<Real>;

  /// Keeps a reference to the system. Makes its own scratch if none is given. Throws Misuse for storage `sparse` in
  /// multiprecision, and for a scratch of another source.
  Differentiator(const System<Real>& system, DerivativeSource source, JacobianTerms terms = JacobianTerms::kFull,
                 Storage storage = Storage::kDense, Matrices matrices = Matrices::kAll,
                 std::shared_ptr<Scratch> scratch = nullptr, int threads = 1);
  const std::shared_ptr<Scratch>& scratch() const { return scratch_; }

  /// The pattern of the matrices, which is searched near p unless it is known.
  const std::shared_ptr<const Pattern>& pattern(Level level, const Point<Real>& p);
  /// Evaluates the matrices at p. `out` gets the present pattern if it has another one. Derivatives that are not
  /// finite appear as NaN in `out`.
  void evaluate(Level level, const Point<Real>& p, Linearization<Real>& out);
  /// Forgets the matrix that `constant_stiffness` keeps; for a new mode.
  void forget() { stiffness_known_ = false; }
  /// Forgets the pattern as well; for a new integration.
  void forgetPattern();

  /// The present pattern. Null before the first evaluation if the pattern may be sparse.
  const std::shared_ptr<const Pattern>& pattern() const { return pattern_; }
  /// Number of directional derivatives per evaluation; 0 before the first evaluation if a pattern is searched.
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
  void evaluateGroup(const Group& group, Level level, const Point<Real>& p, Linearization<Real>& out);
  PointBuffers<Dual<Real>>& dualOf(std::size_t i) { return i == 0 ? scratch_->dual : scratch_->others[i - 1]; }
  static std::size_t evaluationsOf(const ColouredDirections& group);
  void reserveForThreads();
  void evaluateAlong(const ColouredDirections& group, std::size_t first, Level level, PointBuffers<Dual<Real>>& at);
  void evaluateDual(const ColouredDirections& group, Level level, const Point<Real>& p, Linearization<Real>& out);
  void evaluateDifferences(const ColouredDirections& group, Level level, Linearization<Real>& out);
  template <class Change>
  void take(const ColouredDirections& group, std::size_t colour, const Change& change, Linearization<Real>& out);
  template <class Change>
  void check(const Change& change, Linearization<Real>& out);
  void keepStiffness(Linearization<Real>& out);

  const System<Real>& system_;
  DerivativeSource source_;
  Sizes sizes_;
  const Strategy<JacobianTerms>& terms_;
  Storage storage_;
  int threads_;
  Group at_a_, at_zero_;  // directions differentiated at the point's a, and at a = 0
  Group stiffness_;       // directions of D2 that `constant_stiffness` evaluates only once
  std::shared_ptr<const Pattern> pattern_;
  bool looked_ = false;      // the pattern has been searched
  bool incomplete_ = false;  // the check of the last evaluation has failed
  double check_tolerance_ = 0;
  Vec<Real> kept_stiffness_;  // values of D2
  bool stiffness_known_ = false;
  Real t_{};
  std::shared_ptr<Scratch> scratch_;
  Vec<Real> zero_a_;
  Vec<Real> y_, delta_;  // by direction: the component and its increment
};

}  // namespace irk
