// Where a tableau comes from: an id's construction or a file, in the precision that it was made in.
#pragma once

#include <string_view>

#include "tableaus/files/file.h"

namespace irk {

/// makeTableau before rounding, with source and digits. Throws Misuse as makeTableau.
TableauFile findTableau(std::string_view id_or_file);

/// The same without the check of a file against its own header: for reports about it.
TableauFile findUncheckedTableau(std::string_view id_or_file);

}  // namespace irk
