// references.csv of an audit: stored answers, which a repeated analysis need not compute again.
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
/// Parses a row made by answerRow.
std::pair<Question, Answer> parseAnswer(const Table& table, const TableRow& row);

/// The answers to all questions. Uses the answers in `file` that this version of the program has written, computes
/// the others with `jobs` threads and appends them one by one. After an interrupt some may be missing.
Answers answersTo(const std::set<Question>& questions, const std::filesystem::path& file, int jobs,
                  std::ostream& progress);

}  // namespace irk::audit
