// Assembles the Jacobian of the equations that a peer takes from the matrices D0, D1, D2 of a system.
#pragma once

#include <memory>
#include <vector>

#include "core/derivatives/differentiator.h"
#include "irk/peer.h"

namespace irk {

/// One column of a Jacobian: below `top` rows the combination d0 D0 + d1 D1 + d2 D2 of their column `core`, where d0
/// is c for the value kTimesC; and at most one entry above.
struct AssembledColumn {
  Index core;
  double d0 = 0, d1 = 0, d2 = 0;
  Index top_row = -1;
  double top = 0;
};
/// Stands for the factor c of a residual's Jacobian dF/dy + c dF/dy'.
inline constexpr double kTimesC = 1e300;

/// Keeps the pattern of the result as long as that of the system is the same.
class Assembly {
 public:
  Assembly() = default;
  Assembly(Index top_rows, std::vector<AssembledColumn> columns);

  /// Returns the pattern of the result for a pattern of D0, D1, D2.
  const std::shared_ptr<const PeerPattern>& pattern(const std::shared_ptr<const Pattern>& core);
  /// Writes the Jacobian. Returns false if a value is not finite.
  bool assemble(const Linearization<double>& D, double c, PeerJacobian& J);

 private:
  Index top_rows_ = 0;
  std::vector<AssembledColumn> columns_;
  std::shared_ptr<const Pattern> core_;
  std::shared_ptr<const PeerPattern> pattern_;
};

/// Whether the Jacobian is treated as full, without a search for its pattern: on request, or for few unknowns.
inline bool isDense(Storage storage, Index n) {
  return storage == Storage::kDense || (storage == Storage::kAutomatic && n < kSparseFrom);
}

/// The pattern of a full n x n matrix.
std::shared_ptr<const PeerPattern> fullPattern(Index n);

}  // namespace irk
