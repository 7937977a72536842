#include "experiments/store/rows.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ostream.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <ostream>
#include <tuple>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/store/checksum.h"

namespace irk::store {
namespace {

template <class Number>
Number numberOf(std::string_view text, int base = 10) {
  Number number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number, base);
  return number;
}

bool parseKey(std::string_view text, std::uint64_t& key) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), key, 16);
  return error == std::errc() && end == text.data() + text.size();
}

std::string contentsOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::filesystem::path asideOf(std::filesystem::path part) { return part.replace_extension(".damaged"); }

std::string asideText(const std::vector<DamagedLine>& damaged) {
  std::string text;
  for (const auto& line : damaged) text += fmt::format("line {}: {}\n", line.line, line.text);
  return text;
}

void writeAside(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  if (!(out << text).flush()) throw Failure(fmt::format("cannot write {}", file.string()));
}

// `3, 6 and 10: its checksum is wrong; 12: it has no line end`: the lines by their reasons, up to kShownLines of them.
std::string placesOf(const std::vector<DamagedLine>& damaged) {
  constexpr std::size_t kShownLines = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShownLines, damaged.size()); ++i) {
    const bool same = i > 0 && damaged[i].why == damaged[i - 1].why;
    const bool last = i + 1 == std::min(kShownLines, damaged.size()) || damaged[i + 1].why != damaged[i].why;
    text += fmt::format("{}{}", i == 0 ? "" : same ? ", " : "; ", damaged[i].line);
    if (last) text += ": " + damaged[i].why;
  }
  return damaged.size() > kShownLines ? text + "; ..." : text;
}

}  // namespace

// Indices of the columns that decide which row is valid; npos for a column that a table lacks.
struct Rows::Columns {
  explicit Columns(const std::vector<std::string>& names) {
    const auto find = [&names](std::string_view name) {
      return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    code = find("code");
    date = find("date");
    remade = find("remade");
    repetitions = find("cpu_runs");
    environment = find("environment");
    cpu_environment = find("cpu_environment");
    outcome = find("outcome");
  }
  std::size_t code, date, remade, repetitions, environment, cpu_environment, outcome;
};

std::uint64_t keyNumber(std::string_view key) { return numberOf<std::uint64_t>(key, 16); }

std::uint32_t secondsOf(std::string_view date) {
  std::tm time{};
  const bool is_date = strptime(std::string(date).c_str(), "%Y-%m-%dT%H:%M:%SZ", &time) != nullptr;
  return is_date ? static_cast<std::uint32_t>(timegm(&time)) : 0;
}

Rows::Rows(const std::filesystem::path& folder, std::string name, std::vector<std::string> columns,
           std::string_view code)
    : folder_(folder / "parts"),
      name_(std::move(name)),
      columns_(std::move(columns)),
      at_(std::make_unique<Columns>(columns_)),
      names_(1),
      current_(idOf(at_->code < columns_.size() ? code : "")) {}

Rows::~Rows() {
  for (const int file : descriptors_) {
    if (file >= 0) close(file);
  }
}

std::uint16_t Rows::idOf(std::string_view name) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i] == name) return static_cast<std::uint16_t>(i);
  }
  if (names_.size() > std::numeric_limits<std::uint16_t>::max()) {
    throw Failure(fmt::format("{}: more than 65536 codes, environments and outcomes", folder_.string()));
  }
  names_.emplace_back(name);
  return static_cast<std::uint16_t>(names_.size() - 1);
}

bool Rows::better(const Entry& a, const Entry& b) const {
  const auto rank = [this](const Entry& e) { return std::tuple(merit(e), e.part, e.offset); };
  return rank(a) > rank(b);
}

void Rows::put(const Entry& entry) {
  const auto [at, added] = index_.try_emplace(entry.key, entry);
  if (!added && better(entry, at->second)) at->second = entry;
}

std::optional<Entry> Rows::find(std::uint64_t key) const {
  const auto at = index_.find(key);
  return at == index_.end() ? std::nullopt : std::optional(at->second);
}

void Rows::forEach(const std::function<void(const Entry&)>& take) const {
  std::vector<const Entry*> entries;
  for (const auto& [key, entry] : index_) entries.push_back(&entry);
  std::sort(entries.begin(), entries.end(), [](const Entry* a, const Entry* b) {
    return std::pair(a->part, a->offset) < std::pair(b->part, b->offset);
  });
  for (const Entry* entry : entries) take(*entry);
}

std::optional<Entry> Rows::entryOf(const std::vector<std::string_view>& cells) {
  Entry entry;
  if (!parseKey(cells.front(), entry.key)) return {};
  const auto cell = [&cells](std::size_t at) { return at < cells.size() ? cells[at] : std::string_view(); };
  entry.date = secondsOf(cell(at_->date));
  entry.request = numberOf<std::uint32_t>(cell(at_->remade));
  entry.repetitions = numberOf<std::uint16_t>(cell(at_->repetitions));
  entry.code = idOf(cell(at_->code));
  entry.environment = idOf(cell(at_->environment));
  entry.cpu_environment = idOf(cell(at_->cpu_environment));
  entry.outcome = idOf(cell(at_->outcome));
  return entry;
}

void Rows::readOne(const std::filesystem::path& file, std::uint32_t part, Damage damage, std::ostream& messages) {
  const auto aside = asideOf(file);
  const std::string known = std::filesystem::exists(aside) ? contentsOf(aside) : "";
  const PartReading reading = readPart(file, columns_, [&](const auto& cells, std::uint64_t offset) -> std::string {
    auto entry = entryOf(cells);
    if (!entry) return fmt::format("'{}' is no key of 16 hexadecimal digits", cells.front());
    entry->part = part;
    entry->offset = offset;
    put(*entry);
    return {};
  });
  using Names = PartReading::Names;
  if (reading.names == Names::kOthers) {
    fmt::print(messages, "{}: its columns are not those of this version; it is kept, its rows are not used\n",
               file.string());
  } else if (reading.names == Names::kDamaged) {
    fmt::print(
        messages,
        "{}: the line of its column names has no checksum, or a wrong one; it is kept, its rows are not used and "
        "are made again\n",
        file.string());
  }
  damaged_ += reading.damaged.size();
  if (reading.damaged.empty()) return;
  const auto text = asideText(reading.damaged);
  const auto what = fmt::format("{}: {} rows cannot be read (lines {})", file.string(), reading.damaged.size(),
                                placesOf(reading.damaged));
  if (damage == Damage::kReport) {
    fmt::print(messages, "{}\n", what);
  } else if (known != text) {
    writeAside(aside, text);
    fmt::print(messages, "{}: they are set aside in {}; all other rows count\n", what, aside.filename().string());
  }
}

void Rows::read(Damage damage, std::ostream& messages) {
  parts_ = partsInOrder(folder_, name_);
  for (const auto& part : parts_) requireRegularFile(part);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    readOne(parts_[i], static_cast<std::uint32_t>(i), damage, messages);
  }
}

void Rows::append(const TableRow& row) {
  std::vector<std::string_view> cells(row.begin(), row.end());
  auto entry = entryOf(cells);
  if (!entry) throw Failure(fmt::format("'{}' is no key of 16 hexadecimal digits", row.front()));
  if (!writer_) {
    const std::uint64_t last = parts_.empty() ? 0 : numberOfPart(parts_.back());
    writer_.emplace(folder_, partName(name_, last + 1), columns_);
  }
  entry->offset = writer_->append(row);
  if (parts_.empty() || parts_.back() != writer_->file()) parts_.push_back(writer_->file());
  entry->part = static_cast<std::uint32_t>(parts_.size() - 1);
  put(*entry);
}

int Rows::descriptor(std::uint32_t part) const {
  constexpr std::size_t kMaxOpen = 256;
  descriptors_.resize(parts_.size(), -1);
  int& file = descriptors_[part];
  if (file >= 0) return file;
  if (open_ == kMaxOpen) {
    for (int& other : descriptors_) {
      if (other >= 0) close(other);
      other = -1;
    }
    open_ = 0;
  }
  file = open(parts_[part].c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw Failure(fmt::format("cannot read {}: {}", parts_[part].string(), std::strerror(errno)));
  ++open_;
  return file;
}

std::string_view Rows::readBlock(const Entry& entry, std::size_t size) const {
  block_ = {entry.part, entry.offset, std::string(size, '\0')};
  std::size_t got = 0;
  for (ssize_t count = 1; count > 0 && got < size; got += static_cast<std::size_t>(std::max<ssize_t>(count, 0))) {
    count =
        pread(descriptor(entry.part), block_.bytes.data() + got, size - got, static_cast<off_t>(entry.offset + got));
  }
  block_.bytes.resize(got);
  return block_.bytes;
}

// Without its checksum; until the next call.
std::string_view Rows::line(const Entry& entry) const {
  constexpr std::size_t kUsual = 2048, kAhead = 1 << 16;
  std::string_view text = block_.from(entry);
  std::size_t end = text.find('\n');
  // Rows that follow each other are read together.
  for (std::size_t size = block_.isBefore(entry) ? kAhead : kUsual; end == text.npos; size *= 2) {
    text = readBlock(entry, size);
    end = text.find('\n');
    if (end == text.npos && text.size() < size) {
      throw Failure(fmt::format("{}: shorter than before", parts_[entry.part].string()));
    }
  }
  text = text.substr(0, end);
  if (text.ends_with('\r')) text.remove_suffix(1);
  if (!checkRow(text))
    throw Failure(fmt::format("{}: a row has changed since it was read", parts_[entry.part].string()));
  return text;
}

TableRow Rows::row(const Entry& entry) const {
  std::vector<std::string_view> cells;
  splitLine(line(entry), cells);
  return plainRow(cells);
}

std::string Rows::csv(const Entry& entry) const { return std::string(line(entry)); }

}  // namespace irk::store
