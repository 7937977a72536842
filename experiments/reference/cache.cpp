#include "experiments/reference/cache.h"

#include <fmt/format.h>

#include <filesystem>

#include "experiments/base/folders.h"
#include "experiments/base/numbers.h"
#include "experiments/reference/tables.h"

namespace irk {
namespace {

std::filesystem::path fileOf(const ReferenceQuestion& question) {
  return cacheFolder("references") / (hexText(fnv1a(keyText(question))) + ".csv");
}

// A hash of all rows and of the lines above it in the head: a file of which a part is missing or changed has another.
std::string checksum(const Table& table) {
  std::string text;
  for (const auto& [key, value] : table.head) {
    if (key != "checksum") text += key + '\n' + value + '\n';
  }
  for (const auto& row : table.rows) text += csvLine(row);
  return hexText(fnv1a(text));
}

std::string valueOf(const Table& table, std::string_view wanted) {
  for (const auto& [key, value] : table.head) {
    if (key == wanted) return value;
  }
  throw Misuse(fmt::format("no line '{}' in the head", wanted));
}

ComputedReference read(const std::filesystem::path& file, const ReferenceQuestion& question) {
  const Table table = readTable(file);
  if (valueOf(table, "question") != keyText(question)) throw Misuse("another question");
  if (valueOf(table, "checksum") != checksum(table)) throw Misuse("damaged");
  ComputedReference reference;
  reference.values = referenceValues(file.string(), table);
  reference.problem = valueOf(table, "problem");
  reference.in_double = valueOf(table, "in double because");
  reference.accuracy = cellNumber(valueOf(table, "accuracy"));
  reference.seconds = cellNumber(valueOf(table, "seconds"));
  return reference;
}

}  // namespace

std::optional<ComputedReference> keptReference(const ReferenceQuestion& question) {
  const auto file = fileOf(question);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  try {
    return read(file, question);
  } catch (const std::exception&) {
    return {};  // with any fault of the file the reference is made again
  }
}

void keepReference(const ReferenceQuestion& question, const ComputedReference& reference) {
  Table table = referenceTable({{"made by", "irk, as a reference of runs"},
                                {"question", keyText(question)},
                                {"problem", reference.problem},
                                {"in double because", reference.in_double},
                                {"accuracy", numberText(reference.accuracy)},
                                {"seconds", numberText(reference.seconds)}},
                               reference.values);
  table.head.emplace_back("checksum", checksum(table));
  writeTable(fileOf(question), table);
}

}  // namespace irk
