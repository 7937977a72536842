// What the scenes of chemistry and of circuits share: many constants, components that only have numbers. Internal.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "irk/scene_file.h"

namespace irk {

/// Constants with all digits of their decimal texts.
template <class Real, std::size_t N>
std::array<Real, N> decimals(const char* const (&texts)[N]) {
  std::array<Real, N> values;
  for (std::size_t i = 0; i < N; ++i) values[i] = decimal<Real>(texts[i]);
  return values;
}

/// y1, y2, ..., all with one unit and one scale.
inline std::vector<Component> numbered(int count, const std::string& unit = "", double scale = 1) {
  std::vector<Component> all;
  for (int i = 1; i <= count; ++i) all.push_back({"y" + std::to_string(i), unit, scale});
  return all;
}

}  // namespace irk
