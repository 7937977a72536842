// The figures of an own study whose file asks for none.
#pragma once

#include <vector>

#include "experiments/study/study.h"
#include "experiments/study/toml/figure_tables.h"

namespace irk {

/// For each block:
///  - tolerances: work over error (`work_by`), a panel per scene, six at most, and a curve per method, per integrator
///    if configurations vary or, with one method, per value of what varies. Costs are CPU times if the study measures
///    them, else residual evaluations;
///  - steps: for each scene error over step (`error_vs_step`), and with `orders` the orders over the stages
///    (`order_vs_stages`).
/// Settings that vary beside the curves give a figure for each combination, six at most. Then the figures of the other
/// analyses and of `trajectories`; of an audit, its two figures only.
std::vector<FigureTable> defaultFigures(const Study& study);

}  // namespace irk
