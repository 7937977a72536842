// Inverses of the blocks of a decoupled Newton matrix with few unknowns.
#pragma once

#include <span>
#include <type_traits>

#include "core/derivatives/differentiator.h"
#include "core/linear/block_form.h"
#include "core/linear/padded_inverse.h"
#include "irk/outcome.h"

namespace irk {

/// The inverses of the dense blocks M = D0 + h mu D1 + h^2 mu^2 D2, mu an eigenvalue of A. Allocates in its constructor
/// only. Different threads may work on different blocks.
class BlockInverses {
 public:
  /// Whether inverses of n x n blocks for s stages are faster than factors. With one stage the blocks are real.
  /// Measured then, factors and one substitution against inverse and one product: 21 and 36 ns for n = 3, 49 and 46 for
  /// n = 4, 179 and 89 for n = 8.
  static bool pay(Index n, Index s) { return n > 0 && n <= kMostInverted && (s > 1 || n > 3); }

  /// Keeps a reference to the form and a view of the powers, see StageSolverSetup.
  BlockInverses(const BlockForm<double>& form, std::span<const int> row_powers, Index n);

  /// Inverts M of this block, whose rows are multiplied by `scales`. Returns kSuccess, kSingular or kNotFinite.
  [[nodiscard]] Outcome invert(std::size_t block, const Linearization<double>& D, double h, const Vec<double>& scales);

  /// Replaces y by the solution z. Real block: n numbers, M z = y. Complex pair: y = (y1, y2) and z = (z1, z2), 2 n
  /// numbers, M (z1 + i sigma z2) = y1 + i sigma y2. Size: Index, or a constant up to kSmallInverse.
  template <class Size>
  [[gnu::always_inline]] void multiply(std::size_t block, double* y, Size n) {
    const auto& of = form_.blocks[block];
    double* const inverse = inverseOf(block);
    if constexpr (!std::is_same_v<Size, Index>) {
      constexpr Index kSize = Size::value;
      if (of.size == 1) return multiplySmall(inverse, y, n);
      multiplySmall(inverse, y, std::integral_constant<Index, 2 * kSize>());
    } else {
      if (of.size == 1) return multiplyPadded<1>(inverse, n, y);
      double* const z = y + n;
      const double divided = 1 / of.sigma;
      for (Index i = 0; i < n; ++i) z[i] *= of.sigma;
      multiplyPadded<2>(inverse, n, y, z);
      for (Index i = 0; i < n; ++i) z[i] *= divided;
    }
  }

 private:
  double* inverseOf(std::size_t block) { return inverses_.col(static_cast<Index>(block)).data(); }
  Outcome invertPaddedBlock(std::size_t block, const Linearization<double>& D, double h, const Vec<double>& scales);
  // Not inlined: with one function for all sizes transamp, n = 8, takes 1.12 times as long.
  template <int Parts, class Size>
  [[gnu::noinline]] Outcome invertSmallBlock(std::size_t block, const Linearization<double>& D, double h,
                                             const Vec<double>& scales, Size n);

  const BlockForm<double>& form_;
  std::span<const int> row_powers_;
  Index n_;
  // A column for each block: up to kSmallInverse unknowns the matrix that maps (y1, y2) to (z1, z2), else a complex one
  // as padded_inverse.h has it.
  Mat<double> inverses_;
};

}  // namespace irk
