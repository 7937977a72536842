// The one table of the settings of a run. Made from it: the options of `irk solve` with their help and the refusal
// of those without effect, the keys of study files, the text and the key of a run, the columns of its row and the
// names of series, its JSON, `irk list`, and validation.
//
// An option of the integrator is a line in core/options/option_fields.cpp and is here by itself; another setting of a
// run is a line in fields.cpp. Without its line a new member of IntegratorOptions or RunSpec does not compile.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/options/field.h"
#include "experiments/runs/run_spec.h"

namespace irk {

struct SpecField : Field<RunSpec> {
  /// A series runs through it, as through steps and tolerances; every other field is part of a series' name.
  bool swept = false;
};

/// All fields in the order of texts, keys and columns.
std::span<const SpecField> specFields();
/// Throws Misuse naming the nearest field.
const SpecField& findField(std::string_view name);

/// The id of a scene that is named by its id or by a user's file, which is loaded. Throws Misuse.
std::string sceneNamed(const std::string& id_or_file);

/// On the command line: `--max-steps`; but `scene`, the argument, `--set` for settings and `--step` for h.
std::string optionName(std::string_view field);
/// `The meaning. [legal values; default ...]`
std::string helpText(const SpecField& field);

/// `field=value;field=value;...`, all fields. parseSpec(canonicalText(s)) equals s.
std::string canonicalText(const RunSpec& spec);
/// Fields that the text does not name are as in RunSpec{}. Throws Misuse.
RunSpec parseSpec(std::string_view text);

/// Throws Misuse for a value that its field would not take: naming field, value and what is legal.
void validate(const RunSpec& spec);

}  // namespace irk
