#include "experiments/report/ratios_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "experiments/analyses/costs/ratios.h"
#include "experiments/base/median.h"
#include "experiments/runs/run_table.h"

namespace irk {
namespace {

constexpr double kEqual = 0.05;  // CPU times that are closer than this do not differ

// A choice on a scene, with all methods and all other choices of its block.
struct ComparedChoice {
  std::string scene, value, base;
  std::vector<std::vector<double>> ratios;  // of kRatioCosts, one per method and other choices
  double lost = 0, won = 0;

  double median(std::size_t cost) const { return irk::median(ratios[cost]); }
};

std::vector<ComparedChoice> choicesOf(const Table& table) {
  std::map<std::vector<std::string>, std::size_t> place;
  std::vector<ComparedChoice> choices;
  for (const auto& row : table.rows) {
    std::vector<std::string> key;
    for (const char* column : {"block", "scene", "settings", "column", "value", "base"}) {
      key.push_back(textAt(table, row, column));
    }
    const auto [at, added] = place.try_emplace(key, choices.size());
    if (added) {
      choices.push_back({.scene = key[1] + (key[2].empty() ? "" : " " + key[2]),
                         .value = key[3] + " = " + key[4],
                         .base = key[5],
                         .ratios = std::vector<std::vector<double>>(std::size(kRatioCosts))});
    }
    ComparedChoice& choice = choices[at->second];
    for (std::size_t i = 0; i < std::size(kRatioCosts); ++i) {
      const double ratio = numberAt(table, row, kRatioCosts[i]);
      if (!std::isnan(ratio)) choice.ratios[i].push_back(ratio);
    }
    choice.lost += numberAt(table, row, "lost");
    choice.won += numberAt(table, row, "won");
  }
  return choices;
}

std::string ratioText(double ratio) { return std::isnan(ratio) ? "–" : fmt::format("{:.2f}", ratio); }

// The text of the smallest and the largest ratio.
std::string rangeText(const std::vector<double>& ratios) {
  if (ratios.empty()) return "–";
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return ratioText(*least) + " … " + ratioText(*most);
}

}  // namespace

HtmlTable ratiosHtml(const Table& ratios) {
  HtmlTable html{.caption =
                     "Costs over those of the first choice at equal errors: medians over errors, methods and the "
                     "other choices",
                 .titles = {"scene", "choice", "instead of", "CPU time", "least … most", "residuals",
                            "Newton iterations", "Jacobians", "factorizations", "errors lost", "errors won"}};
  for (const auto& choice : choicesOf(ratios)) {
    HtmlTable::Row row{{escapeHtml(choice.scene), escapeHtml(choice.value), escapeHtml(choice.base),
                        ratioText(choice.median(0)), rangeText(choice.ratios.front())}};
    for (std::size_t i = 1; i < std::size(kRatioCosts); ++i) row.cells.push_back(ratioText(choice.median(i)));
    row.cells.push_back(fmt::format("{:g}", choice.lost));
    row.cells.push_back(fmt::format("{:g}", choice.won));
    html.rows.push_back(std::move(row));
  }
  return html;
}

std::string ratiosSentence(const Table& ratios) {
  auto choices = choicesOf(ratios);
  std::erase_if(choices, [](const ComparedChoice& choice) { return std::isnan(choice.median(0)); });
  if (choices.empty()) return {};
  const auto [least, most] =
      std::minmax_element(choices.begin(), choices.end(),
                          [](const ComparedChoice& a, const ComparedChoice& b) { return a.median(0) < b.median(0); });
  const auto equal = std::count_if(choices.begin(), choices.end(), [](const ComparedChoice& choice) {
    return std::abs(choice.median(0) - 1) <= kEqual;
  });
  const auto text = [](const ComparedChoice& choice) {
    return fmt::format("{:.2f} (`{}` instead of `{}`, {})", choice.median(0), choice.value, choice.base, choice.scene);
  };
  return fmt::format(
      "At equal errors the CPU time changes by less than {:.0f} % in {} of {} comparisons with the first choice; the "
      "factors range from {} to {}.",
      100 * kEqual, equal, choices.size(), text(*least), text(*most));
}

}  // namespace irk
