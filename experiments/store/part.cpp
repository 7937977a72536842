#include "experiments/store/part.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <utility>

#include "experiments/base/failure.h"
#include "experiments/store/checksum.h"
#include "experiments/tables/environment.h"

namespace irk::store {
namespace {

std::string oneLine(const TableRow& row) {
  TableRow cells = row;
  for (auto& cell : cells) {
    for (char& c : cell) {
      if (c == '\n' || c == '\r') c = ' ';
    }
  }
  return csvLine(cells);
}

[[noreturn]] void cannotReadPart(const std::filesystem::path& file) {
  throw Failure(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
}

[[noreturn]] void cannotWritePart(const std::filesystem::path& file) {
  throw Failure(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
}

std::string_view withoutReturn(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

PartReading::Names namesOf(std::string_view line, const std::vector<std::string>& columns) {
  std::vector<std::string_view> cells;
  if (!checkNames(line) || !splitLine(line, cells)) return PartReading::Names::kDamaged;
  return plainRow(cells) == columns ? PartReading::Names::kThese : PartReading::Names::kOthers;
}

}  // namespace

PartReading readPart(const std::filesystem::path& file, const std::vector<std::string>& columns,
                     const TakeWritten& take) {
  std::ifstream in(file, std::ios::binary);
  if (!in) cannotReadPart(file);
  PartReading reading;
  std::string line;
  if (!std::getline(in, line)) return reading;
  reading.names = namesOf(withoutReturn(line), columns);
  std::uint64_t offset = line.size() + 1;
  std::vector<std::string_view> cells;
  const auto problemOf = [&](std::string_view text) -> std::string {
    if (in.eof()) return "it has no line end";
    if (!checkRow(text)) return "its checksum is wrong";
    if (!splitLine(text, cells) || cells.size() != columns.size()) return "its cells are not those of the columns";
    return take(cells, offset);
  };
  const bool reads = reading.names == PartReading::Names::kThese;
  for (std::size_t number = 2; reads && std::getline(in, line); ++number) {
    std::string why = problemOf(withoutReturn(line));
    if (!why.empty()) reading.damaged.push_back({number, line, std::move(why)});
    offset += line.size() + 1;
  }
  return reading;
}

std::uint64_t numberOfPart(const std::filesystem::path& part) {
  const std::string name = part.filename().string();
  const std::string word = name.substr(std::min(name.find('.'), name.size() - 1) + 1);
  const char* end = word.data() + std::min(word.find('.'), word.size());
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end ? number : 0;
}

std::string partName(std::string_view table, std::uint64_t number) {
  return fmt::format("{}.{:04}.{}.{}", table, number, hostName(), getpid());
}

std::vector<std::filesystem::path> partsInOrder(const std::filesystem::path& folder, std::string_view table) {
  std::vector<std::filesystem::path> parts;
  if (!std::filesystem::is_directory(folder)) return parts;
  const auto prefix = std::string(table) + '.';
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(".csv")) parts.push_back(entry.path());
  }
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return std::pair(numberOfPart(a), a.filename()) < std::pair(numberOfPart(b), b.filename());
  });
  return parts;
}

PartWriter::PartWriter(std::filesystem::path folder, std::string name, std::vector<std::string> columns)
    : folder_(std::move(folder)), name_(std::move(name)), columns_(std::move(columns)) {}

PartWriter::~PartWriter() {
  if (descriptor_ < 0) return;
  fsync(descriptor_);
  close(descriptor_);
}

void PartWriter::open() {
  std::filesystem::create_directories(folder_);
  for (int i = 1; descriptor_ < 0; ++i) {
    file_ = folder_ / (i == 1 ? name_ + ".csv" : fmt::format("{}_{}.csv", name_, i));
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) {
      cannotWritePart(file_);
    }
  }
  write(sealedNames(csvLine(columns_)) + '\n');
}

void PartWriter::write(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size() && !failed_) {
    const auto count = ::write(descriptor_, text.data() + done, text.size() - done);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      failed_ = true;
    }
  }
  if (failed_) cannotWritePart(file_);
  size_ += text.size();
}

std::uint64_t PartWriter::append(const TableRow& row) {
  if (descriptor_ < 0) open();
  const std::uint64_t offset = size_;
  write(sealedRow(oneLine(row)) + '\n');
  return offset;
}

}  // namespace irk::store
