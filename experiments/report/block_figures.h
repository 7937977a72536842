// The figures of one block of an own study, chosen by what varies in it; see default_figures.h.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/study/toml/figure_tables.h"

namespace irk {

/// Appends the figures; their names are left empty.
void appendBlockFigures(const Study& study, const std::string& block, std::vector<FigureTable>& figures);

/// Appends `item` unless the list has it.
void addNew(std::vector<std::string>& list, const std::string& item);

}  // namespace irk
