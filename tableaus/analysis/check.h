// Does a tableau keep what it declares?
#pragma once

#include <string>
#include <vector>

#include "irk/tableau.h"
#include "tableaus/analysis/analysis.h"

namespace irk {

namespace tableaus {

enum class Verdict {
  kHolds,
  kNote,           ///< no contradiction, but worth knowing
  kUnproven,       ///< declared order beyond what B, C and D prove; it may still be true
  kContradiction,  ///< the tableau is not what it says
};

/// The part of a tableau that a finding is about; a file reader turns it into a line.
enum class Place { kFamily, kOrder, kStageOrder, kRow, kWeights };

struct Finding {
  Verdict verdict;
  Place place;
  Index row;         ///< of A, for Place::kRow
  std::string name;  ///< "sum of b", "row sums", "B", "C", "family", "order", "trees"
  std::string text;  ///< a sentence with the numbers
};

}  // namespace tableaus

struct TableauReport {
  std::string id;
  TableauAnalysis analysis;
  std::vector<tableaus::Finding> findings;
  bool ok;           ///< no contradiction
  std::string text;  ///< all of it, for printing
};

/// Checks sum b = 1, row sums (unless stage order 0 is declared), B(p), C(q), the family's numbers
/// and coefficients if it is one of the suite's, whether B, C, D prove the order, and which one the
/// rooted trees give. Real: double, mp50, mp80. Throws Misuse as analyzeTableau.
template <class Real>
TableauReport checkTableau(const Tableau<Real>& tableau,
                           double tolerance = roundingTolerance<Real>());

}  // namespace irk
