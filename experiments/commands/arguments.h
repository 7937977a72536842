// Checks of the command line before CLI11 reads it, because CLI11's messages would mislead.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "core/base/range.h"
#include "experiments/commands/commands.h"
#include "experiments/runs/fields.h"

namespace irk {

/// Throws Misuse for empty values. No option or argument may be empty, and CLI11 would read `--method= x` as `--method
/// x`.
void refuseEmpty(const std::vector<std::string>& arguments);
/// `help solve` becomes `solve --help`, and `help` becomes `--help`.
void replaceHelpVerb(std::vector<std::string>& arguments);
/// Throws Misuse if argument i is not one of the parent's verbs, then checks the next argument with that verb's own
/// ones; of the last verb it checks the names of options. The messages name the nearest verb or option.
void requireKnownVerb(CLI::App& parent, const std::vector<std::string>& arguments, std::size_t i);
/// Throws Misuse for an unknown option before the verb.
void requireKnownOption(const std::vector<std::string>& arguments);
/// The command that prints the help of the verb: "irk solve --help".
std::string helpOf(const std::vector<std::string>& arguments);

/// The name of a value's type in the help: ID, NUMBER, INTEGER, TEXT.
const char* valueName(FieldKind kind);

/// The help of a number: meaning, range and default.
std::string numberHelp(std::string_view meaning, const Range& range, std::string_view value);
/// Reads an integer; throws Misuse as parseInteger.
int integer(std::string_view name, std::string_view text, const Range& range);

/// The option --peers of the verbs that read a study.
void addPeersOption(CLI::App& sub, std::vector<std::string>& peers);
/// The options of `irk solve` that are not fields of a run.
void addSolveOptions(CLI::App& sub, SolveOptions& run);

/// The option of a field of a run. Its value goes to `run`, which has members for some fields, else to `fields`.
void addField(CLI::App& sub, const SpecField& field, SolveOptions& run, std::map<std::string, std::string>& fields);
/// `--digits N`, which sets the scalar `mpN`; to be added after --scalar.
void addDigits(CLI::App& sub, std::string& scalar);
/// The same for `irk ensemble`.
void addEnsembleOptions(CLI::App& sub, SolveOptions& run, EnsembleArguments& ensemble);
/// The options of `irk compare`.
void addCompareOptions(CLI::App& sub, CompareOptions& options);

}  // namespace irk
