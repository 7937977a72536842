// What the scenes of chemistry and of circuits share: many constants, components that only have numbers. Internal.
#pragma once

#include <array>
#include <initializer_list>
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

/// Components with these names, all with one unit and the scale 1.
inline std::vector<Component> named(const std::string& unit, std::initializer_list<const char*> names) {
  std::vector<Component> all;
  for (const char* name : names) all.push_back({name, unit});
  return all;
}

/// y1, y2, ... (or another name with numbers), all with one unit and one scale.
inline std::vector<Component> numbered(int count, const std::string& name = "y", const std::string& unit = "",
                                       double scale = 1) {
  std::vector<Component> all;
  for (int i = 1; i <= count; ++i) all.push_back({name + std::to_string(i), unit, scale});
  return all;
}

}  // namespace irk
