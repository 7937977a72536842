// What is checked of the command line before CLI11 reads it, whose messages would mislead.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/base/range.h"
#include "experiments/commands/commands.h"
#include "experiments/runs/fields.h"

namespace irk {

/// Refuses empty values, which no option and no argument has: CLI11 would read `--method= x` as `--method x`. Throws
/// Misuse.
void refuseEmpty(const std::vector<std::string>& arguments);
/// Throws Misuse if argument i is not one of the parent's verbs, then checks the next argument with that verb's own
/// ones.
void requireKnownVerb(CLI::App& parent, const std::vector<std::string>& arguments, std::size_t i);
/// Checks options before the verb; behind it CLI11 names unknown options. Throws Misuse.
void requireKnownOption(const std::vector<std::string>& arguments);
/// The command that prints the help of the verb: "irk solve --help".
std::string helpOf(const std::vector<std::string>& arguments);

/// What a value is called in the help: ID, NUMBER, INTEGER, TEXT.
const char* valueName(FieldKind kind);

/// The help of a number: meaning, range and default.
std::string numberHelp(std::string_view meaning, const Range& range, std::string_view value);
/// Reads an integer; throws Misuse as parseInteger.
int integer(std::string_view name, std::string_view text, const Range& range);

/// The options of `irk solve` that no field of a run has.
void addSolveOptions(CLI::App& sub, SolveOptions& run);
/// The same of `irk ensemble`.
void addEnsembleOptions(CLI::App& sub, SolveOptions& run, EnsembleArguments& ensemble);

}  // namespace irk
