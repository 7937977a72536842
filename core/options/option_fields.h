// The one table of the options of an integration. A member that is added to IntegratorOptions, or to a struct in it,
// needs its line in option_fields.cpp, which does not compile without.
#pragma once

#include <span>

#include "core/options/field.h"
#include "irk/options.h"

namespace irk {

using OptionField = Field<IntegratorOptions>;

/// Every option, in the order of tables and keys.
std::span<const OptionField> optionFields();

}  // namespace irk
