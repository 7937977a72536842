// The options and tables of a script of plots/, read from its text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/toml/figure_tables.h"

namespace irk {

struct Script {
  std::vector<std::string> options;  ///< the names that it tests with exists("name"), and those of style.gp
  std::vector<std::string> tables;   ///< the *.csv of its lines `# Reads ...`
};

/// `name`: its path in `home`/plots without .gp. Throws Misuse naming the nearest script.
Script readScript(const std::filesystem::path& home, const std::string& name);

/// Throws Misuse with file and line, and the nearest name, for an unknown script, an option that the script does not
/// have, a column that its tables do not have, and a block that is none of `blocks` (not checked if these are empty).
void checkFigure(const FigureTable& figure, const std::filesystem::path& home, const std::vector<std::string>& blocks);

}  // namespace irk
