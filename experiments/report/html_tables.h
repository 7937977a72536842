// Tables as HTML.
#pragma once

#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace irk {

/// Orders with their verdicts; rows carry the verdict as class.
std::string ordersHtml(const std::string& study, const Table& orders);

/// Properties of the families: tableaus.csv.
std::string tableausHtml(const Table& tableaus);

/// The head of a table of runs, and how its runs ended.
std::string environmentHtml(const std::string& study, const Table& runs);

}  // namespace irk
