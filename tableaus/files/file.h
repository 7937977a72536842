// Tableau files: text with coefficients, declared properties and the source.
//
//   # any comment
//   family: radau_iia        one of the suite's, or any other name; default `user`
//   stages: 2
//   order: 3
//   stage_order: 2           default: the family's, or the largest q with C(q)
//   source: where the numbers came from
//   digits: 50               accuracy of the coefficients; default 15
//   A
//   5/12  -1/12
//   0.75   0.25
//   b
//   0.75   0.25
//   c
//   1/3    1
//
// A method with embedded weights for the same stages (`--estimate tableau`) has a key and a block more, after c:
//
//   order_hat: 1             order of A, b_hat, c
//   b_hat
//   1      0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "irk/tableau.h"
#include "tableaus/analysis/check.h"
#include "tableaus/families/precise.h"

namespace irk {

/// The content of a file. Line numbers count from 1.
struct TableauFile {
  Tableau<BigFloat> tableau;
  std::string source;
  int digits;
  std::map<tableaus::Place, int> lines;  ///< of the keys and rows that are there, but for those of A
  std::vector<int> row_lines;            ///< s, of A
};

/// Parses the text without checking the coefficients against the header. `name` is used in messages and as id. Throws
/// Misuse `name:line: reason` for text that is cut short, wrong counts, values that are no finite numbers, unknown or
/// repeated keys, and anything after the last block.
TableauFile parseTableau(std::string_view text, const std::string& name);

/// Parses the file at `path`; also throws Misuse if it cannot be read.
TableauFile openTableau(const std::string& path);

/// Parses and checks the file at `path`: throws Misuse `path:line: reason` for the first contradiction.
TableauFile readTableau(const std::string& path);

/// Checks a file's coefficients against its header and digits.
TableauReport checkTableau(const TableauFile& file);

/// The text of a file, with kFileDigits significant digits per number.
std::string writeTableau(const TableauFile& file);

/// A member of a family as the content of a file, with constructed coefficients.
TableauFile constructedFile(std::string_view family, Index s);

}  // namespace irk
