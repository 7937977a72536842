// Tableau files: text that carries coefficients, what they claim to be, and where they came from.
//
//   # any comment
//   family: radau_iia        one of the suite's, or any other name; `user` if left out
//   stages: 2
//   order: 3
//   stage_order: 2           left out: the family's, or the largest q with C(q)
//   source: where the numbers came from
//   digits: 50               that the coefficients are right to; 15 if left out
//   A
//   5/12  -1/12
//   0.75   0.25
//   b
//   0.75   0.25
//   c
//   1/3    1
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "irk/tableau.h"
#include "tableaus/analysis/check.h"
#include "tableaus/families/precise.h"

namespace irk {

/// A file's content; lines count from 1, 0 stands for a key that was left out.
struct TableauFile {
  Tableau<mp80> tableau;
  std::string source;
  int digits;
  int family_line = 0, order_line = 0, stage_order_line = 0, weights_line = 0;
  std::vector<int> row_lines;  ///< s, of A
};

/// Reads the text as it is, whether or not the numbers keep what the header says. `name` is used in
/// messages and as id. Throws Misuse `name:line: reason` for text that is cut short, has wrong
/// counts, values that are no finite numbers, unknown or repeated keys, or anything after the last
/// block.
TableauFile parseTableau(std::string_view text, const std::string& name);

/// The file at `path`, parsed; also throws Misuse if it cannot be read.
TableauFile openTableau(const std::string& path);

/// The file at `path`, parsed and checked: throws Misuse `path:line: reason` for the first
/// contradiction.
TableauFile readTableau(const std::string& path);

/// Against its own header and digits.
TableauReport checkTableau(const TableauFile& file);

/// The text of a file. Numbers with kFileDigits significant digits.
std::string writeTableau(const TableauFile& file);

/// A member of a family as file content, made by the construction.
TableauFile constructedFile(std::string_view family, Index s);

}  // namespace irk
