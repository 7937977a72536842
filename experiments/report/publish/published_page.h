// The page of published results: README.md with the answers and their figures.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/report/answers/answer.h"
#include "experiments/report/figure_list.h"
#include "experiments/report/publish/published_runs.h"

namespace irk::report {

/// A figure of plots/figures.txt, below the answer that it belongs to.
struct PublishedFigure {
  std::string_view answer;  ///< solver, orders, failures, paper; scenes: the section of the scenes
  std::string_view name;
};
std::span<const PublishedFigure> publishedFigures();

/// The page as Markdown. It names figures/NAME.svg and tables/NAME.csv beside it. `figures` are those of
/// publishedFigures(), in their order. The same results give the same text.
std::string publishedPage(const ReportOptions& options, const std::vector<Answer>& answers,
                          const std::vector<Figure>& figures, const PublishedRuns& runs);

}  // namespace irk::report
