#include "experiments/solution/rows.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "irk/misuse.h"

namespace irk {

std::vector<KeptRow> barred(std::vector<KeptRow> rows, const std::vector<KeptRow>& strict) {
  std::map<double, const KeptRow*> at;
  for (const KeptRow& row : strict) {
    if (row.row.switches.empty()) at[row.row.t] = &row;
  }
  for (KeptRow& row : rows) {
    row.bars.assign(row.values.size(), std::numeric_limits<double>::quiet_NaN());
    const auto other = at.find(row.row.t);
    if (other == at.end() || !row.row.switches.empty()) continue;
    for (std::size_t i = 0; i < row.bars.size(); ++i) row.bars[i] = std::abs(row.values[i] - other->second->values[i]);
  }
  return rows;
}

RunRecord executeWithRows(const RunSpec& spec, const Watch& watch, const RowTimes& times, std::vector<KeptRow>& rows) {
  const auto run = prepare(spec);
  SolutionRows solution(times, resolved(spec).t_end, [&rows](const SolutionRow& row) { rows.emplace_back(row); });
  Watch recording = watch;
  solution.addTo(recording);
  const RunRecord record = run->execute(recording);
  solution.finish(record);
  return record;
}

SolutionRows::SolutionRows(RowTimes times, double t_end, std::function<void(const SolutionRow&)> take)
    : times_(times), t_end_(t_end), take_(std::move(take)) {}

void SolutionRows::addTo(Watch& watch) {
  watch.inside = watch.inside || times_.points > 0;
  watch.accepted = [this, before = watch.accepted](const AcceptedStep& step) {
    if (before) before(step);
    accepted(step);
  };
  watch.switched = [this, before = watch.switched](double t, const std::string& name, std::span<const double> values) {
    if (before) before(t, name, values);
    switched(t, name, values);
  };
}

double SolutionRows::time(int i) const {
  if (i + 1 == times_.points) return t_end_;
  return start_ + (t_end_ - start_) * i / (times_.points - 1);
}

void SolutionRows::show() {
  last_.values = values_;
  take_(last_);
  shown_ = true;
}

// The points before the end of the step.
void SolutionRows::fill(const AcceptedStep& step) {
  const bool backward = t_end_ < start_;
  const auto isInside = [&](double t) { return backward ? t > step.t : t < step.t; };
  for (; next_ < times_.points && isInside(time(next_)); ++next_) {
    if (!step.inside && times_.steps) continue;
    if (!step.inside) {
      throw Misuse("--points: this method gives the solution at the ends of its steps only; leave --points out");
    }
    const double t = time(next_);
    const auto values = step.inside->at(t);
    take_({t, step.h, step.error, step.newton_iterations, "", values, {}});
  }
}

void SolutionRows::accepted(const AcceptedStep& step) {
  if (!std::exchange(started_, true)) start_ = step.t;
  fill(step);
  bool is_point = false;
  for (; next_ < times_.points && time(next_) == step.t; ++next_) is_point = true;
  last_ = {step.t, step.h, step.error, step.newton_iterations, std::exchange(inside_, ""), {}, {}};
  values_.assign(step.values.begin(), step.values.end());
  shown_ = false;
  if (times_.steps || is_point || !last_.switches.empty()) show();
}

void SolutionRows::switched(double t, const std::string& name, std::span<const double> values) {
  if (t > last_.t) {
    inside_ += (inside_.empty() ? "" : "; ") + name;
    return;
  }
  if (!shown_) show();
  values_.assign(values.begin(), values.end());
  last_.switches = name;
  show();
}

void SolutionRows::finish(const RunRecord& record) {
  if (!record.succeeded()) {
    if (started_ && !shown_) show();
    return;
  }
  if (next_ >= times_.points) return;
  next_ = times_.points;
  last_.t = t_end_;
  last_.switches.clear();
  show();
}

}  // namespace irk
