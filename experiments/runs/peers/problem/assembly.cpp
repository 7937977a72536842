#include "experiments/runs/peers/problem/assembly.h"

#include <algorithm>

namespace irk {

std::shared_ptr<const PeerPattern> fullPattern(Index n) {
  auto pattern = std::make_shared<PeerPattern>();
  pattern->n = n;
  pattern->lower = pattern->upper = std::max<Index>(n - 1, 0);
  return pattern;
}

Assembly::Assembly(Index top_rows, std::vector<AssembledColumn> columns)
    : top_rows_(top_rows), columns_(std::move(columns)) {}

const std::shared_ptr<const PeerPattern>& Assembly::pattern(const std::shared_ptr<const Pattern>& core) {
  if (pattern_ && core == core_) return pattern_;
  core_ = core;
  const Index n = static_cast<Index>(columns_.size());
  if (core->full) return pattern_ = fullPattern(n);
  auto made = std::make_shared<PeerPattern>();
  made->n = n;
  made->full = false;
  made->column_start.push_back(0);
  for (const auto& column : columns_) {
    if (column.top_row >= 0) made->row.push_back(static_cast<int>(column.top_row));
    const auto at = static_cast<std::size_t>(column.core);
    for (int k = core->column_start[at]; k < core->column_start[at + 1]; ++k) {
      made->row.push_back(static_cast<int>(top_rows_) + core->row[static_cast<std::size_t>(k)]);
    }
    const Index j = static_cast<Index>(made->column_start.size()) - 1;
    for (auto k = static_cast<std::size_t>(made->column_start.back()); k < made->row.size(); ++k) {
      made->lower = std::max<Index>(made->lower, made->row[k] - j);
      made->upper = std::max<Index>(made->upper, j - made->row[k]);
    }
    made->column_start.push_back(static_cast<int>(made->row.size()));
  }
  return pattern_ = made;
}

bool Assembly::assemble(const Linearization<double>& D, double c, PeerJacobian& J) {
  J.pattern = pattern(D.pattern);
  const Pattern& core = *D.pattern;
  const Index n = J.pattern->n;
  J.values.resize(core.full ? n * n : static_cast<Index>(J.pattern->row.size()));
  Index k = 0;
  for (const auto& column : columns_) {
    const auto at = static_cast<std::size_t>(column.core);
    const Index first = core.full ? column.core * core.n : core.column_start[at];
    const Index count = core.full ? core.n : core.column_start[at + 1] - first;
    const double top = column.top == kTimesC ? c : column.top;
    if (core.full) {
      J.values.segment(k, top_rows_).setZero();
      if (column.top_row >= 0) J.values[k + column.top_row] = top;
      k += top_rows_;
    } else if (column.top_row >= 0) {
      J.values[k++] = top;
    }
    auto to = J.values.segment(k, count);
    to.setZero();
    if (column.d1 != 0) to += column.d1 * D.d1.segment(first, count);
    if (column.d2 != 0) to += column.d2 * D.d2.segment(first, count);
    if (column.d0 != 0) to += (column.d0 == kTimesC ? c : column.d0) * D.d0.segment(first, count);
    k += count;
  }
  return J.values.allFinite();
}

}  // namespace irk
