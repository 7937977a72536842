// The tables of experiments/guide/tables.md, as a reader finds them.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace irk {

inline std::string guidePage(const std::string& name) {
  std::ifstream file(IRK_SOURCE_DIR "/experiments/guide/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct PageTable {
  std::string file;  ///< `orders.csv`
  bool begins_with_series = false;
  std::vector<std::string> columns = {};   ///< behind those of a series
  std::vector<std::string> meanings = {};  ///< of the columns, without escapes
};

inline std::string withoutEscapes(std::string text) {
  for (std::size_t at = 0; (at = text.find("\\|", at)) != text.npos; ++at) text.erase(at, 1);
  return text;
}

/// All tables of the page, in its order.
inline std::vector<PageTable> pageTables() {
  std::vector<PageTable> tables;
  std::istringstream page(guidePage("tables.md"));
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) {
      tables.push_back({line.substr(3)});
    } else if (line.starts_with("It begins with the columns of a series")) {
      tables.back().begins_with_series = true;
    } else if (line.starts_with("| `")) {
      const std::size_t name_end = line.find("` | ");
      const std::size_t meaning = line.find(" | ", name_end + 4) + 3;
      tables.back().columns.push_back(line.substr(3, name_end - 3));
      tables.back().meanings.push_back(withoutEscapes(line.substr(meaning, line.size() - meaning - 2)));
    }
  }
  return tables;
}

}  // namespace irk
