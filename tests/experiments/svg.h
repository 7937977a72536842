// Reads the curves of a gnuplot SVG figure, in the units of the labels on its axes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace irk {

struct SvgPoint {
  double x, y;
};

/// One element of a `plot` command: its marks, the corners of its lines, its filled boxes.
struct SvgCurve {
  std::vector<SvgPoint> marks;
  std::vector<SvgPoint> line;
  int pieces = 0;                                                    ///< of the line, which may have gaps
  std::vector<std::pair<std::string, std::vector<SvgPoint>>> boxes;  ///< colour, corners
};

struct SvgLabel {
  double pixel;
  std::string text;  ///< `10^-3` with its exponent behind ^
};

struct SvgPanel {
  std::map<int, SvgCurve> curves;  ///< by position in the plot command, from 1
  std::vector<SvgLabel> x, y;
};

enum class AxisScale { kLinear, kLogarithmic };

/// The value of a label such as `0.5`, `10^-3`, `2·10^-3`, `25 %`; NaN for words.
inline double labelNumber(std::string text) {
  double factor = 1;
  if (const auto dot = text.find("·"); dot != text.npos) {
    factor = std::strtod(text.c_str(), nullptr);
    text = text.substr(dot + std::string("·").size());
  }
  if (const auto percent = text.find('%'); percent != text.npos) factor = 0.01;
  if (const auto minus = text.find("−"); minus != text.npos) text.replace(minus, 3, "-");
  char* end = nullptr;
  const double base = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return std::nan("");
  if (*end == '^') return factor * std::pow(base, std::strtod(end + 1, nullptr));
  return *end == '\0' || *end == ' ' ? factor * base : std::nan("");
}

class Svg {
 public:
  explicit Svg(const std::filesystem::path& file) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line); text_ += line + '\n') read(line);
  }

  /// The number of occurrences of a text in the file.
  int occurrences(const std::string& text) const { return count(text_, text.c_str()); }

  /// Panels are called 'a', 'b', ... in the order of drawing.
  const SvgPanel& panel(char letter) const {
    static const SvgPanel nothing;
    const auto found = panels_.find(letter);
    return found == panels_.end() ? nothing : found->second;
  }
  const SvgCurve& curve(char letter, int number) const {
    static const SvgCurve nothing;
    const auto& curves = panel(letter).curves;
    const auto found = curves.find(number);
    return found == curves.end() ? nothing : found->second;
  }

  /// Converts pixels of a panel to numbers on its axes. A panel without labels uses those of the previous one.
  std::vector<SvgPoint> numbers(char letter, const std::vector<SvgPoint>& pixels, AxisScale x, AxisScale y) const {
    std::vector<SvgPoint> all;
    for (const auto& p : pixels) {
      all.push_back({onAxis(labels(letter, &SvgPanel::x), p.x, x), onAxis(labels(letter, &SvgPanel::y), p.y, y)});
    }
    return all;
  }
  std::vector<SvgPoint> marks(char letter, int number, AxisScale x, AxisScale y) const {
    return numbers(letter, curve(letter, number).marks, x, y);
  }
  std::vector<SvgPoint> line(char letter, int number, AxisScale x, AxisScale y) const {
    return numbers(letter, curve(letter, number).line, x, y);
  }

  /// The curves of a panel that have marks, in order.
  std::vector<int> marked(char letter) const {
    std::vector<int> numbers;
    for (const auto& [number, curve] : panel(letter).curves) {
      if (!curve.marks.empty()) numbers.push_back(number);
    }
    return numbers;
  }

  /// The label nearest to a position on an axis whose labels name cells.
  std::string labelX(char letter, double pixel) const { return nearest(labels(letter, &SvgPanel::x), pixel); }
  std::string labelY(char letter, double pixel) const { return nearest(labels(letter, &SvgPanel::y), pixel); }

 private:
  const std::vector<SvgLabel>& labels(char letter, std::vector<SvgLabel> SvgPanel::*axis) const {
    while (letter > 'a' && (panel(letter).*axis).size() < 2) --letter;
    return panel(letter).*axis;
  }

  static double onAxis(const std::vector<SvgLabel>& labels, double pixel, AxisScale axis) {
    std::vector<std::pair<double, double>> known;
    for (const auto& label : labels) {
      const double number = labelNumber(label.text);
      if (std::isnan(number) || (axis == AxisScale::kLogarithmic && number <= 0)) continue;
      known.emplace_back(label.pixel, axis == AxisScale::kLogarithmic ? std::log10(number) : number);
    }
    if (known.size() < 2) return std::nan("");
    const auto [p0, v0] = known.front();
    const auto [p1, v1] = known.back();
    const double v = v0 + (v1 - v0) * (pixel - p0) / (p1 - p0);
    return axis == AxisScale::kLogarithmic ? std::pow(10, v) : v;
  }

  static std::string nearest(const std::vector<SvgLabel>& labels, double pixel) {
    std::string text = "no label";
    double least = 1e300;
    for (const auto& label : labels) {
      if (std::abs(label.pixel - pixel) < least) least = std::abs(label.pixel - pixel), text = label.text;
    }
    return text;
  }

  void read(const std::string& line) {
    static const std::regex start("id=\"gnuplot_plot_([0-9]+)([a-z]?)\"");
    std::smatch found;
    if (std::regex_search(line, found, start)) {
      const char letter = found[2].length() ? found[2].str()[0] : 'a';
      const int number = std::stoi(found[1]);
      SvgPanel& panel = panels_[letter];
      if (panel.curves.empty()) {
        panel.x = std::move(x_);
        panel.y = std::move(y_);
        x_.clear();
        y_.clear();
      }
      inside_ = &panel.curves[number];
      in_path_ = with_sample_ = first_line_ = false;
      depth_ = 0;
    }
    if (inside_) {
      readCurve(line);
      depth_ += count(line, "<g ") - count(line, "</g>");
      if (depth_ > 0) return;
      if (with_sample_ && !inside_->marks.empty()) inside_->marks.pop_back();
      inside_ = nullptr;
    } else {
      readLabel(line);
    }
  }

  static int count(const std::string& line, const char* part) {
    int n = 0;
    for (auto at = line.find(part); at != line.npos; at = line.find(part, at + 1)) ++n;
    return n;
  }

  static std::vector<SvgPoint> points(const std::string& text) {
    static const std::regex pair("(-?[0-9.]+),(-?[0-9.]+)");
    std::vector<SvgPoint> all;
    for (std::sregex_iterator i(text.begin(), text.end(), pair), end; i != end; ++i) {
      all.push_back({std::stod((*i)[1]), std::stod((*i)[2])});
    }
    return all;
  }

  void readCurve(const std::string& line) {
    static const std::regex mark("<use xlink:href='#gpPt[0-9]+' transform='translate\\((-?[0-9.]+),(-?[0-9.]+)\\)");
    static const std::regex box("<polygon fill = '([^']*)'[^>]*points = '([^']*)'");
    // If the key is inside the panel, a titled curve has a sample there: its first line and its last mark.
    if (line.find("<text>") != line.npos) with_sample_ = first_line_ = true;
    for (std::sregex_iterator i(line.begin(), line.end(), mark), end; i != end; ++i) {
      inside_->marks.push_back({std::stod((*i)[1]), std::stod((*i)[2])});
    }
    for (std::sregex_iterator i(line.begin(), line.end(), box), end; i != end; ++i) {
      inside_->boxes.emplace_back((*i)[1], points((*i)[2]));
    }
    // A path may continue over several lines.
    std::size_t from = 0;
    if (!in_path_) {
      const auto path = line.find("<path ");
      if (path == line.npos) return;
      const auto d = line.find(" d='", path);
      if (d == line.npos) return;
      from = d + 4;
      in_path_ = true;
    }
    const auto end = line.find('\'', from);
    if (first_line_) {
      first_line_ = false;
      from = std::min(line.find('M', from + 1), end);
    }
    const std::string data = line.substr(from, end == line.npos ? end : end - from);
    for (const auto& p : points(data)) inside_->line.push_back(p);
    inside_->pieces += count(data, "M");
    if (end != line.npos) in_path_ = false;
  }

  // A label takes two lines: its position (after the tick, if ticks are drawn) and its text.
  void readLabel(const std::string& line) {
    static const std::regex place(
        "<g transform=\"translate\\((-?[0-9.]+),(-?[0-9.]+)\\)\".*text-anchor=\"(middle|end)\"");
    static const std::regex tick("<path [^>]*d='M(-?[0-9.]+),(-?[0-9.]+) L");
    std::smatch found;
    if (std::regex_search(line, found, place)) {
      to_ = found[3] == "middle" ? &x_ : &y_;
      constexpr double kBaseline = 3.9;  // of the font, below the middle of the tick
      pixel_ = to_ == &x_ ? std::stod(found[1]) : std::stod(found[2]) - kBaseline;
      if (to_ == &y_ && std::regex_search(line, found, tick)) pixel_ = std::stod(found[2]);
      return;
    }
    const bool text = to_ && line.find("<text>") != line.npos;
    if (text && plain(line).find_first_not_of(' ') != std::string::npos) to_->push_back({pixel_, plain(line)});
    to_ = nullptr;
  }

  // `<tspan>10</tspan><tspan font-size="9.6" dy="-6.00px">-2</tspan>` is 10^-2.
  static std::string plain(const std::string& line) {
    std::string text;
    for (std::size_t i = 0; i < line.size();) {
      if (line[i] == '<') {
        const auto end = line.find('>', i);
        const std::string tag = line.substr(i, end - i);
        if (tag.find("dy=\"-") != tag.npos) text += '^';
        i = end + 1;
      } else {
        if (line[i] != '\t') text += line[i];
        ++i;
      }
    }
    return text;
  }

  std::string text_;
  std::map<char, SvgPanel> panels_;
  std::vector<SvgLabel> x_, y_;  // of the next panel
  std::vector<SvgLabel>* to_ = nullptr;
  double pixel_ = 0;
  SvgCurve* inside_ = nullptr;
  int depth_ = 0;
  bool in_path_ = false, with_sample_ = false, first_line_ = false;
};

/// Compares points in the same order, with the accuracy of pixels: `tolerance` is relative.
inline void expectPoints(const std::vector<SvgPoint>& seen, const std::vector<SvgPoint>& expected,
                         const std::string& what, double tolerance = 5e-3) {
  ASSERT_EQ(seen.size(), expected.size()) << what;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_NEAR(seen[i].x, expected[i].x, tolerance * std::abs(expected[i].x) + 1e-300) << what << ", point " << i;
    EXPECT_NEAR(seen[i].y, expected[i].y, tolerance * std::abs(expected[i].y) + 1e-300) << what << ", point " << i;
  }
}

}  // namespace irk
