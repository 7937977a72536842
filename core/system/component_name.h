// Components by their number, and their names in messages.
#pragma once

#include <string>

#include "irk/system.h"

namespace irk {

/// Component i of (u, v, x).
auto& componentOf(auto& s, Index i) {
  const Index nu = s.u.size();
  return i < nu ? s.u[i] : i < 2 * nu ? s.v[i - nu] : s.x[i - 2 * nu];
}

/// "u[3]": component i of (u, v, x, z).
inline std::string componentName(const Sizes& n, Index i) {
  const auto name = [i](const char* group, Index first) { return group + ("[" + std::to_string(i - first) + "]"); };
  if (i < n.nu) return name("u", 0);
  if (i < 2 * n.nu) return name("v", n.nu);
  return i < 2 * n.nu + n.nx ? name("x", 2 * n.nu) : name("z", 2 * n.nu + n.nx);
}

}  // namespace irk
