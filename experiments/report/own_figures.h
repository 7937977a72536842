// The figures of studies that are not built in. `irk run` and `irk merge` keep them beside the results, in
// results/<study>/figures.toml, so that `irk plot` and `irk report` do not need the study's file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/study/toml/figure_tables.h"

namespace irk {

inline constexpr char kFiguresFile[] = "figures.toml";

/// The figures that the study's file asks for, or by default those of default_figures.h. None for a built-in study,
/// whose figures are in plots/figures.txt. Throws Misuse with file and line for an unknown script, option, column or
/// block, and for a table that the study does not make. If plots/ does not exist (a program that was copied to another
/// machine), nothing is checked.
FigureTables figuresOfStudy(const Study& study, const std::string& id_or_file);

/// Writes them to `folder`, results/<study>, which exists; nothing for a built-in study.
void keepFigures(const FigureTables& figures, const std::filesystem::path& folder);

/// The ids of studies in `results` with figures of their own, sorted.
std::vector<std::string> ownStudies(const std::filesystem::path& results);

/// Reads the figures that keepFigures has written. Throws Misuse with file and line for damage.
FigureTables keptFigures(const std::filesystem::path& results, const std::string& study);
/// The title of an own study; its id if the file of its figures is damaged.
std::string ownTitle(const std::filesystem::path& results, const std::string& study);

}  // namespace irk
