#include "experiments/runs/peers/sundials.h"

#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace irk::sundials {
namespace {

// SUNDIALS is built with 32 or with 64 bits per index.
sunindextype indexOf(Index n) { return static_cast<sunindextype>(n); }

}  // namespace

Workspace::Workspace(Index n) : y_(N_VNew_Serial(indexOf(n), context_)) {
#if SUNDIALS_VERSION_MAJOR >= 7
  const auto keep = [](int, const char*, const char*, const char* text, SUNErrCode, void* to, SUNContext) {
    *static_cast<std::string*>(to) = text ? text : "";
  };
  SUNContext_ClearErrHandlers(context_);
  SUNContext_PushErrHandler(context_, keep, &message_);
#endif
}

N_Vector Workspace::add(const Vec<double>& values) {
  more_.emplace_back(N_VClone(y_.get()));
  std::copy(values.begin(), values.end(), N_VGetArrayPointer(more_.back().get()));
  return more_.back().get();
}

namespace {

// Whether a banded solver is faster than a sparse one: if half of the band is filled, both do about the same work, but
// the banded solver needs no indices.
bool isBanded(const PeerPattern& pattern) {
  const Index band = (pattern.lower + pattern.upper + 1) * pattern.n;
  return band <= 2 * static_cast<Index>(pattern.row.size());
}

bool samePattern(const PeerPattern& a, const PeerPattern& b) {
  return a.full == b.full && a.column_start == b.column_start && a.row == b.row;
}

}  // namespace

bool Workspace::choose(const std::shared_ptr<const PeerPattern>& pattern) {
  if (pattern_ && (pattern_ == pattern || samePattern(*pattern_, *pattern))) return false;
  pattern_ = pattern;
  const sunindextype n = indexOf(pattern->n);
  solver_.reset();
  if (pattern->full) {
    matrix_.reset(SUNDenseMatrix(n, n, context_));
    solver_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
  } else if (isBanded(*pattern)) {
    matrix_.reset(SUNBandMatrix(n, indexOf(pattern->upper), indexOf(pattern->lower), context_));
    solver_.reset(SUNLinSol_Band(y_.get(), matrix_.get(), context_));
  } else {
    matrix_.reset(SUNSparseMatrix(n, n, indexOf(static_cast<Index>(pattern->row.size())), CSC_MAT, context_));
    solver_.reset(SUNLinSol_KLU(y_.get(), matrix_.get(), context_));
    constexpr int kAmd = 0;  // as our own factors; the default, COLAMD, fills more where the pattern is symmetric
    SUNLinSol_KLUSetOrdering(solver_.get(), kAmd);
  }
  return true;
}

bool Workspace::fill(const PeerJacobian& J, SUNMatrix to) const {
  const PeerPattern& pattern = *J.pattern;
  if (J.pattern != pattern_ && !samePattern(pattern, *pattern_)) return false;
  switch (SUNMatGetID(to)) {
    case SUNMATRIX_DENSE:
      J.writeFull(SUNDenseMatrix_Data(to), pattern.n);
      return true;
    case SUNMATRIX_BAND:
      SUNMatZero(to);
      J.forEach([to](Index i, Index j, double value) { SM_ELEMENT_B(to, i, j) = value; });
      return true;
    default:
      std::copy(pattern.column_start.begin(), pattern.column_start.end(), SUNSparseMatrix_IndexPointers(to));
      std::copy(pattern.row.begin(), pattern.row.end(), SUNSparseMatrix_IndexValues(to));
      std::copy(J.values.begin(), J.values.end(), SUNSparseMatrix_Data(to));
      return true;
  }
}

int statusOfRoots(double t, const double* g, Index count) {
  const bool finite = std::isfinite(t) && std::all_of(g, g + count, [](double value) { return std::isfinite(value); });
  return finite ? 0 : -1;
}

Outcome outcomeOf(int flag) {
  switch (flag) {
    case -1:
      return Outcome::kMaxSteps;
    case -2:  // the tolerance is below round-off
    case -3:
      return Outcome::kStepTooSmall;
    case -4:
      return Outcome::kNewtonFailed;
    case -5:
    case -6:
    case -7:
      return Outcome::kSingular;
    default:
      return flag < 0 ? Outcome::kNotFinite : Outcome::kSuccess;
  }
}

void require(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string(call) + " = " + std::to_string(flag));
}

void keepMessage(int, const char*, const char*, char* text, void* to) { *static_cast<std::string*>(to) = text; }

}  // namespace irk::sundials
