#include "experiments/report/figure_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/html.h"
#include "experiments/report/drawn_rows.h"
#include "experiments/report/scripts.h"

namespace irk {
namespace {

constexpr double kWide = 700;  // points; wider figures take a whole row

// The width and height of an SVG file in points, as its first line says; 0 if it does not.
std::pair<double, double> sizeOf(const std::filesystem::path& svg) {
  std::ifstream in(svg);
  std::string text(1000, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const auto after = [&](std::string_view name) {
    const auto at = text.find(name);
    return at == text.npos ? 0 : std::strtod(text.c_str() + at + name.size(), nullptr);
  };
  return {after("width=\""), after("height=\"")};
}

// The existing files that the figure is drawn from: the tables that its script reads, the file that it names, or the
// solutions of its scenes and cases.
std::vector<std::string> tablesOf(const Figure& figure, const ReportOptions& options) {
  const auto folder = options.results / figure.study;
  std::vector<std::string> names =
      readScript(options.home, std::filesystem::path(figure.script).replace_extension()).tables;
  if (const std::string file = optionsOf(figure.assignments)["file_name"]; !file.empty()) {
    names = {file + ".csv"};
  } else if (names.empty()) {
    std::string words = figure.assignments;
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c == '\'' || c == '=' || c == ';'; }, ' ');
    std::istringstream in(words);
    std::vector<std::string> stems{std::istream_iterator<std::string>(in), {}};
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      const std::string name = entry.path().filename();
      const bool named = std::any_of(stems.begin(), stems.end(), [&](const std::string& stem) {
        return name.starts_with(stem + ".") && entry.path().extension() == ".csv";
      });
      if (named) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
  }
  std::erase_if(names, [&](const std::string& name) { return !std::filesystem::exists(folder / name); });
  return names;
}

// A title that ends as a sentence does, such as a question, needs no full stop.
const char* stopAfter(const std::string& title) {
  return !title.empty() && std::string_view(".?!").find(title.back()) != std::string_view::npos ? "" : ".";
}

}  // namespace

std::string figureHtml(const Figure& figure, const ReportOptions& options) {
  const auto [width, height] = sizeOf(figureFolder(options) / (figure.name + ".svg"));
  const std::string size =
      width > 0 && height > 0 ? fmt::format(" width=\"{:.0f}\" height=\"{:.0f}\"", width, height) : "";
  std::string tables;
  for (const auto& name : tablesOf(figure, options)) {
    tables += linkHtml(fmt::format("../{}/{}", figure.study, name), name) + " · ";
  }
  return fmt::format(
      "<figure id=\"{0}\"{1}><div class=\"canvas\"><a href=\"figures/{0}.svg\"><img src=\"figures/{0}.svg\" "
      "alt=\"Diagram: {2}\"{3} loading=\"lazy\"></a></div>\n<figcaption><b>{2}{7}</b> {4}<br>{5}<a "
      "href=\"figures/{0}.png\">PNG</a>"
      "<details><summary>Draw it again</summary><code>{6}</code></details></figcaption></figure>\n",
      figure.name, width > kWide ? " class=\"wide\"" : "", escapeHtml(figure.title), size, escapeHtml(figure.caption),
      tables, escapeHtml(shellCommand(figure, options)), stopAfter(figure.title));
}

}  // namespace irk
