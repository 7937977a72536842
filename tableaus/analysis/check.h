// Checks a tableau against its own declarations.
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
  kUnproven,       ///< the declared order exceeds what B, C and D prove; it may still be true
  kContradiction,  ///< the tableau contradicts its declaration
};

/// The part of a tableau that a finding is about; the file reader maps it to a line.
enum class Place { kFamily, kOrder, kStageOrder, kRow, kWeights, kWeightsHat, kOrderHat };

struct Finding {
  Verdict verdict;
  Place place;
  Index row;         ///< of A, for Place::kRow
  std::string name;  ///< short name of the check: "sum of b", "row sums", "B", "C", "family", "order", "trees", "b_hat"
  std::string text;  ///< a sentence with the numbers
};

}  // namespace tableaus

struct TableauReport {
  std::string id;
  TableauAnalysis analysis;
  std::vector<tableaus::Finding> findings;
  bool ok;           ///< whether there is no contradiction
  std::string text;  ///< all findings, for printing
};

/// Checks sum b = 1, row sums (unless stage order 0 is declared), B(p), C(q), orders and coefficients of a family of
/// the suite, whether B, C, D prove the order, and the order by rooted trees; of embedded weights the sum, the order by
/// rooted trees and R(inf). Real: double, BigFloat. Throws Misuse
/// as analyzeTableau.
template <class Real>
TableauReport checkTableau(const Tableau<Real>& tableau, double tolerance = roundingTolerance<Real>());

}  // namespace irk
