// What is checked of the command line before CLI11 reads it, whose messages would mislead.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

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

}  // namespace irk
