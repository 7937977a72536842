#include "experiments/runs/block_names.h"

namespace irk {

bool hasBlock(std::string_view names, std::string_view name) {
  while (!names.empty()) {
    const auto end = names.find(' ');
    if (names.substr(0, end) == name) return true;
    names.remove_prefix(end == names.npos ? names.size() : end + 1);
  }
  return false;
}

void addBlocks(std::string& names, std::string_view more) {
  while (!more.empty()) {
    const auto end = more.find(' ');
    const auto name = more.substr(0, end);
    if (!hasBlock(names, name)) names += (names.empty() ? "" : " ") + std::string(name);
    more.remove_prefix(end == more.npos ? more.size() : end + 1);
  }
}

}  // namespace irk
