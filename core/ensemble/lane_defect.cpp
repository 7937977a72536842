// What eight solved steps miss where no stage looks, see Defect.
#include <algorithm>
#include <limits>

#include "core/ensemble/lane_mask.h"
#include "core/ensemble/lane_stages.h"

namespace irk {

LaneMask LaneStages::raise(const LaneMask& which) {
  LaneMask raised;
  for (std::size_t i = 0; i < count(n_); ++i) {
    const Lanes size = abs(e_[i]);
    const LaneMask larger = ~lessOrEqual(size, most_[i]) & which;  // or not a number
    most_[i] = select(larger, size, most_[i]);
    raised = raised | larger;
  }
  return raised;
}

Lanes LaneStages::defect(const LanePoints& at, const std::vector<Lanes>& W, const LaneNorm& norm, LaneMatrix& matrix,
                         const LaneMask& which, bool first, LaneCounters& counters) {
  if (first) std::fill(most_.begin(), most_.end(), Lanes(0.0));
  const auto weights = [&](ConstVec<double> MovingPoints<double>::Point::*of, Index j) {
    return Lanes::each([&](std::size_t i) { return at[i] ? ((*at[i]).*of)[j] : 0.0; });
  };
  const Lanes theta = Lanes::each([&](std::size_t i) { return at[i] ? at[i]->theta : 0.0; });
  std::fill(defect_.begin(), defect_.end(), Lanes(0.0));
  std::fill(at_.begin(), at_.end(), Lanes(0.0));
  for (Index j = 0; j < s_; ++j) {
    const Lanes inside = weights(&MovingPoints<double>::Point::inside, j),
                once = weights(&MovingPoints<double>::Point::once, j),
                twice = weights(&MovingPoints<double>::Point::twice, j);
    const Lanes* const w = W.data() + j * n_;
    for (std::size_t i = 0; i < count(n_); ++i) defect_[i] += inside * w[i];
    for (std::size_t i = 0; i < nu_; ++i) at_[i] += twice * w[i];
    for (std::size_t i = 0; i < nu_ + nx_; ++i) at_[nu_ + i] += once * w[i];
  }
  const Lanes *const y = from_->y.data(), *const v = y + nu_;
  for (std::size_t i = 0; i < nu_; ++i) at_[i] = y[i] + h_ * (theta * v[i] + h_ * at_[i]);
  for (std::size_t i = nu_; i < at_.size(); ++i) at_[i] = y[i] + h_ * at_[i];
  std::fill(slip_.begin(), slip_.end(), Lanes(0.0));
  const Lanes t = from_->t + theta * h_;
  const auto filtered = [&](const LaneMask& lanes) {
    filter(matrix);
    for (std::size_t i = 0; i < nz_; ++i) error_[at_.size() + i] = 0.0;
    counters.solves.add(lanes);
    const Lanes size = sizeOfError(norm);
    return select(finite(size), size, std::numeric_limits<double>::infinity());
  };
  evaluate(t, Between::kStages);
  counters.residuals.add(which);
  const LaneMask raised = raise(which);
  if (!raised.any()) return Lanes(0.0);
  const Lanes once_filtered = select(raised, filtered(raised), Lanes(0.0));
  const LaneMask again = less(1.0, once_filtered) & raised;
  if (!again.any()) return once_filtered;
  for (std::size_t i = 0; i < at_.size(); ++i) at_[i] += error_[i];
  evaluate(t, Between::kStages);
  counters.residuals.add(again);
  return select(again, filtered(again), once_filtered);
}

}  // namespace irk
