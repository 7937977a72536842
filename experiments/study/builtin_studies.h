// The study files of experiments/studies, embedded at build time.
#pragma once

#include <span>
#include <string_view>

namespace irk {

struct BuiltinStudy {
  std::string_view id;
  std::string_view toml;
};

/// Sorted by id.
std::span<const BuiltinStudy> builtinStudies();

}  // namespace irk
