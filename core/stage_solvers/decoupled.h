// Stage solvers that use a basis in which A is block triangular or block diagonal. There the Newton matrix splits
// into about s/2 complex systems D0 + h mu D1 + h^2 mu^2 D2 of size n, where mu is an eigenvalue of A. HW II (IV.8).
#pragma once

#include <complex>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/base/recycled.h"
#include "core/linear/block_form.h"
#include "core/linear/dense_lu.h"
#include "core/linear/interleaved_lu.h"
#include "core/linear/sparse_lu.h"
#include "core/stage_solvers/block_inverses.h"
#include "core/stage_solvers/stage_solver.h"

namespace irk {

/// Lu is DenseLu or SparseLu; one sparse analysis serves for all blocks and step sizes. Contracts: StageSolver.
template <class Real, template <class> class Lu>
class Decoupled final : public StageSolver<Real>, public Recycled {
 public:
  explicit Decoupled(const StageSolverSetup<Real>& setup);  ///< setup.form must exist
  Outcome factorize(std::span<const Linearization<Real>> at, const Real& h) override;
  void solve(Eigen::Ref<Mat<Real>> rhs) override;
  bool solveReal(const Real& mu, Real* x) override;

 private:
  using Complex = std::complex<Real>;
  static constexpr bool kSparse = std::is_same_v<Lu<Real>, SparseLu<Real>>;
  static constexpr bool kInverts = !kSparse && std::is_same_v<Real, double>;  // blocks, if they have few unknowns
  void makeFactors();
  bool factorizeTogether();
  Outcome factorizeBlock(std::size_t index);
  template <class Size>
  void coupleRows(const typename BlockForm<Real>::Block& block, Size n);
  // Not inlined: in this context the compiler would contract other products and sums of `solveByInverses`.
  template <class Size>
  [[gnu::noinline]] void multiply(Index column, Size n);
  void solveBlocks();
  void solveBlock(std::size_t index);
  template <class Size>
  void solveByInverses(Real* rhs, Index stride, Size n);

  StageSolverSetup<Real> setup_;
  const BlockForm<Real>& form_;  // of setup_
  // Factors of the real blocks and of the complex pairs, in their order. None where blocks are inverted, and none for
  // sparse blocks as long as one order of pivots serves all of them.
  std::vector<Lu<Real>> real_lu_;
  std::vector<Lu<Complex>> complex_lu_;
  std::vector<std::size_t> lu_index_;  // by block: its index in real_lu_ or complex_lu_
  // Right-hand sides of complex blocks: one for each block where blocks do not couple, else one for all.
  std::vector<Vec<Complex>> eta_;
  // Sparse blocks: the pivots of the first block, offered to the others. Copied at the beginning of a factorization;
  // in the very first one, after the first block is factorized.
  SparsePivots pivots_;
  int version_ = 0;                        // of pivots_
  bool news_ = false;                      // pivots_ have changed since the last factorization
  std::optional<InterleavedLu> together_;  // all factors, if the blocks are sparse and do not couple
  std::vector<std::size_t> lane_block_;    // the lanes' blocks, real ones first
  std::vector<InterleavedLu::Lane> lanes_;
  std::vector<Complex> lane_m_;            // h mu
  bool gathered_ = false;                  // together_ holds the present factors
  int apart_ = 0;                          // factorizations until the blocks are tried together again
  std::vector<Outcome> outcomes_;          // by block
  std::optional<BlockInverses> inverses_;  // instead of factors, where they are faster
  const Linearization<Real>* at_ = nullptr;
  Real h_{};
  Vec<Real> scales_;
  Mat<Real> Y_;          // transformed right-hand side and solution, n x s
  Mat<Real> D1Y_, D2Y_;  // D1 and D2 times the solved columns of Y (Schur form only)
};

}  // namespace irk
