// The answers at the head of the page: a question, its answer in sentences, a small table, and links.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/html.h"
#include "experiments/tables/table.h"

namespace irk::report {

struct Answer {
  std::string id;  ///< of its element on the page; the table is answers_<id>.csv
  std::string question;
  std::vector<std::string> sentences = {};  ///< plain text; `code` between backticks
  Table table = {};                         ///< the numbers of the answer; without columns if there are none
  HtmlTable shown = {};                     ///< the most important ones, for the page
  HtmlTable more = {};                      ///< the others, folded
  std::string note = {};                    ///< how to read the table; plain text
  std::vector<std::pair<std::string, std::string>> links = {};  ///< target and text
};

/// The answer if tables are missing: it says so and names the command that makes them.
Answer unknownAnswer(std::string id, std::string question, std::string_view study);

/// The section of the page. `preliminary`: the runs are those of --quick, which the table's head says as well.
std::string answerHtml(const Answer& answer, bool preliminary);

/// Escaped text with `code` between backticks as an element.
std::string codeHtml(std::string_view text);
/// `1.8`, `12`, `340`: two digits.
std::string factorText(double factor);
/// `1e-08` as `1e-8`.
std::string errorText(double error);
/// `a`, `a and b`, `a, b and c`.
std::string listText(const std::vector<std::string>& items);

}  // namespace irk::report
