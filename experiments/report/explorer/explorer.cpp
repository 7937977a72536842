#include "experiments/report/explorer/explorer.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <ostream>

#include "core/base/input_file.h"
#include "experiments/base/html.h"
#include "experiments/report/explorer/explorer_data.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/new_file.h"

namespace irk {
namespace {

// Links to the tables, for readers without scripts.
std::string tablesHtml(const std::vector<std::string>& studies) {
  std::string html;
  for (const auto& study : studies) {
    html += fmt::format("<li><a href=\"../{0}/runs.csv\">{0}/runs.csv</a></li>\n", escapeHtml(study));
  }
  return html;
}

}  // namespace

std::filesystem::path d3File() { return IRK_D3; }

std::optional<std::filesystem::path> writeExplorer(const ReportOptions& options, std::ostream& err,
                                                   const std::filesystem::path& library) {
  const auto path = options.results / "report" / "explore.html";
  std::error_code none;
  std::filesystem::remove(path, none);
  const auto studies = exploredStudies(options.results);
  if (studies.empty()) return std::nullopt;
  if (!std::filesystem::is_regular_file(library, none)) {
    fmt::print(err, "the explorer is left out: no {}; install the package node-d3\n", library.string());
    return std::nullopt;
  }
  const auto plots = options.home / "plots" / "page";
  std::string page = readInputFile(plots / "explore.html");
  replacePlaceholder(page, "@COMMON@", readInputFile(plots / "common.css"));
  replacePlaceholder(page, "@DATE@", dateText());
  replacePlaceholder(
      page, "@BANNER@",
      options.results.filename() == "quick"
          ? "  <p class=\"banner\"><b>A quick run:</b> small versions of all studies, which show that "
            "everything works. Costs are coarse, and the few tolerances make curves that full results may "
            "turn round.</p>\n"
          : "");
  replacePlaceholder(page, "@TABLES@", tablesHtml(studies));
  replacePlaceholder(page, "@D3@", readInputFile(library));
  const std::string_view data = "@DATA@";
  const auto at = page.find(data);
  std::filesystem::create_directories(path.parent_path());
  NewFile file(path);
  file.out() << page.substr(0, at);
  writeExplorerData(options.results, file.out());
  file.out() << page.substr(at + data.size());
  file.close();
  return path;
}

}  // namespace irk
