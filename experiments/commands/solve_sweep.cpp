// `irk solve` with lists of values.
#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/split.h"
#include "experiments/commands/commands.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/setup.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

constexpr std::size_t kMostRuns = 10'000;

/// An option with a list of values.
struct SweptOption {
  std::string name;
  std::vector<std::string> values;
  std::function<void(SolveOptions&, const std::string&)> set;
};

std::vector<std::string> items(const std::string& name, const std::string& text) {
  const auto values = split(text, ',');
  for (const auto& value : values) {
    if (value.empty()) throw Misuse(fmt::format("{} = '{}': an empty item in a list", name, text));
    if (std::count(values.begin(), values.end(), value) > 1) {
      throw Misuse(fmt::format("{} = '{}': '{}' is listed twice", name, text, value));
    }
  }
  return values;
}

bool isList(const std::string& text) { return text.find(',') != std::string::npos; }

std::vector<SweptOption> listsOf(const SolveOptions& options) {
  std::vector<SweptOption> lists;
  for (std::size_t i = 0; i < options.settings.size(); ++i) {
    const std::string& setting = options.settings[i];
    const std::size_t equals = setting.find('=');
    if (!isList(setting) || equals == std::string::npos) continue;
    const std::string name = setting.substr(0, equals);
    lists.push_back({name, items(name, setting.substr(equals + 1)),
                     [i, name](SolveOptions& run, const std::string& value) { run.settings[i] = name + '=' + value; }});
  }
  for (std::size_t i = 0; i < options.fields.size(); ++i) {
    const auto& [field, text] = options.fields[i];
    if (!isList(text)) continue;
    std::error_code none;
    if (field == "method" && std::filesystem::exists(text, none)) {
      throw Misuse(fmt::format("--method '{}': a list of methods, or the file of this name? Rename the file", text));
    }
    lists.push_back({field, items(field, text),
                     [i](SolveOptions& run, const std::string& value) { run.fields[i].second = value; }});
  }
  if (isList(options.step)) {
    lists.push_back(
        {"step", items("step", options.step), [](SolveOptions& run, const auto& value) { run.step = value; }});
  }
  if (isList(options.tol)) {
    lists.push_back({"tol", items("tol", options.tol), [](SolveOptions& run, const auto& value) { run.tol = value; }});
  }
  return lists;
}

// Refuses a misspelt method before the first run; a method that a scene does not allow gives a refused run.
void requireMethods(const std::vector<RunSpec>& specs) {
  std::set<std::string> known;
  for (const RunSpec& spec : specs) {
    const std::string& method = spec.method;
    if (findPeer(method) || isFamily(method) || !known.insert(method).second) continue;
    static_cast<void>(makeTableau<double>(method));
  }
}

// Columns as wide as the widest value.
std::vector<std::size_t> widths(const Sweep& sweep) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < sweep.names.size(); ++i) {
    all.push_back(sweep.names[i].size());
    for (const auto& run : sweep.runs) all.back() = std::max(all.back(), run.values[i].size());
  }
  return all;
}

std::string valuesText(const std::vector<std::string>& values, const std::vector<std::size_t>& widths) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) text += fmt::format("{:<{}}  ", values[i], widths[i]);
  return text;
}

void printLine(std::ostream& out, const std::string& values, const RunRecord& record) {
  const Counters& c = record.counters;
  const std::string remark = record.succeeded() ? largeErrorText(record) : record.detail;
  fmt::print(out, "{}{:<14}  {:<10.3e}  {:<10.3e}  {:>8}  {:>8}  {:>8}  {:>9.3g}{}{}\n", values, record.outcome,
             record.errors.all, record.error_bar.error, c.steps_accepted,
             c.steps_rejected_error + c.steps_rejected_newton, c.newton_iterations, record.cpu_s,
             remark.empty() && record.succeeded() ? "" : "  ", remark);
}

}  // namespace

Sweep sweepOf(const SolveOptions& options) {
  const auto lists = listsOf(options);
  Sweep sweep{{}, {{options, {}}}};
  for (const SweptOption& list : lists) {
    sweep.names.push_back(list.name);
    std::vector<Sweep::Run> runs;
    if (sweep.runs.size() * list.values.size() > kMostRuns) {
      throw Misuse(fmt::format("the lists have more than {} combinations; a study can make them: irk run", kMostRuns));
    }
    for (const auto& run : sweep.runs) {
      for (const auto& value : list.values) {
        runs.push_back(run);
        list.set(runs.back().options, value);
        runs.back().values.push_back(value);
      }
    }
    sweep.runs = std::move(runs);
  }
  return sweep;
}

int solveSweep(const Sweep& sweep, Streams streams) {
  const SolveOptions& first = sweep.runs.front().options;
  const auto refuse = [&](std::string_view option, const std::string& file) {
    if (file.empty()) return;
    throw Misuse(fmt::format("{} '{}': of one run; the list of '{}' makes several", option, file, sweep.names.front()));
  };
  refuse("--out", first.out);
  refuse("--plot", first.plot);
  std::vector<RunSpec> specs;
  for (const auto& run : sweep.runs) specs.push_back(solveSpec(run.options));
  requireMethods(specs);
  const auto columns = widths(sweep);
  if (!first.json) {
    fmt::print(streams.out, "{}{:<14}  {:<10}  {:<10}  {:>8}  {:>8}  {:>8}  {:>9}\n", valuesText(sweep.names, columns),
               "outcome", "error", "error_bar", "accepted", "rejected", "newton", "cpu_s");
  }
  const InterruptScope interrupts;
  SolveReferences references(streams.err);
  std::size_t made = 0, failed = 0;
  std::set<std::string> said;
  for (std::size_t i = 0; i < specs.size() && !interruptFlag(); ++i) {
    const RunSpec& spec = specs[i];
    const Watch watch{&interruptFlag(), {}, {}, references.of(spec)};
    const RunRecord record = asRow(spec, [&] { return execute(spec, watch); });
    ++made;
    if (!record.succeeded()) ++failed;
    const std::string one_thread = record.succeeded() ? oneThreadText(spec) : "";
    if (!one_thread.empty() && said.insert(one_thread).second) {
      fmt::print(streams.err, "{}\n", one_thread);
    }
    if (first.json) {
      streams.out << solveJson(record, -1) << '\n';
    } else {
      printLine(streams.out, valuesText(sweep.runs[i].values, columns), record);
    }
    streams.out.flush();
  }
  if (interruptFlag()) return kInterruptedStatus;
  if (failed > 0) printErrorLine(streams.err, fmt::format("{} of {} runs failed", failed, made));
  return failed > 0 ? kFailedStatus : 0;
}

}  // namespace irk
