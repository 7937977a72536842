// HTML: escaping, placeholders, tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// The text with `&`, `<`, `>` and `"` as entities.
std::string escapeHtml(std::string_view text);

/// Replaces every occurrence of the placeholder.
void replacePlaceholder(std::string& page, std::string_view placeholder, std::string_view text);

/// A table of the page. Cells are HTML; captions, titles and classes are plain text.
struct HtmlTable {
  struct Row {
    std::vector<std::string> cells;
    std::string css_class = {};
    std::string id = {};
  };
  std::string caption = {};
  std::vector<std::string> titles = {};  ///< one per column
  std::vector<Row> rows = {};
  std::string css_class = {};
};

/// The table in an element that scrolls. Each cell repeats its column's title for narrow screens, where rows are
/// stacked; the page's script sorts and filters. An empty text for a table without rows.
std::string htmlOf(const HtmlTable& table);

/// `<a href="target">text</a>`; both plain text.
std::string linkHtml(std::string_view target, std::string_view text);

}  // namespace irk
