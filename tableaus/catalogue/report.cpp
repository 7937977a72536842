#include "tableaus/catalogue/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "irk/misuse.h"
#include "tableaus/analysis/properties.h"
#include "tableaus/catalogue/source.h"

namespace irk {
namespace {

constexpr int kMaxShownDigits = 75;  // five less than the arithmetic's

std::string numbersText(const Vec<BigFloat>& row, int digits, std::size_t width) {
  std::string text;
  for (const BigFloat& x : row) text += fmt::format("  {:>{}}", x.str(digits), width);
  text += '\n';
  return text;
}

std::size_t widest(const Mat<BigFloat>& block, int digits) {
  std::size_t width = 1;
  for (const BigFloat& x : block.reshaped()) width = std::max(width, x.str(digits).size());
  return width;
}

}  // namespace

std::string showTableau(std::string_view id_or_file, int digits) {
  if (digits < 1 || digits > kMaxShownDigits) {
    throw Misuse(fmt::format("digits = {} is not from 1 to {}", digits, kMaxShownDigits));
  }
  const TableauFile file = findTableau(id_or_file);
  const auto& [id, family, A, b, c, order, stage_order] = file.tableau;
  const std::size_t margin = widest(c, digits);
  const std::size_t width = std::max(widest(A, digits), widest(b, digits));
  const std::size_t columns = static_cast<std::size_t>(b.size()) * (width + 2);

  std::string text =
      fmt::format("{}: family {}, {} stages, order {}, stage order {}\n", id, family, b.size(), order, stage_order);
  for (Index i = 0; i < c.size(); ++i) {
    text += fmt::format("{:>{}} |", c[i].str(digits), margin);
    text += numbersText(A.row(i).transpose(), digits, width);
  }
  text += fmt::format("{:->{}}+{:->{}}\n", "", margin + 1, "", columns);
  return text + fmt::format("{:>{}} |", "", margin) + numbersText(b, digits, width);
}

TableauReport checkTableau(std::string_view id_or_file) {
  const TableauFile file = findUncheckedTableau(id_or_file);
  TableauReport report = checkTableau(file);
  if (file.tableau.stages() > kMaxAnalyzedStages) {
    report.text += fmt::format("  stability and eigenvalues: analysed up to {} stages only\n", kMaxAnalyzedStages);
    return report;
  }
  const auto properties = analyzeProperties(file.tableau, report.analysis.tolerance);
  report.text += propertiesText(properties);
  return report;
}

std::string exportTableau(std::string_view id_or_file) { return writeTableau(findTableau(id_or_file)); }

}  // namespace irk
