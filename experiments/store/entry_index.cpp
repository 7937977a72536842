#include "experiments/store/entry_index.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace irk::store {
namespace {

constexpr std::size_t kPage = 100;     // entries; 4000 bytes
constexpr std::size_t kBuffer = 2000;  // entries that are written at once
constexpr std::size_t kMaxRuns = 16;   // more of them are merged into one

bool isBefore(const Entry& entry, std::uint64_t key) { return entry.key < key; }

void keepIn(std::unordered_map<std::uint64_t, Entry>& entries, const Entry& entry, const EntryIndex::Better& better) {
  const auto [at, added] = entries.try_emplace(entry.key, entry);
  if (!added && better(entry, at->second)) at->second = entry;
}

/// Writes sorted entries to a file and notes the first key of each page.
class RunWriter {
 public:
  RunWriter(SpillFile& file, std::uint64_t begin) : file_(file), end_(begin) {}

  void take(const Entry& entry) {
    if (count++ % kPage == 0) first_keys.push_back(entry.key);
    buffer_.push_back(entry);
    if (buffer_.size() == kBuffer) flush();
  }
  void flush() {
    file_.write(buffer_.data(), buffer_.size() * sizeof(Entry), end_ * sizeof(Entry));
    end_ += buffer_.size();
    buffer_.clear();
  }

  std::size_t count = 0;
  std::vector<std::uint64_t> first_keys;

 private:
  SpillFile& file_;
  std::uint64_t end_;
  std::vector<Entry> buffer_;
};

}  // namespace

SortedEntries::SortedEntries(std::vector<Entry> entries) : entries_(std::move(entries)) {
  while (entries_.size() >> bits_ > kPerGroup) ++bits_;
  firsts_.resize((std::size_t(1) << bits_) + 1, static_cast<std::uint32_t>(entries_.size()));
  for (std::size_t i = entries_.size(); i-- > 0;) firsts_[group(entries_[i].key)] = static_cast<std::uint32_t>(i);
  for (std::size_t g = firsts_.size() - 1; g-- > 0;) firsts_[g] = std::min(firsts_[g], firsts_[g + 1]);
}

std::optional<Entry> SortedEntries::find(std::uint64_t key) const {
  const auto* end = entries_.data() + firsts_[group(key) + 1];
  const auto* at = std::lower_bound(entries_.data() + firsts_[group(key)], end, key, isBefore);
  return at != end && at->key == key ? std::optional(*at) : std::nullopt;
}

/// Goes through sorted entries in memory, or page by page through those of a run.
class EntryIndex::Cursor {
 public:
  explicit Cursor(std::vector<Entry> entries) : page_(std::move(entries)) {}
  Cursor(const SpillFile& file, const Run& run) : file_(&file), next_(run.begin), left_(run.count) { readPage(); }

  bool atEnd() const { return at_ == page_.size(); }
  const Entry& entry() const { return page_[at_]; }
  void advance() {
    if (++at_ == page_.size()) readPage();
  }

 private:
  void readPage() {
    const std::size_t count = std::min(left_, kPage);
    if (count == 0) return;
    page_.resize(count);
    file_->read(page_.data(), count * sizeof(Entry), next_ * sizeof(Entry));
    next_ += count;
    left_ -= count;
    at_ = 0;
  }

  const SpillFile* file_ = nullptr;
  std::uint64_t next_ = 0;
  std::size_t left_ = 0, at_ = 0;
  std::vector<Entry> page_;
};

std::vector<Entry> EntryIndex::sortedNewest() const {
  std::vector<Entry> entries;
  entries.reserve(newest_.size());
  for (const auto& [key, entry] : newest_) entries.push_back(entry);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  return entries;
}

void EntryIndex::forEach(const std::function<void(const Entry&)>& take) const {
  std::vector<Cursor> cursors;
  cursors.emplace_back(sortedNewest());
  cursors.emplace_back(held_.all());
  for (const Run& run : runs_) cursors.emplace_back(*file_, run);
  using Head = std::pair<std::uint64_t, std::size_t>;  // a key and its cursor
  std::priority_queue<Head, std::vector<Head>, std::greater<>> heads;
  const auto push = [&](std::size_t i) {
    if (!cursors[i].atEnd()) heads.emplace(cursors[i].entry().key, i);
  };
  for (std::size_t i = 0; i < cursors.size(); ++i) push(i);
  while (!heads.empty()) {
    std::optional<Entry> best;
    for (const std::uint64_t key = heads.top().first; !heads.empty() && heads.top().first == key;) {
      const std::size_t i = heads.top().second;
      heads.pop();
      if (!best || better_(cursors[i].entry(), *best)) best = cursors[i].entry();
      cursors[i].advance();
      push(i);
    }
    take(*best);
  }
}

void EntryIndex::spillNewest() {
  if (!file_) file_ = std::make_unique<SpillFile>();
  RunWriter writer(*file_, end_);
  for (const Entry& entry : sortedNewest()) writer.take(entry);
  writer.flush();
  runs_.push_back({end_, writer.count, std::move(writer.first_keys)});
  end_ += writer.count;
  newest_.clear();
}

void EntryIndex::add(const Entry& entry) {
  keepIn(newest_, entry, better_);
  if (newest_.size() == kNewest) spillNewest();
}

void EntryIndex::sort() {
  std::size_t most = held_.all().size() + newest_.size();
  for (const Run& run : runs_) most += run.count;
  if (most <= most_held_) {
    std::vector<Entry> all;
    all.reserve(most);
    forEach([&all](const Entry& entry) { all.push_back(entry); });
    size_ = all.size();
    held_ = SortedEntries(std::move(all));
    runs_.clear();
    file_.reset();
    end_ = 0;
  } else {
    auto file = std::make_unique<SpillFile>();
    RunWriter writer(*file, 0);
    forEach([&writer](const Entry& entry) { writer.take(entry); });
    writer.flush();
    file_ = std::move(file);
    size_ = end_ = writer.count;
    runs_.assign(1, {0, writer.count, std::move(writer.first_keys)});
    held_ = {};
  }
  newest_ = {};
}

std::optional<Entry> EntryIndex::findIn(const Run& run, std::uint64_t key) const {
  const auto behind = std::upper_bound(run.first_keys.begin(), run.first_keys.end(), key);
  if (behind == run.first_keys.begin()) return {};
  const auto first = static_cast<std::size_t>(behind - run.first_keys.begin() - 1) * kPage;
  Entry page[kPage];
  const std::size_t count = std::min(kPage, run.count - first);
  file_->read(page, count * sizeof(Entry), (run.begin + first) * sizeof(Entry));
  const auto* at = std::lower_bound(page, page + count, key, isBefore);
  return at != page + count && at->key == key ? std::optional(*at) : std::nullopt;
}

std::optional<Entry> EntryIndex::find(std::uint64_t key) const {
  const auto newest = newest_.find(key);
  if (newest != newest_.end()) return newest->second;
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
    if (const auto found = findIn(*run, key)) return found;
  }
  return held_.find(key);
}

void EntryIndex::put(const Entry& entry) {
  const auto there = find(entry.key);
  if (there && !better_(entry, *there)) return;
  if (!there) ++size_;
  newest_[entry.key] = entry;
  if (newest_.size() < kNewest) return;
  spillNewest();
  if (runs_.size() > kMaxRuns) sort();
}

}  // namespace irk::store
