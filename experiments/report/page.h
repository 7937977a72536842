// The report's page: answers first, then the claims, one section per study, tableaus, environment. One HTML file with
// its style and script (plots/page/report.html, .css, .js); figures and tables are links.
#pragma once

#include <string>
#include <vector>

#include "experiments/report/answers/answer.h"
#include "experiments/report/figure_list.h"

namespace irk {

/// The four questions that the page answers first.
std::vector<report::Answer> pageAnswers(const ReportOptions& options);

/// The page, results/report/index.html. `answers` links to answers_<id>.csv beside it.
std::string pageHtml(const ReportOptions& options, const std::vector<report::Answer>& answers);

}  // namespace irk
