#include "experiments/report/answers/answer.h"

#include <fmt/format.h>

#include <cmath>

namespace irk::report {

Answer unknownAnswer(std::string id, std::string question, std::string_view study) {
  return {.id = std::move(id),
          .question = std::move(question),
          .sentences = {fmt::format("Not known yet: `irk run {}` makes the runs that answer this.", study)}};
}

std::string answerHtml(const Answer& answer, bool preliminary) {
  std::string html = fmt::format("<section class=\"answer\" id=\"{}\">\n<h3>{}</h3>\n", escapeHtml(answer.id),
                                 escapeHtml(answer.question));
  for (const auto& sentence : answer.sentences) {
    html += fmt::format("<p class=\"say\">{}{}</p>\n", preliminary ? "<em>Preliminary.</em> " : "", codeHtml(sentence));
    preliminary = false;  // once is enough for the sentences
  }
  html += htmlOf(answer.shown);
  if (!answer.more.rows.empty()) {
    html += fmt::format("<details><summary>{}</summary>\n{}</details>\n", escapeHtml(answer.more.caption),
                        htmlOf(answer.more));
  }
  if (!answer.note.empty()) html += fmt::format("<p class=\"note\">{}</p>\n", codeHtml(answer.note));
  std::string links;
  for (const auto& [target, text] : answer.links) links += (links.empty() ? "" : " · ") + linkHtml(target, text);
  if (!links.empty()) html += fmt::format("<p class=\"links\">{}</p>\n", links);
  return html + "</section>\n";
}

std::string codeHtml(std::string_view text) {
  const std::string escaped = escapeHtml(text);
  std::string html;
  bool inside = false;
  for (const char c : escaped) {
    if (c != '`') {
      html += c;
      continue;
    }
    html += inside ? "</code>" : "<code>";
    inside = !inside;
  }
  return inside ? escaped : html;
}

std::string factorText(double factor) {
  if (!std::isfinite(factor)) return "–";
  return factor < 9.95 ? fmt::format("{:.1f}", factor) : fmt::format("{:.0f}", factor);
}

std::string errorText(double error) {
  const int exponent = static_cast<int>(std::lround(std::log10(error)));
  const bool power = std::abs(std::log10(error) - exponent) < 1e-9;
  return power ? fmt::format("1e{}", exponent) : fmt::format("{:g}", error);
}

std::string listText(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

}  // namespace irk::report
