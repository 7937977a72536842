// The typical magnitudes of a system's components, as a user gives them.
#pragma once

#include <string>

#include "irk/misuse.h"
#include "irk/system.h"

namespace irk {

/// The magnitudes of u, v, x, z: `given`, or ones if it is empty. Throws Misuse for another length.
inline Vec<double> componentScale(const Sizes& sizes, const Vec<double>& given) {
  if (given.size() == 0) return Vec<double>::Ones(sizes.components());
  if (given.size() == sizes.components()) return given;
  throw Misuse("scale has " + std::to_string(given.size()) + " entries, the system has " +
               std::to_string(sizes.components()) + " components (u, v, x, z)");
}

}  // namespace irk
