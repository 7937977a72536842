// The linear systems of Newton's method: block (i, j) = delta_ij D0 + h A_ij D1 + h^2 (A^2)_ij D2.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/derivatives/differentiator.h"
#include "core/linear/block_form.h"
#include "core/linear/sparse_lu.h"
#include "core/options/catalogue.h"
#include "irk/options.h"
#include "irk/outcome.h"
#include "irk/statistics.h"

namespace irk {

/// What a stage solver needs to know when it is built.
template <class Real>
struct StageSolverSetup {
  Mat<Real> A;  ///< of the implicit stages, s x s
  std::shared_ptr<const Pattern> pattern;
  std::span<const int> row_powers;  ///< of the system: row i of every block is multiplied by h^-power[i]
  Sizes sizes;
  int threads = 1;  ///< for factorizations and solutions of independent blocks
  /// Of the pattern, where it is sparse, and of A; each made anew where it is missing.
  std::shared_ptr<const SparseAnalysis> analysis = nullptr;
  std::shared_ptr<const BlockForm<Real>> form = nullptr;
};

/// Owns its factors and scratch: one per thread. Allocates only in its constructor; sparse ones also where new pivots
/// fill much more, and where blocks have no common order of pivots for the first time.
template <class Real>
class StageSolver {
 public:
  virtual ~StageSolver() = default;

  /// From one linearization shared by all stages, or (coupled solvers) one per stage.
  /// kSuccess, kSingular, or kNotFinite. After a failure `solve` must not be called.
  [[nodiscard]] virtual Outcome factorize(std::span<const Linearization<Real>> at, const Real& h) = 0;

  /// In place: right-hand side (scaled rows) to solution, n x s, column j = stage j.
  virtual void solve(Eigen::Ref<Mat<Real>> rhs) = 0;

  /// Solves with D0 + h mu D1 + h^2 mu^2 D2, x of n entries in place, where that system of a real mu is
  /// one of those it has factorized; else false, and x as it was.
  [[nodiscard]] virtual bool solveReal(const Real& mu, Real* x) {
    static_cast<void>(mu);
    static_cast<void>(x);
    return false;
  }
};

template <class Real>
using BlockFormMaker = std::function<std::shared_ptr<const BlockForm<Real>>(const Mat<Real>& A)>;
template <class Real>
using StageSolverMaker = std::function<std::unique_ptr<StageSolver<Real>>(const StageSolverSetup<Real>&)>;

/// A stage solver.
template <>
struct Strategy<StageSolverKind> {
  StageSolverKind id;
  std::string meaning;
  Needs needs = {};
  bool coupled = false;                   ///< takes one linearization per stage, or one for all
  Storage storage = Storage::kAutomatic;  ///< the only one it has; kAutomatic: that of the options
  PerScalar<BlockFormMaker> form = {};    ///< of A, with which `make` needs its setup; empty for coupled ones
  PerScalar<StageSolverMaker> make;
};
template <>
Catalogue<StageSolverKind>& catalogue<StageSolverKind>();

/// Sparse where the pattern is; the coupled kinds have their own storage. Throws Misuse where the kind cannot treat A
/// (see makeBlockForm) or the pattern.
template <class Real>
std::unique_ptr<StageSolver<Real>> makeStageSolver(StageSolverKind kind, const StageSolverSetup<Real>& setup);

/// The form of A that a decoupled solver works in; null for a coupled one. Throws Misuse for `eigen` with a defective
/// A.
template <class Real>
std::shared_ptr<const BlockForm<Real>> makeBlockForm(StageSolverKind kind, const Mat<Real>& A);

/// What the solver of the options stores: the coupled ones have a storage of their own.
Storage storageOf(const IntegratorOptions& options);

/// What a solver is for: the stages' Newton matrix, or the filter of an error estimate (Counters::filter_solves).
enum class SolverOf { kStages, kFilter };

/// Counts the factorizations and solves of a solver; see StageSolver.
template <class Real>
class CountedStageSolver {
 public:
  CountedStageSolver(std::unique_ptr<StageSolver<Real>> solver, Counters& counters, SolverOf of = SolverOf::kStages)
      : solver_(std::move(solver)), counters_(counters), of_(of) {}
  [[nodiscard]] Outcome factorize(std::span<const Linearization<Real>> at, const Real& h) {
    ++(of_ == SolverOf::kStages ? counters_.factorizations : counters_.filter_factorizations);
    return solver_->factorize(at, h);
  }
  void solve(Eigen::Ref<Mat<Real>> rhs) {
    ++(of_ == SolverOf::kStages ? counters_.solves : counters_.filter_solves);
    solver_->solve(rhs);
  }
  [[nodiscard]] bool solveReal(const Real& mu, Real* x) {
    const bool solved = solver_->solveReal(mu, x);
    counters_.filter_solves += solved;
    return solved;
  }

 private:
  std::unique_ptr<StageSolver<Real>> solver_;
  Counters& counters_;
  SolverOf of_;
};

/// Whether any row is multiplied by a power of h.
inline bool scalesRows(std::span<const int> powers) {
  return std::any_of(powers.begin(), powers.end(), [](int power) { return power != 0; });
}
/// h^-power per row.
template <class Real>
void rowScales(std::span<const int> powers, const Real& h, Vec<Real>& scales) {
  for (std::size_t i = 0; i < powers.size(); ++i) {
    Real f(1);
    for (int p = 0; p < powers[i]; ++p) f = f / h;
    scales[static_cast<Index>(i)] = f;
  }
}

}  // namespace irk
