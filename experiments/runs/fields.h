// The one table of the settings of a run. It generates the options of `irk solve` with their help and the refusal of
// options without effect, the keys of study files, the text and the key of a run, the columns of its row, the names of
// series, its JSON, `irk list`, and validation.
//
// An option of the integrator needs a line in core/options/option_fields.cpp only; any other setting of a run needs a
// line in fields.cpp. A new member of IntegratorOptions or RunSpec does not compile without its line.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/options/field.h"
#include "experiments/runs/run_spec.h"

namespace irk {

struct SpecField : Field<RunSpec> {
  /// Whether a series runs through this field, as through steps and tolerances. Fields that are not swept are part of
  /// the name of a series.
  bool swept = false;
};

/// All fields in the order of texts, keys and columns.
std::span<const SpecField> specFields();
/// The field `error_bars` has the option --error-bar and the key `error_bar` in studies; the column `error_bar` holds
/// the measured size.
inline constexpr std::string_view kErrorBarKey = "error_bar";
/// Throws Misuse for an unknown name; the message names the nearest field.
const SpecField& findField(std::string_view name);

/// The id of a scene that is given by its id or by a user's file, which this function loads. Throws Misuse.
std::string sceneNamed(const std::string& id_or_file);

/// The option on the command line: `--max-steps`. Exceptions: `scene`, an argument; `--set` for settings; `--step` for
/// h.
std::string optionName(std::string_view field);
/// `The meaning. [legal values; default ...]`
std::string helpText(const SpecField& field);

/// All fields as `field=value;field=value;...`. parseSpec(canonicalText(s)) equals s.
std::string canonicalText(const RunSpec& spec);
/// The spec of a text. Fields that the text does not name have their defaults. Throws Misuse.
RunSpec parseSpec(std::string_view text);

/// Throws Misuse for a value that its field does not accept; the message names field, value and legal values.
void validate(const RunSpec& spec);

}  // namespace irk
