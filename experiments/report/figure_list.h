// The figures of plots/figures.txt and of own studies: their names, how they are drawn, and which exist.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// A folder of results that does not belong to a study, see experiments/analyses/tableau_table.h.
inline constexpr std::string_view kTableauResults = "tableaus";

/// One line of plots/figures.txt: study|script|name|title|caption|assignments; or a figure of an own study.
struct Figure {
  std::string study, script, name, title, caption, assignments;
  bool is_own = false;  ///< kept beside the results (own_figures.h)
};

struct ReportOptions {
  std::filesystem::path results = "results";
  std::filesystem::path home;  ///< the folder with plots/
};

/// Whether these are results of --quick, which are kept in a folder of this name.
bool areQuick(const ReportOptions& options);

/// Throws Misuse with file and line for a line of any other form.
std::vector<Figure> readFigures(const std::filesystem::path& file);
/// The figures of plots/figures.txt, then those of own studies, whose names begin with the study's. Studies whose
/// figures cannot be read are left out.
std::vector<Figure> allFigures(const ReportOptions& options);
/// Own studies whose figures cannot be read, with the reasons.
std::map<std::string, std::string> brokenFigures(const ReportOptions& options);
/// The studies of these figures, in order of appearance.
std::vector<std::string> studiesOf(const std::vector<Figure>& figures);

/// results/report/figures
std::filesystem::path figureFolder(const ReportOptions& options);
bool hasResults(const Figure& figure, const ReportOptions& options);
bool isDrawn(const Figure& figure, const ReportOptions& options);

/// The assignments for `gnuplot -e`. With results of --quick they set `quick`, so that style.gp marks the figure.
std::string gnuplotCommands(const Figure& figure, const ReportOptions& options);
/// The same for tables in the folder `data` and files OUT.svg and OUT.png.
std::string gnuplotCommands(const Figure& figure, const ReportOptions& options, const std::filesystem::path& data,
                            const std::filesystem::path& out);
/// The shell's command that draws the figure again, in the folder `home`.
std::string shellCommand(const Figure& figure, const ReportOptions& options);

}  // namespace irk
