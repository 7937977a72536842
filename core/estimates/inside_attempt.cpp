#include "core/estimates/inside_attempt.h"

#include <algorithm>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// Stages at equal times do not determine a polynomial.
template <class Real>
bool isDetermined(const Vec<Real>& c) {
  const Real tiny = Real(1000) * Eigen::NumTraits<Real>::epsilon();
  for (Index i = 0; i < c.size(); ++i) {
    for (Index j = 0; j < i; ++j) {
      if (c[i] - c[j] < tiny && c[j] - c[i] < tiny) return false;
    }
  }
  return true;
}

}  // namespace

template <class Real>
InsideAttempt<Real>::InsideAttempt(const System<Real>& system)
    : system_(system), dense_(system.sizes()), inside_(system.sizes()) {}

template <class Real>
bool InsideAttempt<Real>::begin(const State<Real>& from, const Real& end, const State<Real>& to,
                                const StepPieces<Real>& pieces) {
  pieces_ = pieces;
  pieces_.at[0].from = &from;
  piece_ = pieces.count;
  end_ = end;
  to_ = &to;
  return isDetermined(pieces.at[0].stages->scheme->c);
}

template <class Real>
State<Real> InsideAttempt<Real>::at(const Real& t) {
  const State<Real>& from = *pieces_.at[0].from;
  if (t >= end_) return *to_;
  if (t <= from.t) return system_.toScene(from);
  std::size_t i = pieces_.count - 1;
  while (i > 0 && t < pieces_.at[i].from->t) --i;
  const StepPiece<Real>& piece = pieces_.at[i];
  if (i != piece_) dense_.begin(*piece.from, *piece.stages);
  piece_ = i;
  const Real theta = (t - piece.from->t) / piece.stages->h;
  dense_.evaluate(std::min(theta, Real(1)), inside_);
  return system_.toScene(inside_);
}

IRK_INSTANTIATE_CLASS(InsideAttempt)

}  // namespace irk
