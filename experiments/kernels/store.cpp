// Times the store with 1e4, 1e5 and 1e6 rows: appending, reading all parts again (resume), finding a run by its key,
// exporting runs.csv. Counters: bytes per row on disk and in memory. Works in a folder in TMPDIR.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/runs/run_table.h"
#include "experiments/store/store.h"

namespace irk {
namespace {

constexpr std::int64_t kMin = 10'000, kMax = 1'000'000;

/// A folder with n rows, made once for each n; the destructor removes it.
class Folder {
 public:
  explicit Folder(std::int64_t rows)
      : path_(std::filesystem::temp_directory_path() /
              ("irk_store_" + std::to_string(getpid()) + "_" + std::to_string(rows))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

RunRecord record() {
  RunRecord made;
  made.spec.scene = sceneCatalogue().front().id;
  made.spec = resolved(made.spec);
  made.family = "radau_iia";
  made.stages = 3;
  made.outcome = "success";
  made.errors = {1e-9 / 3, 1e-9 / 7, 1e-9 / 11, 0, 1e-9 / 13, 1e-15 / 3};
  made.cpu_s = 0.1 / 3;
  return made;
}

// The keys of the rows, which differ in their tolerances, as those of a series.
std::vector<std::uint64_t> fill(const std::filesystem::path& folder, std::int64_t rows) {
  std::ostringstream quiet;
  store::Store store(folder, "benchmark", store::Use::kWrite, {}, quiet);
  RunRecord made = record();
  std::vector<std::uint64_t> keys;
  for (std::int64_t i = 0; i < rows; ++i) {
    made.spec.options.tolerances.rtol = 1e-3 / static_cast<double>(i + 1);
    const std::string key = specKey(made.spec);
    store.addRun(runRow(key, "benchmark", made));
    keys.push_back(store::keyNumber(key));
  }
  return keys;
}

double heldBytes() { return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd); }

void countRows(benchmark::State& state) {
  state.counters["per_row"] = benchmark::Counter(
      static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void append(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    const Folder folder(state.range(0));
    fill(folder.path(), state.range(0));
    double bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder.path() / "parts")) {
      bytes += static_cast<double>(file.file_size());
    }
    state.counters["disk_bytes_per_row"] = bytes / static_cast<double>(state.range(0));
  }
  countRows(state);
}

void resume(benchmark::State& state) {
  const Folder folder(state.range(0));
  const auto all = fill(folder.path(), state.range(0));
  std::ostringstream quiet;
  for ([[maybe_unused]] auto _ : state) {
    const double before = heldBytes();
    const store::Store store(folder.path(), "benchmark", store::Use::kWrite, {}, quiet);
    std::size_t found = 0;
    for (const auto each : all) {
      if (store.finished(each)) ++found;
    }
    if (found != all.size()) state.SkipWithError("rows are lost");
    state.counters["memory_bytes_per_row"] = (heldBytes() - before) / static_cast<double>(state.range(0));
  }
  countRows(state);
}

void exportRuns(benchmark::State& state) {
  const Folder folder(state.range(0));
  const auto all = fill(folder.path(), state.range(0));
  std::ostringstream quiet;
  store::Store store(folder.path(), "benchmark", store::Use::kWrite, {}, quiet);
  const store::RunKeys runs(all);
  for ([[maybe_unused]] auto _ : state) store.exportTables(runs, quiet);
  countRows(state);
}

// The cost of computing a run's key, which is needed to see whether it is finished.
void key(benchmark::State& state) {
  const RunSpec spec = record().spec;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(specKey(spec));
}

BENCHMARK(key);
BENCHMARK(append)->RangeMultiplier(10)->Range(kMin, kMax)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(resume)->RangeMultiplier(10)->Range(kMin, kMax)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(exportRuns)->RangeMultiplier(10)->Range(kMin, kMax)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace irk

BENCHMARK_MAIN();
