#include "experiments/base/html.h"

#include <fmt/format.h>

namespace irk {

std::string escapeHtml(std::string_view text) {
  std::string html(text);
  replacePlaceholder(html, "&", "&amp;");
  replacePlaceholder(html, "<", "&lt;");
  replacePlaceholder(html, ">", "&gt;");
  replacePlaceholder(html, "\"", "&quot;");
  return html;
}

void replacePlaceholder(std::string& page, std::string_view placeholder, std::string_view text) {
  for (auto at = page.find(placeholder); at != std::string::npos; at = page.find(placeholder, at + text.size())) {
    page.replace(at, placeholder.size(), text);
  }
}

namespace {

constexpr std::string_view kNoBreak = "&nbsp;";

// A cell with no other spaces is kept in one line by its style, so that paper, which is narrow, may break it.
bool isKept(const std::string& cell) { return cell.find(kNoBreak) != cell.npos && cell.find(' ') == cell.npos; }

std::string breakable(std::string cell) {
  if (isKept(cell)) replacePlaceholder(cell, kNoBreak, " ");
  return cell;
}

// Phones leave out cells without a value.
std::string cellClass(const std::string& cell) { return cell == "–" ? "none" : isKept(cell) ? "keep" : ""; }

}  // namespace

std::string htmlOf(const HtmlTable& table) {
  if (table.rows.empty()) return {};
  const std::string caption = escapeHtml(table.caption);
  std::string html =
      fmt::format("<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\"><table class=\"data{}\">",
                  caption, table.css_class.empty() ? "" : " " + table.css_class);
  html += fmt::format("<caption>{}</caption>\n<thead><tr>", caption);
  for (const auto& title : table.titles) html += fmt::format("<th scope=\"col\">{}</th>", escapeHtml(title));
  html += "</tr></thead>\n<tbody>\n";
  const auto attribute = [](const char* name, const std::string& value) {
    return value.empty() ? std::string() : fmt::format(" {}=\"{}\"", name, escapeHtml(value));
  };
  for (const auto& row : table.rows) {
    html += fmt::format("<tr{}{}>", attribute("class", row.css_class), attribute("id", row.id));
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const auto title = i < table.titles.size() ? table.titles[i] : std::string();
      html += fmt::format("<td{} data-label=\"{}\"><div>{}</div></td>", attribute("class", cellClass(row.cells[i])),
                          escapeHtml(title), breakable(row.cells[i]));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string linkHtml(std::string_view target, std::string_view text) {
  return fmt::format("<a href=\"{}\">{}</a>", escapeHtml(target), escapeHtml(text));
}

}  // namespace irk
