#include "experiments/store/checksum.h"

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstring>

namespace irk::store {
namespace {

constexpr std::size_t kDigits = 16;
constexpr std::string_view kRowMark = ",", kNamesMark = ",checksum:";

// The odd number next to 2^64 divided by the golden ratio (Knuth, The Art of Computer Programming 3, 6.4).
constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;

// Each of these operations can be undone: different words give different sums. The last one brings the highest bits,
// which a product does not spread, to lower ones.
std::uint64_t with(std::uint64_t sum, std::uint64_t word) {
  sum = (sum ^ word) * kOdd;
  return sum ^ sum >> 32;
}

std::uint64_t wordAt(const char* bytes, std::size_t size = sizeof(std::uint64_t)) {
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest one");
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, size);
  return word;
}

// Whether `digits` are those of the checksum of `line`.
bool isChecksumOf(std::string_view line, std::string_view digits) {
  std::uint64_t given = 0;
  for (const char c : digits) {
    const bool is_digit = c >= '0' && c <= '9', is_letter = c >= 'a' && c <= 'f';
    if (!is_digit && !is_letter) return false;
    given = given << 4 | static_cast<std::uint64_t>(is_digit ? c - '0' : c - 'a' + 10);
  }
  return given == checksum(line);
}

std::string sealed(std::string_view line, std::string_view mark) {
  return fmt::format("{}{}{:016x}", line, mark, checksum(line));
}

bool check(std::string_view& line, std::string_view mark) {
  if (line.size() < mark.size() + kDigits) return false;
  const auto before = line.substr(0, line.size() - mark.size() - kDigits);
  const auto end = line.substr(before.size());
  if (!end.starts_with(mark) || !isChecksumOf(before, end.substr(mark.size()))) return false;
  line = before;
  return true;
}

}  // namespace

// Words are added to two sums in turn, because the processor multiplies the next one before the last one is ready.
std::uint64_t checksum(std::string_view bytes) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  std::uint64_t even = bytes.size(), odd = 1;
  const char* at = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= 2 * kWord; left -= 2 * kWord, at += 2 * kWord) {
    even = with(even, wordAt(at));
    odd = with(odd, wordAt(at + kWord));
  }
  if (left >= kWord) {
    even = with(even, wordAt(at));
    at += kWord;
    left -= kWord;
  }
  odd = with(odd, wordAt(at, left));
  return with(even, odd);
}

std::string sealedRow(std::string_view line) { return sealed(line, kRowMark); }
std::string sealedNames(std::string_view line) { return sealed(line, kNamesMark); }
bool checkRow(std::string_view& line) { return check(line, kRowMark); }
bool checkNames(std::string_view& line) { return check(line, kNamesMark); }

}  // namespace irk::store
