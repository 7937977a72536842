// HTML escaping and placeholders.
#pragma once

#include <string>
#include <string_view>

namespace irk {

/// The text with `&`, `<`, `>` and `"` as entities.
std::string escapeHtml(std::string_view text);

/// Replaces every occurrence of the placeholder.
void replacePlaceholder(std::string& page, std::string_view placeholder, std::string_view text);

}  // namespace irk
