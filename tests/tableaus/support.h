// Shared by the tests of tableaus/.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "irk/tableaus.h"
#include "tableaus/families/families.h"
#include "tests/refusal.h"

namespace irk {

inline std::string memberId(const std::string& family, Index s) { return fmt::format("{}_{}", family, s); }

/// The largest |x - y|.
template <class Real>
double largestDifference(const Mat<Real>& x, const Mat<Real>& y) {
  return static_cast<double>((x - y).cwiseAbs().maxCoeff());
}

}  // namespace irk
