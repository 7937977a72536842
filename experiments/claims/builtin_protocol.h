// claims.toml, embedded at build time.
#pragma once

#include <string_view>

namespace irk::claims {

std::string_view builtinProtocol();

}  // namespace irk::claims
