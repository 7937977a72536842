// The figures of an own study whose file asks for none, chosen by what varies in each block.
#pragma once

#include <vector>

#include "experiments/study/study.h"
#include "experiments/study/toml/figure_tables.h"

namespace irk {

/// For each block:
///  - tolerances: work over error (`work_by`), one curve per method or, with one method, per value of what varies;
///    one panel per scene;
///  - steps: error over step (`error_vs_step`), and with `orders` the orders over the stages (`order_vs_stages`);
///  - several numbers of stages of one family: cost over stages (`cpu_vs_stages`, with `targets`), and with several
///    levels, too, the map of digits and failures (`failure_map`);
/// and the figures of the other analyses. Settings that vary beside the curves give one figure for each combination,
/// six at most. Costs are CPU times if the study measures them, else residual evaluations.
std::vector<FigureTable> defaultFigures(const Study& study);

}  // namespace irk
