// Tables as HTML.
#pragma once

#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace irk {

/// The table of orders with verdicts; each row has its verdict as HTML class.
std::string ordersHtml(const std::string& study, const Table& orders);

/// The table of the families' properties: tableaus.csv.
std::string tableausHtml(const Table& tableaus);

/// The head of a table of runs, and counts of the runs' outcomes.
std::string environmentHtml(const std::string& study, const Table& runs);

}  // namespace irk
