// Tables as HTML.
#pragma once

#include <string>
#include <string_view>

#include "experiments/table.h"

namespace irk {

std::string escapeHtml(std::string_view text);

/// Replaces every occurrence.
void replacePlaceholder(std::string& page, std::string_view placeholder, std::string_view text);

/// Orders with their verdicts; rows carry the verdict as class.
std::string ordersHtml(const std::string& study, const Table& orders);

/// Properties of the families: tableaus.csv.
std::string tableausHtml(const Table& tableaus);

/// The head of a table of runs, and how its runs ended.
std::string environmentHtml(const std::string& study, const Table& runs);

}  // namespace irk
