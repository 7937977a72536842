// references.csv of an audit: stored answers, which a repeated analysis need not compute again.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <set>

#include "experiments/audit/reference.h"
#include "experiments/tables/named_cells.h"

namespace irk::audit {

using Answers = std::map<Question, Answer>;

NamedCells answerCells(const Question& question, const Answer& answer);
/// Parses a row of these cells.
std::pair<Question, Answer> parseAnswer(const Table& table, const TableRow& row);

/// The answers to all questions. Uses the answers in `file` that this version of the program has written, computes
/// the others with `jobs` threads and appends them one by one. After an interrupt some may be missing.
Answers answersTo(const std::set<Question>& questions, const std::filesystem::path& file, int jobs,
                  std::ostream& progress);

}  // namespace irk::audit
