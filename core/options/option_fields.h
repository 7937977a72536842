// The one table of the options of an integration. Whoever adds a member to IntegratorOptions adds its line there; else
// core/options/option_fields.cpp does not compile.
#pragma once

#include <span>

#include "core/options/field.h"
#include "irk/options.h"

namespace irk {

using OptionField = Field<IntegratorOptions>;

/// Every option, in the order of tables and keys.
std::span<const OptionField> optionFields();

}  // namespace irk
