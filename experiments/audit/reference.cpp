#include "experiments/audit/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/audit/conditioning.h"
#include "experiments/audit/judge.h"
#include "experiments/base/clock.h"
#include "experiments/base/decimal.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/error_bar.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/final_states.h"
#include "experiments/study/drawn/dice.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr auto kFirst = IndependentFamily::kRadauIIA, kOther = IndependentFamily::kLobattoIIIC;
constexpr const char* kFirstFamily = "radau";
constexpr double kTimeLimit = 5;       // CPU seconds of a strict run
constexpr double kSameTime = 1e-12;    // relative difference of a reference's time and t_end
constexpr double kEnough = 1e-10;      // an agreement that suffices to judge every tolerance
constexpr double kSameHistory = 1e-4;  // difference from a run that ignores the switches
constexpr int kPerturbed = 2;          // number of perturbed starts

// Options of the strict runs. The next entry is tried if the runs fail or disagree.
struct Strictness {
  double tolerance;
  double steps;  // at least this many steps over the whole interval
};
constexpr Strictness kStrictnesses[] = {{1e-12, 100}, {1e-12, 2000}, {1e-11, 500}, {1e-9, 1000}};
constexpr Strictness kIgnoring{1e-8, 1000};

// Where double precision does not suffice, as for a motion that multiplies errors by 1e6 and more, two runs in 50
// digits decide: for systems without switches of few unknowns, since each number costs some hundred times as much. The
// first tolerance suffices where errors grow by up to 1e8.
constexpr Index kFewUnknowns = 8;
constexpr double kPreciseTolerances[] = {1e-14, 1e-20};
constexpr double kPreciseTimeLimit = 20;

class Search {
 public:
  Search(const Question& question, const std::atomic<bool>* stop)
      : question_(question),
        settings_(settingsOf(question)),
        scene_(makeScene<double>(question.scene, settings_)),
        n_(scene_.sizes()),
        watch_{stop, {}, {}} {}

  Answer answer() {
    if (!question_.smooth && exact()) return answer_;
    if (!question_.smooth) fromFile();
    const bool compute = answer_.source.empty();
    for (const auto& strictness : kStrictnesses) {
      if (answer_.accuracy <= kEnough && !std::isnan(answer_.kappa)) break;
      if (stopped()) return interrupted();
      attempt(strictness, compute);
    }
    for (const double tolerance : kPreciseTolerances) {
      if (stopped()) return interrupted();
      if (compute && !(answer_.accuracy <= kEnough) && canBePrecise()) agreePrecisely(tolerance);
    }
    if (stopped()) return interrupted();
    if (std::isnan(answer_.accuracy)) answer_.source.clear();
    return answer_;
  }

 private:
  static Settings settingsOf(const Question& question) {
    RunSpec spec;
    findField("settings").set(spec, question.settings);
    return spec.settings;
  }

  bool stopped() const { return watch_.stop && watch_.stop->load(std::memory_order_relaxed); }
  Answer interrupted() const {
    Answer none;
    none.source = kInterruptedSource;
    return none;
  }

  Index judged() const { return 2 * n_.nu + n_.nx; }
  double difference(const Vec<double>& y, const Vec<double>& reference) const {
    return scaledDifference(y, reference, scene_.scale, 0, judged());
  }
  bool complete(const Vec<double>& y) const { return y.size() >= judged() && y.head(judged()).allFinite(); }

  // In 50 digits where the scene has them: its rounding must not be taken for an error of a run.
  Vec<double> closedForm() const {
    const SceneEntry& entry = findScene(question_.scene);
    if (!entry.make_big_float) return components(scene_.exact(question_.t_end));
    const auto scene = makeScene<BigFloat>(question_.scene, settings_);
    return components(scene.exact(decimalNumber<BigFloat>(question_.t_end))).template cast<double>();
  }

  // Uses the closed form, if there is one for all of u, v, x.
  bool exact() {
    if (!scene_.exact) return false;
    const Vec<double> exact = closedForm();
    if (exact.size() < judged() || exact.head(judged()).hasNaN()) return false;
    keep("exact", exact, 0);
    if (!complete(exact)) {
      answer_.remark = "no solution at this time";
    } else {
      answer_.kappa = growthByClosedForm(question_.scene, settings_, question_.t_end);
    }
    return true;
  }

  // Uses the state in the reference files.
  void fromFile() {
    Vec<double> state = Vec<double>::Constant(n_.components(), kNoValue);
    double accuracy = 0;
    for (const auto& reference : references(question_.scene, settings_)) {
      const auto at = std::find(scene_.names.begin(), scene_.names.end(), reference.component);
      const double late = std::abs(reference.t - question_.t_end);
      if (at == scene_.names.end() || late > kSameTime * std::max(1.0, question_.t_end)) continue;
      const Index i = at - scene_.names.begin();
      state[i] = decimalNumber<double>(reference.value);
      const double scale = i < scene_.scale.size() ? scene_.scale[i] : 1;
      if (i >= judged()) continue;
      accuracy = std::max(accuracy, reference.accuracy / std::max(std::abs(state[i]), scale));
    }
    if (complete(state)) keep("file", state, accuracy);
  }

  void keep(const char* source, const Vec<double>& state, double accuracy) {
    answer_.source = source;
    answer_.state = state;
    answer_.accuracy = accuracy;
  }

  RunSpec spec(IndependentFamily family, const Strictness& strictness) const {
    RunSpec asked;
    asked.scene = question_.scene;
    asked.settings = settings_;
    if (question_.smooth) asked.discontinuity = Discontinuity::kSmooth;
    asked.t_end = question_.t_end;
    asked.time_limit = kTimeLimit;
    const double length = question_.t_end - scene_.start.t;
    return strictRun(asked, family, strictness.tolerance, length / strictness.steps);
  }
  RunSpec ignoring() const {
    RunSpec spec = this->spec(kFirst, kIgnoring);
    spec.discontinuity = Discontinuity::kIgnore;
    spec.method = "radau_iia_3";
    spec.options.order = OrderControl::kFixed;
    spec.options.step.estimate = ErrorEstimate::kRichardson;
    return spec;
  }

  // Empty after a failure; `remark_` then has the reason.
  Vec<double> integrate(const RunSpec& spec, const State<double>& start) {
    const auto end = integrateFrom(spec, start, watch_);
    started_ = end.state.t > start.t;
    // A perturbed start need not satisfy the constraints.
    if (end.outcome == Outcome::kSuccess || end.outcome == Outcome::kDrift) {
      return components(end.state);
    }
    remark_ = fmt::format("{} at tol {:g}: {}", spec.method, spec.options.tolerances.rtol, name(end.outcome));
    return {};
  }

  void attempt(const Strictness& strictness, bool compute) {
    const RunSpec strict = spec(kFirst, strictness);
    const Vec<double> first = integrate(strict, scene_.start);
    if (!complete(first)) {
      if (answer_.remark.empty()) answer_.remark = remark_;
      return;
    }
    if (!compute) {
      const double difference_ = difference(first, answer_.state);
      answer_.remark =
          difference_ > answer_.accuracy + kEnough ? fmt::format("a strict run differs by {:.1e}", difference_) : "";
    } else {
      agree(first, strictness);
    }
    answer_.kappa = kappa(strict, first);
  }

  void agree(const Vec<double>& first, const Strictness& strictness) {
    const Vec<double> other = integrate(spec(kOther, strictness), scene_.start);
    if (!complete(other)) {
      if (answer_.remark.empty()) answer_.remark = remark_;
      return;
    }
    const double disagreement = difference(first, other);
    if (answer_.accuracy <= disagreement) return;
    const double history = differenceOfHistory(first);
    if (history > kSameHistory) {
      answer_.remark = fmt::format("a run that ignores the switches differs by {:.1e}", history);
      return;
    }
    keep("computed", first, disagreement);
    answer_.other = other;
    answer_.remark = disagreement > kEnough ? fmt::format("two runs differ by {:.1e}", disagreement) : "";
  }

  bool canBePrecise() const {
    return n_.switches == 0 && judged() <= kFewUnknowns && findScene(question_.scene).make_big_float != nullptr;
  }
  // Keeps the state on which two runs in 50 digits agree, if it is more accurate than what double precision gave.
  void agreePrecisely(double tolerance) {
    const auto made = [&](IndependentFamily family) {
      RunSpec precise = spec(family, {tolerance, 1});
      precise.scalar = {50};
      precise.time_limit = kPreciseTimeLimit;
      const RunRecord record = execute(precise, watch_);
      return record.succeeded() ? componentsOf(record) : Vec<double>();
    };
    const Vec<double> first = made(kFirst);
    const Vec<double> other = complete(first) ? made(kOther) : Vec<double>();
    if (!complete(other)) return;
    const double disagreement = difference(first, other);
    if (answer_.accuracy <= disagreement) return;
    keep("computed", first, disagreement);
    answer_.other = {};
    answer_.remark = "in 50 digits";
  }

  // 0 if the scene has no switches, or if the run fails: a failure contradicts nothing.
  double differenceOfHistory(const Vec<double>& first) {
    if (n_.switches == 0 || question_.smooth) return 0;
    const Vec<double> y = integrate(ignoring(), scene_.start);
    return complete(y) ? difference(y, first) : 0;
  }

  double kappa(const RunSpec& strict, const Vec<double>& unperturbed) {
    double largest = 0;
    for (int draw = 0; draw < kPerturbed; ++draw) {
      Vec<double> y = integrate(strict, perturbed(draw));
      if (y.size() == 0 && !started_) y = perturbedOnTheWay(strict);
      if (!complete(y)) {
        answer_.remark = "perturbed start: " + remark_;
        return kInfinity;
      }
      largest = std::max(largest, difference(y, unperturbed) / kPerturbation);
    }
    return largest;
  }

  Vec<double> perturbedOnTheWay(RunSpec strict) {
    strict.options.tolerances.rtol = strict.options.tolerances.atol = kPerturbation;
    return integrate(strict, scene_.start);
  }

  State<double> perturbed(int draw) const {
    Dice dice(fmt::format("perturbed start {}", draw));
    State<double> start = scene_.start;
    Index i = 0;
    for (auto* group : {&start.u, &start.v, &start.x}) {
      for (double& y : *group) {
        const double scale = i < scene_.scale.size() ? scene_.scale[i] : 1;
        y += dice.sign() * kPerturbation * std::max(std::abs(y), scale);
        ++i;
      }
    }
    return start;
  }

  Question question_;
  Settings settings_;
  Scene<double> scene_;
  Sizes n_;
  Watch watch_;
  Answer answer_;
  bool started_ = false;  // the last run took a step
  std::string remark_;    // of the last run that failed
};

}  // namespace

Question questionOf(const RunSpec& spec) {
  return {spec.scene, settingsText(spec.settings), spec.t_end, spec.discontinuity == Discontinuity::kSmooth};
}

const Vec<double>& Answer::stateFor(const std::string& family) const {
  return family.starts_with(kFirstFamily) && other.size() > 0 ? other : state;
}

Answer answerOf(const Question& question, const std::atomic<bool>* stop) {
  const double start = threadSeconds();
  Answer answer = [&] {
    try {
      return Search(question, stop).answer();
    } catch (const Misuse& misuse) {
      Answer none;
      none.remark = misuse.what();
      return none;
    }
  }();
  answer.cpu_s = threadSeconds() - start;
  return answer;
}

}  // namespace irk::audit
