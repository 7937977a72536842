#include "experiments/study/run_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "experiments/base/child_process.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/own_files.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/unused_options.h"
#include "irk/misuse.h"
#include "irk/scene.h"

namespace irk {
namespace {

// These have places of their own in a command.
constexpr std::string_view kPlaced[] = {"scene", "settings", "configuration", "method", "h", "rtol", "atol", "t_end"};
// Fields that do not distinguish solvers.
constexpr std::string_view kLimits[] = {"max_steps", "time_limit",      "threads",
                                        "reference", "reference_times", "error_bars"};

template <class Names>
bool isIn(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

class Row {
 public:
  Row(const Table& runs, const TableRow& row) : runs_(runs), row_(row) {}
  std::string text(std::string_view column) const { return runs_.hasColumn(column) ? textAt(runs_, row_, column) : ""; }
  double number(std::string_view column) const { return cellNumber(text(column)); }
  // An integrator of another library is called by its method's id alone.
  bool isPeer() const { return text("integrator") == text("method"); }
  bool hasFixedSteps() const { return runs_.hasColumn("control") && hasFixedStepsAt(runs_, row_) && number("h") > 0; }

 private:
  const Table& runs_;
  const TableRow& row_;
};

// The spec of a row, as far as this program has what the row names.
RunSpec specOf(const Row& row) {
  RunSpec spec;
  const auto set = [&](const SpecField& field) {
    const auto cell = row.text(field.name);
    if (cell.empty()) return;
    try {
      field.set(spec, cell);
    } catch (const Misuse&) {
    }
  };
  set(findField("configuration"));
  for (const auto& field : specFields()) {
    if (field.name != "configuration" && field.name != "method") set(field);
  }
  spec.method = row.text("method");
  return spec;
}

// The spec that `--configuration` alone gives to `irk solve`, which measures an error bar unless it is told otherwise.
RunSpec configured(const std::string& configuration) {
  RunSpec spec;
  spec.error_bar = ErrorBarUse::kMeasured;
  try {
    findField("configuration").set(spec, configuration);
  } catch (const Misuse&) {
  }
  return spec;
}

bool isUsed(const SpecField& field, const Row& row, const RunSpec& spec) {
  if (row.isPeer()) return isIn(peerFields(), field.name);
  if (row.hasFixedSteps() && (field.name == "control" || field.name == "estimate")) {
    return row.text(field.name) != (field.name == "control" ? "fixed" : "none");  // --step sets both
  }
  return !field.unused || field.unused(spec).empty();
}

std::vector<std::pair<std::string, std::string>> differences(const Row& row) {
  const RunSpec base = configured(row.text("configuration")), spec = specOf(row);
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& field : specFields()) {
    const auto cell = row.text(field.name);
    if (isIn(kPlaced, field.name) || cell.empty()) continue;
    if (cell != field.get(base) && isUsed(field, row, spec)) found.emplace_back(field.name, cell);
  }
  return found;
}

// Empty for the scene's own end.
std::string endOption(const Row& row) {
  const double t_end = row.number("t_end");
  if (std::isnan(t_end)) return "";
  RunSpec spec = specOf(row);
  spec.t_end = std::numeric_limits<double>::quiet_NaN();
  try {
    if (resolved(spec).t_end == t_end) return "";
  } catch (const Misuse&) {
  }
  return " --t-end " + numberText(t_end);
}

}  // namespace

std::string sweptOptions(const Table& runs, const TableRow& line) {
  const Row row(runs, line);
  const double rtol = row.number("rtol"), atol = row.number("atol"), h = row.number("h");
  std::string text;
  if (h > 0) text += " --step " + numberText(h);
  if (row.hasFixedSteps() && !row.isPeer()) return text;
  if (rtol == atol) return text + " --tol " + numberText(rtol);
  if (!std::isnan(rtol)) text += " --rtol " + numberText(rtol);
  if (!std::isnan(atol)) text += " --atol " + numberText(atol);
  return text;
}

SeriesCommand seriesCommand(const Table& runs, const TableRow& line) {
  const Row row(runs, line);
  SeriesCommand command;
  command.text = "irk solve " + shellWord(row.text("scene"));
  const auto settings = row.text("settings");
  for (std::size_t at = 0; at < settings.size();) {
    const auto end = std::min(settings.find(' ', at), settings.size());
    if (end > at) command.text += " --set " + shellWord(settings.substr(at, end - at));
    at = end + 1;
  }
  const auto configuration = row.text("configuration");
  if (!configuration.empty() && configuration != RunSpec{}.configuration && !row.isPeer()) {
    command.text += " --configuration " + shellWord(configuration);
  }
  const std::string files = row.text("files");
  command.text += " --method " + shellWord(methodIn(files, row.text("method")));
  for (const auto& [name, value] : differences(row)) {
    command.text += " " + optionName(name) + (name == "reference" ? "" : " " + shellWord(value));
    if (!isIn(kLimits, name)) command.options.emplace_back(name, value);
  }
  command.text += endOption(row) + loadOptions(files);
  return command;
}

}  // namespace irk
