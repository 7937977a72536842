// The text of problems/reference/*.csv, embedded in the library at build time. Internal.
#pragma once

#include <string_view>

namespace irk {

extern const std::string_view kEmbeddedReferences;

}  // namespace irk
