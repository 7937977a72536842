// Completion, made from the options of the command line, and examples of verbs.
#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace irk {

/// Examples of a verb, "solve" or "tableau show", for its help: lines that begin with two blanks; empty if it has none.
std::string examplesOf(const std::string& verb);

/// Prints a script for `shell`, bash, zsh or fish, that completes what printNextWords offers. Throws Misuse for another
/// one.
void printCompletion(const std::string& shell, std::ostream& out);

/// Prints what may stand in place of the last of `words`, the arguments of the program so far: verbs, options or
/// values, one a line, a description behind a tab. Words that do not begin like the last one are for the shell to leave
/// out. Returns 0 if a file may stand there as well, else 1.
int printNextWords(const CLI::App& program, std::vector<std::string> words, std::ostream& out);

}  // namespace irk
