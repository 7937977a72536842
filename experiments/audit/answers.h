// references.csv of an audit: answers that a repeated analysis need not compute again.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <set>

#include "experiments/audit/reference.h"
#include "experiments/tables/table.h"

namespace irk::audit {

using Answers = std::map<Question, Answer>;

std::vector<std::string> answerColumns();
TableRow answerRow(const Question& question, const Answer& answer);
/// Of a row that answerRow made.
std::pair<Question, Answer> parseAnswer(const Table& table, const TableRow& row);

/// The answers to all questions: those that this version of the program left in `file`, the others
/// computed by `jobs` threads and appended as they come. After an interrupt: what there is.
Answers answersTo(const std::set<Question>& questions, const std::filesystem::path& file, int jobs,
                  std::ostream& progress);

}  // namespace irk::audit
