#include "experiments/base/html.h"

namespace irk {

std::string escapeHtml(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html.append("&amp;");
        break;
      case '<':
        html.append("&lt;");
        break;
      case '>':
        html.append("&gt;");
        break;
      case '"':
        html.append("&quot;");
        break;
      default:
        html.push_back(c);
    }
  }
  return html;
}

void replacePlaceholder(std::string& page, std::string_view placeholder, std::string_view text) {
  for (auto at = page.find(placeholder); at != std::string::npos; at = page.find(placeholder, at + text.size())) {
    page.replace(at, placeholder.size(), text);
  }
}

}  // namespace irk
