// A figure of the page: the diagram, its title and caption, links to the files behind it, the command that draws it.
#pragma once

#include <string>

#include "experiments/report/figure_list.h"

namespace irk {

/// The figure must be drawn. A wide one, of several panels, has the class `wide`. Links are relative to results/report.
std::string figureHtml(const Figure& figure, const ReportOptions& options);

}  // namespace irk
