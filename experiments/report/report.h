// Figures and the report page, made from tables only; gnuplot draws the figures.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/report/figure_list.h"

namespace irk {

/// Throws Misuse if the folder does not exist.
void requireResultsFolder(const std::filesystem::path& results);

/// Runs `gnuplot -e commands plots/<script>`. Returns false, with a message on `err`, if that fails.
bool drawFigure(const std::string& script, const std::string& commands, const std::filesystem::path& home,
                std::ostream& err);

/// Draws results/report/figures/<name>.svg and .png for every figure whose study has results; an empty `study` means
/// all studies. Returns the number of figures that failed plus the number of studies whose figures lack times because
/// these come from several processors; each has a message on `err`. An own figure that selects no rows has failed.
/// Throws Misuse for a study without figures and if the results are not a folder; Failure if no requested study has
/// results.
int drawFigures(const std::string& study, const ReportOptions& options, std::ostream& err);

/// Draws these figures; returns how many of them failed, each with a message on `err`. Throws Misuse for a path that
/// gnuplot would interpret.
int drawFigures(const std::vector<Figure>& figures, const ReportOptions& options, std::ostream& err);

/// Writes results/report/index.html (page.h) with the tables of its answers, answers_*.csv, and returns its path.
std::filesystem::path writeReport(const ReportOptions& options);

}  // namespace irk
