// Completion scripts and the manual page, generated from the options of the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

namespace irk {

/// Examples of a verb, "solve" or "tableau show", for its help: lines that begin with two blanks; empty if it has none.
std::string examplesOf(const std::string& verb);

/// Prints a script that completes verbs, options and their values in `shell`: bash, zsh or fish. Throws Misuse for
/// another one.
void printCompletion(const CLI::App& program, const std::string& shell, std::ostream& out);

/// Prints a manual page in roff.
void printManual(const CLI::App& program, std::ostream& out);

}  // namespace irk
