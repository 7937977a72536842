// Structure, stability and conditioning of a tableau, regardless of what it declares, as values and as text.
#pragma once

#include <string>
#include <string_view>

#include "tableaus/analysis/analysis.h"
#include "tableaus/analysis/spectrum.h"
#include "tableaus/analysis/stability.h"

namespace irk {

enum class StageKind {
  kExplicit,            ///< A strictly lower triangular
  kSinglyDiagonal,      ///< lower triangular, one value on the diagonal: SDIRK
  kSinglyDiagonalRest,  ///< the same with an explicit first stage: ESDIRK
  kDiagonal,            ///< lower triangular: DIRK
  kFull,
};

/// "fully implicit", "singly diagonally implicit (SDIRK)", ...
std::string_view stageKindName(StageKind kind);

struct NodesAndWeights {
  double closest;          ///< smallest |c_i - c_j|; 1 if s = 1
  double lowest, highest;  ///< of c
  double smallest_weight;  ///< of b
  bool distinct, within;   ///< nodes distinct, nodes in [0, 1]
  bool positive;           ///< all weights > 0
};

struct TableauProperties {
  TableauAnalysis analysis;
  StageKind kind;
  NodesAndWeights quadrature;
  /// Equal to its adjoint up to a permutation of the stages: c_i + c_i' = 1, b_i = b_i', a_i'j' + a_ij = b_j. GNI, V.2.
  bool symmetric;
  StabilityFunction R;
  Stability stability;
  Spectrum spectrum;  ///< of A
};

/// The analysis takes time proportional to s^3: about a second at 40 stages.
inline constexpr Index kMaxAnalyzedStages = 40;

/// Computed in 80 digits. Throws Misuse as analyzeTableau, and for more than kMaxAnalyzedStages stages.
TableauProperties analyzeProperties(const Tableau<BigFloat>& tableau, double tolerance);

/// One indented line per property.
std::string propertiesText(const TableauProperties& properties);

}  // namespace irk
