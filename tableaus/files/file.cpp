#include "tableaus/files/file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_file.h"
#include "irk/misuse.h"
#include "tableaus/families/families.h"

namespace irk {

using tableaus::Finding;
using tableaus::Place;
using tableaus::Verdict;

namespace {

int lineOf(const TableauFile& file, const Finding& finding) {
  if (finding.place == Place::kRow) return file.row_lines[static_cast<std::size_t>(finding.row)];
  const auto line = file.lines.find(finding.place);
  return line == file.lines.end() ? file.row_lines.front() : line->second;
}

/// One line per row; columns are as wide as their widest number.
std::string blockText(const Mat<BigFloat>& block) {
  const auto number = [](const BigFloat& x) { return x.str(kFileDigits); };
  std::string text;
  for (Index i = 0; i < block.rows(); ++i) {
    for (Index j = 0; j < block.cols(); ++j) {
      std::size_t width = 0;
      for (const BigFloat& x : block.col(j)) width = std::max(width, number(x).size());
      text += fmt::format("{}{:>{}}", j == 0 ? "" : "  ", number(block(i, j)), width);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

TableauFile openTableau(const std::string& path) { return parseTableau(readInputFile(path), path); }

TableauFile readTableau(const std::string& path) {
  TableauFile file = openTableau(path);
  for (const Finding& finding : checkTableau(file).findings) {
    if (finding.verdict != Verdict::kContradiction) continue;
    throw Misuse(fmt::format("{}:{}: {} (tolerance {:.1g} for {} digits)", path, lineOf(file, finding), finding.text,
                             toleranceOfDigits(file.digits), file.digits));
  }
  return file;
}

TableauReport checkTableau(const TableauFile& file) {
  return checkTableau(file.tableau, toleranceOfDigits(file.digits));
}

std::string writeTableau(const TableauFile& file) {
  const Tableau<BigFloat>& tableau = file.tableau;
  const bool has_weights = tableau.b_hat.size() > 0;
  return fmt::format("# Butcher tableau {}\n", tableau.id) +
         fmt::format("family: {}\nstages: {}\norder: {}\nstage_order: {}\n", tableau.family, tableau.stages(),
                     tableau.order, tableau.stage_order) +
         (has_weights ? fmt::format("order_hat: {}\n", tableau.order_hat) : "") +
         (file.source.empty() ? "" : fmt::format("source: {}\n", file.source)) +
         fmt::format("digits: {}\n", file.digits) + "A\n" + blockText(tableau.A) + "b\n" +
         blockText(tableau.b.transpose()) + "c\n" + blockText(tableau.c.transpose()) +
         (has_weights ? "b_hat\n" + blockText(tableau.b_hat.transpose()) : "");
}

TableauFile constructedFile(std::string_view family, Index s) {
  TableauFile file{};
  file.tableau = constructFamily(familyOf(family), s);
  file.source =
      "constructed in the Legendre basis, Hairer & Wanner, Solving ODEs II (1996), IV.5; "
      "80 digits, rounded once";
  file.digits = kFileDigits;
  return file;
}

}  // namespace irk
