// The one table of all options of an integration. A new member of IntegratorOptions, or of a struct in it, needs a line
// in option_fields.cpp, which does not compile without it.
#pragma once

#include <span>

#include "core/options/field.h"
#include "irk/options.h"

namespace irk {

using OptionField = Field<IntegratorOptions>;

/// Every option, in the order of tables and keys.
std::span<const OptionField> optionFields();

}  // namespace irk
