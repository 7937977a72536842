#include "tableaus/catalogue/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <string_view>

#include "core/base/text.h"
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

std::string joined(const Vec<BigFloat>& row, std::string_view between, int digits) {
  std::string text;
  for (const BigFloat& x : row) text += (text.empty() ? "" : std::string(between)) + x.str(digits);
  return text;
}

// Calls `row` for each vector of the tableau.
void forEachRow(const Tableau<BigFloat>& tableau, const std::function<void(const char*, const Vec<BigFloat>&)>& row) {
  row("b", tableau.b);
  row("c", tableau.c);
  if (tableau.b_hat.size() > 0) row("b_hat", tableau.b_hat);
}

std::string titleText(const Tableau<BigFloat>& tableau) {
  return fmt::format("Butcher tableau {}, order {}", tableau.id, tableau.order) +
         (tableau.b_hat.size() > 0 ? fmt::format(", embedded weights b_hat of order {}", tableau.order_hat) : "");
}

std::string latexText(const TableauFile& file) {
  constexpr int kDigits = 10;
  const Tableau<BigFloat>& tableau = file.tableau;
  static const std::regex power("e([+-])0*(\\d+)");
  const auto row = [](const std::string& node, const Vec<BigFloat>& numbers) {
    const std::string text = node + " & " + joined(numbers, " & ", kDigits);
    return std::regex_replace(text, power, R"( \cdot 10^{$1$2})");
  };
  std::string text = fmt::format("% {}\n\\begin{{array}}{{c|{}}}\n", titleText(tableau),
                                 std::string(static_cast<std::size_t>(tableau.stages()), 'c'));
  for (Index i = 0; i < tableau.stages(); ++i) {
    text += row(tableau.c[i].str(kDigits), tableau.A.row(i).transpose()) + " \\\\\n";
  }
  text += "\\hline\n" + row("", tableau.b);
  if (tableau.b_hat.size() > 0) text += " \\\\\n" + row("", tableau.b_hat);
  return text + "\n\\end{array}\n";
}

constexpr int kDoubleDigits = 17;

std::string numpyText(const TableauFile& file) {
  const Tableau<BigFloat>& tableau = file.tableau;
  std::string text = fmt::format("# {}\nimport numpy as np\n\nA = np.array([\n", titleText(tableau));
  for (const auto& row : tableau.A.rowwise()) {
    text += fmt::format("    [{}],\n", joined(row.transpose(), ", ", kDoubleDigits));
  }
  text += "], dtype=float)\n";
  forEachRow(tableau, [&](const char* name, const Vec<BigFloat>& row) {
    text += fmt::format("{} = np.array([{}], dtype=float)\n", name, joined(row, ", ", kDoubleDigits));
  });
  return text;
}

std::string cText(const TableauFile& file) {
  const Tableau<BigFloat>& tableau = file.tableau;
  const Index s = tableau.stages();
  std::string text = fmt::format("/* {} */\nconst double A[{}][{}] = {{\n", titleText(tableau), s, s);
  for (const auto& row : tableau.A.rowwise()) {
    text += fmt::format("    {{{}}},\n", joined(row.transpose(), ", ", kDoubleDigits));
  }
  text += "};\n";
  forEachRow(tableau, [&](const char* name, const Vec<BigFloat>& row) {
    text += fmt::format("const double {}[{}] = {{{}}};\n", name, s, joined(row, ", ", kDoubleDigits));
  });
  return text;
}

}  // namespace

std::string showTableau(std::string_view id_or_file, int digits) {
  if (digits < 1 || digits > kMaxShownDigits) {
    throw Misuse(fmt::format("digits = {} is not from 1 to {}", digits, kMaxShownDigits));
  }
  const TableauFile file = findTableau(id_or_file);
  const auto& [id, family, A, b, c, order, stage_order, b_hat, order_hat] = file.tableau;
  const std::size_t margin = widest(c, digits);
  const std::size_t width = std::max({widest(A, digits), widest(b, digits), widest(b_hat, digits)});
  const std::size_t columns = static_cast<std::size_t>(b.size()) * (width + 2);

  std::string text =
      fmt::format("{}: family {}, {} stages, order {}, stage order {}\n", id, family, b.size(), order, stage_order);
  for (Index i = 0; i < c.size(); ++i) {
    text += fmt::format("{:>{}} |", c[i].str(digits), margin);
    text += numbersText(A.row(i).transpose(), digits, width);
  }
  text += fmt::format("{:->{}}+{:->{}}\n", "", margin + 1, "", columns);
  text += fmt::format("{:>{}} |", "", margin) + numbersText(b, digits, width);
  if (b_hat.size() == 0) return text;
  return text + fmt::format("{:>{}} |", "", margin) + numbersText(b_hat, digits, width) +
         fmt::format("the last row: embedded weights of order {}\n", order_hat);
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

std::string exportTableau(std::string_view id_or_file, std::string_view format) {
  static const std::map<std::string, std::string (*)(const TableauFile&), std::less<>> formats = {
      {"file", writeTableau}, {"latex", latexText}, {"numpy", numpyText}, {"c", cText}};
  const auto name_of = [](const auto& entry) { return std::string_view(entry.first); };
  return entryNamed("format", format, formats, name_of).second(findTableau(id_or_file));
}

}  // namespace irk
