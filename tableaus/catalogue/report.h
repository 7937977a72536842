// The texts of `irk tableau` about a tableau given by id or file. Needs no multiprecision header.
#pragma once

#include <string>
#include <string_view>

#include "tableaus/analysis/check.h"

namespace irk {

/// The tableau in the layout of textbooks, with its orders; 1 <= digits <= 75 significant digits.
/// Throws Misuse as makeTableau; also for digits out of range.
std::string showTableau(std::string_view id_or_file, int digits);

/// A file that contradicts itself is reported, not refused. Throws Misuse if it cannot be parsed.
TableauReport checkTableau(std::string_view id_or_file);

/// The text of a tableau file with 50 digits. Throws Misuse as makeTableau.
std::string exportTableau(std::string_view id_or_file);

}  // namespace irk
