#include "experiments/solution/file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/setup.h"
#include "experiments/solution/panels.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"

namespace irk {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kStepColumns[] = {"t", "h", "error", "newton_iterations", "switches"};

class CsvFile final : public SolutionFile {
 public:
  CsvFile(const std::filesystem::path& path, const RunSpec& spec, RowBars bars)
      : writer_(path, solutionTable(spec, bars)) {}
  void append(const SolutionRow& row) override { writer_.append(solutionCells(row)); }

 private:
  RowWriter writer_;
};

class JsonLinesFile final : public SolutionFile {
 public:
  JsonLinesFile(const std::filesystem::path& path, const RunSpec& spec)
      : file_(path, std::ios::binary), scene_(sceneOf<double>(spec)) {
    Json head;
    head["schema"] = "irk-solution-1";
    head["version"] = buildInfo().version;
    head["scene"] = spec.scene;
    head["settings"] = spec.settings;
    head["method"] = spec.method;
    head["time_unit"] = scene_.time_unit;
    for (const auto& [name, unit] : namesAndUnits(scene_)) head["units"][name] = unit;
    write(head);
  }
  void append(const SolutionRow& row) override {
    Json line{{"t", row.t}, {"h", row.h}, {"error", row.error}, {"newton_iterations", row.newton_iterations}};
    line["switches"] = row.switches;
    std::size_t i = 0;
    for (const auto& [name, unit] : namesAndUnits(scene_)) {
      line["values"][name] = row.values[i];
      if (i < row.bars.size()) line["bars"][name] = row.bars[i];
      ++i;
    }
    write(line);
  }

 private:
  void write(const Json& line) {
    if (!(file_ << line.dump() << '\n').flush()) throw Failure("cannot write a row: is the disk full?");
  }

  std::ofstream file_;
  Scene<double> scene_;
};

}  // namespace

TableRow solutionCells(const SolutionRow& row) {
  TableRow cells{numberText(row.t), numberText(row.h), numberText(row.error), std::to_string(row.newton_iterations),
                 row.switches};
  for (const double value : row.values) cells.push_back(numberText(value));
  for (const double bar : row.bars) cells.push_back(numberText(bar));
  return cells;
}

Table solutionTable(const RunSpec& spec, RowBars bars) {
  const auto scene = sceneOf<double>(spec);
  Table table{
      environmentHead("trajectory of " + spec.scene, 1), {std::begin(kStepColumns), std::end(kStepColumns)}, {}};
  table.head.emplace_back("run", canonicalText(spec));
  for (auto& line : panelHead(findScene(spec.scene), scene)) table.head.push_back(std::move(line));
  TableRow units{scene.time_unit, scene.time_unit, "", "", ""};
  for (const auto& [name, unit] : namesAndUnits(scene)) {
    table.columns.push_back(name);
    units.push_back(unit);
  }
  if (bars == RowBars::kWritten) {
    for (const auto& [name, unit] : namesAndUnits(scene)) {
      table.columns.push_back("bar " + name);
      units.push_back(unit);
    }
  }
  table.head.emplace_back("units", csvLine(units));
  return table;
}

void requireSolutionPath(const std::filesystem::path& path) {
  const auto folder = path.parent_path();
  std::error_code none;
  if (path.extension() != ".csv" && path.extension() != ".jsonl") {
    throw Misuse(fmt::format("--out '{}': a file name with the ending .csv or .jsonl is expected", path.string()));
  }
  if (!folder.empty() && !std::filesystem::is_directory(folder, none)) {
    throw Misuse(fmt::format("--out '{}': there is no folder '{}'", path.string(), folder.string()));
  }
  requireRegularFile(path);
}

std::unique_ptr<SolutionFile> solutionFile(const std::filesystem::path& path, const RunSpec& spec, RowBars bars) {
  requireSolutionPath(path);
  if (path.extension() == ".csv") return std::make_unique<CsvFile>(path, spec, bars);
  return std::make_unique<JsonLinesFile>(path, spec);
}

}  // namespace irk
