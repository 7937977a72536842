#include "experiments/store/checksum.h"

#include "experiments/base/numbers.h"

namespace irk::store {
namespace {

constexpr std::string_view kRowMark = ",", kNamesMark = ",checksum:";

std::string endOf(std::string_view line, std::string_view mark) { return std::string(mark) + hexText(fnv1a(line)); }

bool check(std::string_view& line, std::string_view mark) {
  constexpr std::size_t kDigits = 16;
  if (line.size() < mark.size() + kDigits) return false;
  const auto before = line.substr(0, line.size() - mark.size() - kDigits);
  if (line.substr(before.size()) != endOf(before, mark)) return false;
  line = before;
  return true;
}

}  // namespace

std::string sealedRow(std::string_view line) { return std::string(line) + endOf(line, kRowMark); }
std::string sealedNames(std::string_view line) { return std::string(line) + endOf(line, kNamesMark); }
bool checkRow(std::string_view& line) { return check(line, kRowMark); }
bool checkNames(std::string_view& line) { return check(line, kNamesMark); }

}  // namespace irk::store
