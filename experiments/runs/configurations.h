// Named choices of strategies.
#pragma once

#include <span>
#include <string_view>

namespace irk {

/// A named choice of strategies. Setting the configuration sets all of its fields; fields set later override them.
struct Configuration {
  std::string_view id;
  std::string_view meaning;
  std::string_view fields;  ///< `field=value;field=value`
};
/// `default`, `paper`, `embedded`, `variable`; a spec starts with the first one.
std::span<const Configuration> configurations();

/// Throws Misuse naming the nearest id.
const Configuration& findConfiguration(std::string_view id);

}  // namespace irk
