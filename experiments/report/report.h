// Figures and the report page. Reads tables only; gnuplot draws.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace irk {

/// One line of plots/figures.txt: study|script|name|title|caption|assignments.
struct Figure {
  std::string study, script, name, title, caption, assignments;
};

/// Throws Misuse where there is no such folder.
void requireResultsFolder(const std::filesystem::path& results);

/// Throws Misuse with file and line for a line of another form.
std::vector<Figure> readFigures(const std::filesystem::path& file);

struct ReportOptions {
  std::filesystem::path results = "results";
  std::filesystem::path home;  ///< the folder with plots/
};

/// `gnuplot -e commands plots/<script>`; false, with a message on `err`, if that fails.
bool drawFigure(const std::string& script, const std::string& commands,
                const std::filesystem::path& home, std::ostream& err);

/// Draws results/report/figures/<name>.svg and .png for every figure whose study has results;
/// `study` empty: for all studies. Returns the number of figures that failed, and of studies whose figures lack times
/// as they are of several processors, each with a message on `err`. Throws Misuse for a study without figures and for
/// results that are no folder, Failure where nothing that is asked for has results.
int drawFigures(const std::string& study, const ReportOptions& options, std::ostream& err);

/// Writes results/report/index.html from plots/report.html and returns its path.
std::filesystem::path writeReport(const ReportOptions& options);

}  // namespace irk
