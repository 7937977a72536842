#include "tableaus/catalogue/constants.h"

#include <fmt/format.h>

namespace irk {
namespace {

Index numbersOf(Index s) { return s * s + 2 * s; }

// Where the member begins in the table.
const double* constantsOf(const Family& wanted, Index stages) {
  const double* at = detail::kConstants;
  for (const Family& family : families()) {
    const bool found = family.id == wanted.id;
    const Index end = found ? stages : kConstantStages + 1;
    for (Index s = family.minStages(); s < end; ++s) at += numbersOf(s);
    if (found) break;
  }
  return at;
}

}  // namespace

Tableau<double> familyInDouble(const Family& family, Index s) {
  if (s < family.minStages() || s > kConstantStages) return constructFamily(family, s).cast<double>();
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const double* at = constantsOf(family, s);
  const auto orders = family.orders(s);
  return {fmt::format("{}_{}", family.id, s),
          family.id,
          Eigen::Map<const Rows>(at, s, s),
          Eigen::Map<const Vec<double>>(at + s * s, s),
          Eigen::Map<const Vec<double>>(at + s * s + s, s),
          orders.p,
          orders.q};
}

}  // namespace irk
