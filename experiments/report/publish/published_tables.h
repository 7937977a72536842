// The small tables of results that `irk publish` writes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/report/answers/answer.h"
#include "experiments/report/figure_list.h"
#include "experiments/tables/table.h"

namespace irk::report {

struct PublishedTable {
  std::string_view study;  ///< of its file study/name.csv; empty: computed from the claims or an answer of the page
  std::string_view name;
  std::string_view row;  ///< what one row is
  std::string_view key;  ///< the columns that tell a row from all others, with blanks between them
};
std::span<const PublishedTable> publishedTables();

/// The tables in the order of publishedTables(). Their heads have the study and the key, by which `irk compare` matches
/// rows; not date and machine, which published.csv has. Throws Failure if one is missing.
std::vector<Table> readPublishedTables(const ReportOptions& options, const std::vector<Answer>& answers);

}  // namespace irk::report
