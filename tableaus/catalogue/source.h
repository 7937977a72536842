// Finds a tableau by id or file, in the precision in which it was constructed or read.
#pragma once

#include <string_view>

#include "tableaus/files/file.h"

namespace irk {

/// As makeTableau, but without rounding and with source and digits. Throws Misuse as makeTableau.
TableauFile findTableau(std::string_view id_or_file);

/// As findTableau, but a file is not checked against its own header: for reports about it.
TableauFile findUncheckedTableau(std::string_view id_or_file);

}  // namespace irk
