#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <filesystem>

#include "core/base/text.h"
#include "experiments/audit/judge.h"
#include "experiments/base/clock.h"
#include "experiments/base/failure.h"
#include "experiments/base/folders.h"
#include "experiments/base/interrupt.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/out_file.h"
#include "experiments/reference/library.h"
#include "experiments/report/figure_path.h"
#include "experiments/report/report.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "experiments/runs/setup.h"
#include "experiments/runs/unused_options.h"
#include "experiments/solution/trajectory.h"
#include "experiments/tables/environment.h"

namespace irk {

bool isGiven(const SolveOptions& options, std::string_view field) {
  return std::any_of(options.fields.begin(), options.fields.end(),
                     [field](const auto& entry) { return entry.first == field; });
}

namespace {

void applyStep(const SolveOptions& options, RunSpec& spec) {
  if (options.step.empty()) return;
  auto& step = spec.options.step;
  findField("h").set(spec, options.step);
  if (findPeer(spec.method)) return;  // a peer chooses its own first step
  if (!isGiven(options, "control")) step.control = StepControl::kFixed;
  if (step.control != StepControl::kFixed) return;
  if (!isGiven(options, "estimate")) step.estimate = ErrorEstimate::kNone;
  if (!options.tol.empty()) {
    throw Misuse(
        "illegal combination: step and tol: fixed steps have no tolerance; "
        "give --control paper to start with this step");
  }
}

void applyTolerance(const SolveOptions& options, RunSpec& spec) {
  if (options.tol.empty()) return;
  static_cast<void>(parseNumber("--tol", options.tol, Range::above(0)));
  for (const auto* field : {"rtol", "atol"}) findField(field).set(spec, options.tol);
}

void printComponents(std::ostream& out, const RunRecord& record, const std::vector<std::string>& names) {
  std::size_t i = 0;
  const auto print = [&](const char* group, const Vec<double>& y, const Vec<double>& bars) {
    for (Index k = 0; k < y.size(); ++k, ++i) {
      const auto text = record.digits.empty() ? fmt::format("{:.15g}", y[k]) : record.digits[i];
      const bool known = k < bars.size() && !std::isnan(bars[k]);
      fmt::print(out, "  {}  {:<12} {}{}\n", group, i < names.size() ? names[i] : "", text,
                 known ? fmt::format(" +- {:.1e}", bars[k]) : "");
    }
  };
  const RunErrorBar& bar = record.error_bar;
  print("u", record.u, bar.u);
  print("v", record.v, bar.v);
  print("x", record.x, bar.x);
  print("z", record.z, bar.z);
}

void printErrorBar(std::ostream& out, const RunErrorBar& bar) {
  if (!bar.problem.empty()) {
    fmt::print(out, "error bar unknown: {}\n", bar.problem);
  } else if (!std::isnan(bar.tolerances)) {
    fmt::print(out, "error bar {:.2g} tolerances, largest in {}\n", bar.tolerances, bar.component);
    if (!bar.remark.empty()) fmt::print(out, "  {}\n", bar.remark);
  }
}

// Prints the digits as the IVP test set counts them. One is unknown without tolerances, or if all references are 0.
void printDigits(std::ostream& out, const RunErrors& errors) {
  const auto text = [](double digits) { return std::isnan(digits) ? "unknown" : fmt::format("{:.2f}", digits); };
  fmt::print(out, "digits: mescd {}, scd {}\n", text(errors.mescd()), text(errors.scd()));
}

// The first ones, of a run with many.
void printSwitches(std::ostream& out, const RunRecord& record) {
  constexpr std::size_t kShown = 20;
  const std::size_t shown = record.switches.size() > 2 * kShown ? kShown : record.switches.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [t, name] = record.switches[i];
    fmt::print(out, "switch {:<15} t = {:.15g}\n", name, t);
  }
  if (shown == record.switches.size()) return;
  fmt::print(out, "and {} more switches; --json has them all\n", record.switches.size() - shown);
}

void printRecord(std::ostream& out, const RunRecord& record, const std::vector<std::string>& names) {
  const auto& spec = record.spec;
  fmt::print(out, "{} {}  {}  {}\n", spec.scene, settingsText(spec.settings), spec.method, idOf(spec.formulation));
  const double t_bar = record.error_bar.t;
  const bool remarks = record.succeeded() && !record.detail.empty();
  const std::string cause = remarks || record.detail.empty() ? "" : ": " + record.detail;
  fmt::print(out, "{}{}, t = {:.15g}{}\n", record.outcome, cause, record.t,
             std::isnan(t_bar) ? "" : fmt::format(" +- {:.1e}", t_bar));
  if (remarks) fmt::print(out, "remark: {}\n", record.detail);
  printComponents(out, record, names);
  printErrorBar(out, record.error_bar);
  if (!std::isnan(record.errors.all)) {
    fmt::print(out, "error {:.3e}\n", record.errors.all);
    if (!std::isnan(record.errors.t)) fmt::print(out, "error of the time {:.3e}\n", record.errors.t);
    if (spec.reference_times > 1 && !std::isnan(record.errors_over_time.all)) {
      fmt::print(out, "largest error at {} times {:.3e}\n", spec.reference_times, record.errors_over_time.all);
    }
    printDigits(out, record.errors);
    const std::string large = largeErrorText(record);
    if (!large.empty()) fmt::print(out, "{}, though the run is a success\n", large);
  } else if (!record.errors.remark.empty()) {
    fmt::print(out, "{}\n", record.errors.remark);
  } else if (record.succeeded()) {
    const std::string& stop_at = spec.options.stop_at;
    const auto where = stop_at.empty() ? fmt::format("t = {:.15g}", record.t) : "the switch " + stop_at;
    fmt::print(out, "error unknown: no reference at {}; --reference makes one\n", where);
  }
  record.counters.forEach([&out](const char* name, std::int64_t count) {
    if (count > 0) fmt::print(out, "{:<22} {}\n", name, count);
  });
  for (const auto& [invariant, unit, start, change] : record.invariants) {
    fmt::print(out, "invariant {:<12} changes by at most {:.3e}{}{}\n", invariant, change, unit.empty() ? "" : " ",
               unit);
  }
  printSwitches(out, record);
  fmt::print(out, "{:<22} {:.3g}\n", "cpu_s", record.cpu_s);
}

// With this many points a curve shows no corners.
constexpr int kPlotPoints = 1000;

// Records the solution in a temporary folder and draws it.
RunRecord solveAndPlot(const RunSpec& spec, const Watch& watch, const std::string& plot, std::ostream& err,
                       bool& drawn) {
  const auto home = homeFolder();
  const auto out = figurePath("--plot", plot);
  const ScratchFolder folder;
  const auto file = folder.path() / (spec.scene + ".csv");
  const RunRecord record = executeWithTrajectory(spec, watch, file, {kPlotPoints, true});
  drawn = drawFigure("scene_solution.gp",
                     fmt::format("data='{}'; out='{}'; scene='{}'; file_name='{}'", folder.path().string(),
                                 out.string(), spec.scene, file.stem().string()),
                     home, err);
  return record;
}

/// The progress of a second integration that takes long, on a terminal.
class MeasuringStatus {
 public:
  explicit MeasuringStatus(std::ostream& err) : status_(err) {}
  void show(double part) {
    const double now = wallSeconds();
    if (std::isnan(began_)) began_ = shown_ = now;
    if (now - shown_ < kInterval || part <= 0) return;
    shown_ = now;
    status_.show(fmt::format("measuring the error bar: {:.0f} %, {} left", 100 * part,
                             durationText((now - began_) * (1 - part) / part)));
  }

 private:
  static constexpr double kInterval = 1;  // s
  StatusLine status_;
  double began_ = std::numeric_limits<double>::quiet_NaN(), shown_ = 0;
};

std::vector<std::string> givenFields(const SolveOptions& options) {
  std::vector<std::string> given;
  for (const auto& [field, value] : options.fields) given.push_back(field);
  if (!options.step.empty()) given.emplace_back("step");
  if (!options.tol.empty()) given.emplace_back("tol");
  return given;
}

std::string failureText(const RunRecord& record) {
  return fmt::format("{} with {} failed: {}{}{}", record.spec.scene, record.spec.method, record.outcome,
                     record.detail.empty() ? "" : ", ", record.detail);
}

// Where threads do not pay, says so and takes one.
void takeOneThread(RunSpec& spec, std::ostream& err) {
  const std::string text = oneThreadText(spec);
  if (text.empty()) return;
  fmt::print(err, "{}\n", text);
  spec.options.threads = 1;
}

}  // namespace

RunSpec solveSpec(const SolveOptions& options, RunSpec defaults) {
  RunSpec spec = std::move(defaults);
  findField("scene").set(spec, options.scene);
  for (const auto& setting : options.settings) {
    const std::size_t before = spec.settings.size();
    addSetting(spec.settings, setting);
    if (spec.settings.size() == before) {
      throw Misuse(fmt::format("--set {}: '{}' is set twice", setting, setting.substr(0, setting.find('='))));
    }
  }
  applyTolerance(options, spec);
  const auto set = [&](bool configuration) {
    for (const auto& [field, value] : options.fields) {
      if ((field == "configuration") == configuration) findField(field).set(spec, value);
    }
  };
  set(true);  // first: other fields override it
  set(false);
  applyStep(options, spec);
  if (!isGiven(options, axisName<ErrorBarUse>())) spec.error_bar = ErrorBarUse::kMeasured;
  refuseUnknownMethod(spec.method);
  spec = resolved(spec);
  refuseUnused(spec, givenFields(options));
  return spec;
}

std::string largeErrorText(const RunRecord& record) {
  const auto& options = record.spec.options;
  if (!record.succeeded() || options.step.control == StepControl::kFixed) return {};
  if (options.tolerances.norm == NormKind::kAbsolute) return {};  // its tolerances know no magnitudes, errors here do
  const double tolerance = std::max(options.tolerances.rtol, options.tolerances.atol);
  double error = 0;
  for (const RunErrors* errors : {&record.errors, &record.errors_over_time}) {
    for (const double group : {errors->u, errors->v, errors->x}) error = std::fmax(error, group);
  }
  return error > audit::bar(tolerance) ? fmt::format("the error is {:.2g} tolerances", error / tolerance) : "";
}

SolveReferences::SolveReferences(std::ostream& err)
    : status_(err),
      library_({.jobs = threadCount(0),
                .stop = &interruptFlag(),
                .tell = [&err](const std::string& line) { fmt::print(err, "{}\n", line); },
                .show = [this](const std::string& text) { status_.show(text); }}) {}

std::function<MadeReference(const RunSpec&)> SolveReferences::of(const RunSpec& whole) {
  return [this, whole](const RunSpec& run) {
    library_.prepare(atReferenceTimes(whole));
    return library_.of(run);
  };
}

int solveCommand(const SolveOptions& options, Streams streams) {
  const Sweep sweep = sweepOf(options);
  if (!sweep.names.empty()) return solveSweep(sweep, streams);
  RunSpec spec = solveSpec(options);
  takeOneThread(spec, streams.err);
  OutFile out(options, spec);
  const InterruptScope interrupts;
  SolveReferences references(streams.err);
  Watch watch{&interruptFlag(), {}, {}, references.of(spec)};
  watch.invariants = true;
  MeasuringStatus measuring(streams.err);
  watch.measuring = [&measuring](double part) { measuring.show(part); };
  out.addTo(watch);
  bool drawn = true;
  const RunRecord record =
      options.plot.empty() ? execute(spec, watch) : solveAndPlot(spec, watch, options.plot, streams.err, drawn);
  out.finish(record, watch, streams.err);
  if (options.json) {
    streams.out << solveJson(record) << '\n';
  } else {
    printRecord(streams.out, record, sceneOf<double>(spec).names);
  }
  if (interruptFlag()) return kInterruptedStatus;
  if (!record.succeeded()) printErrorLine(streams.err, failureText(record));
  return record.succeeded() && drawn ? 0 : kFailedStatus;
}

}  // namespace irk
