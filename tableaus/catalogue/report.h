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

/// The coefficients as text. Formats: `file`, a tableau file with 50 digits; `latex`, an array in the layout of
/// textbooks, with 10 digits; `numpy` and `c`, definitions of A, b, c and, if there are any, b_hat, with 17 digits.
/// Throws Misuse as makeTableau, and for another format.
std::string exportTableau(std::string_view id_or_file, std::string_view format);

}  // namespace irk
