// The explorer: results/report/explore.html, one file with its data and the library that draws it.
// The library is d3 5 (package node-d3), not Chart.js 3.9 (libjs-chart.js): d3 draws SVG, whose marks the keyboard
// reaches, style sheets darken and tests count; Chart.js paints one opaque canvas, and adds its own legends and
// tooltips that we would have to replace.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>

#include "experiments/report/report.h"

namespace irk {

/// Where the package node-d3 has the library; read when the page is made, so that it may be installed after the build.
std::filesystem::path d3File();

/// Writes the page from plots/page/explore.html and returns its path. Without the library, and without runs to be
/// shown, it removes an older page, says so in one line on `err`, and returns nothing.
std::optional<std::filesystem::path> writeExplorer(const ReportOptions& options, std::ostream& err,
                                                   const std::filesystem::path& library = d3File());

}  // namespace irk
