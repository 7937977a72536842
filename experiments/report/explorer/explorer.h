// The explorer: results/report/explore.html, one file with its data and the library that draws it.
// The library is d3 5 (package node-d3), not Chart.js 3.9 (libjs-chart.js). d3 draws SVG: its marks can be reached by
// keyboard, styled for dark pages, and counted by tests. Chart.js paints one opaque canvas and adds legends and
// tooltips that would have to be replaced.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>

#include "experiments/report/report.h"

namespace irk {

/// Where the package node-d3 has the library; read when the page is made, so that it may be installed after the build.
std::filesystem::path d3File();

/// Writes the page from plots/page/explore.html and returns its path. Without the library, or without runs to show, it
/// removes an older page, reports that in one line on `err`, and returns nothing.
std::optional<std::filesystem::path> writeExplorer(const ReportOptions& options, std::ostream& err,
                                                   const std::filesystem::path& library = d3File());

}  // namespace irk
