#include "experiments/claims/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "experiments/base/median.h"

namespace irk::claims {
namespace {

constexpr std::size_t kResamples = 2000;
constexpr std::size_t kCut = kResamples / 20;  // 5 % at each end: the interval holds 90 %
constexpr std::uint64_t kSeed = 18;

using Values = std::vector<double>;
using ByScene = std::map<std::string, Values>;  // sorted: the bootstrap does not depend on the order of rows

double statisticOf(Statistic statistic, const Values& values) {
  if (statistic != Statistic::kShare) return median(values);
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

// Draws as many scenes as there are, with replacement, and takes all values of each. Taking the remainder favours no
// scene noticeably: there are 2^64 random numbers and few scenes.
std::pair<double, double> intervalOf(Statistic statistic, const ByScene& scenes) {
  std::vector<const Values*> of_scene;
  for (const auto& [scene, values] : scenes) of_scene.push_back(&values);
  std::mt19937_64 random(kSeed);
  Values statistics;
  for (std::size_t i = 0; i < kResamples; ++i) {
    Values drawn;
    for (std::size_t k = 0; k < of_scene.size(); ++k) {
      const Values& values = *of_scene[random() % of_scene.size()];
      drawn.insert(drawn.end(), values.begin(), values.end());
    }
    statistics.push_back(statisticOf(statistic, drawn));
  }
  std::sort(statistics.begin(), statistics.end());
  return {statistics[kCut], statistics[kResamples - 1 - kCut]};
}

std::string lackingSample(std::size_t cases, std::size_t scenes, const Sample& least) {
  if (cases == 0) return "no case has a value";
  if (cases >= least.cases && scenes >= least.scenes) return {};
  return fmt::format("{}, needed are {}", countsText(cases, scenes), countsText(least.cases, least.scenes));
}

Verdict verdictOn(const Range& range, double low, double high) {
  if (range.contains(low) && range.contains(high)) return Verdict::kConfirmed;
  return range.isBelow(high) || range.isAbove(low) ? Verdict::kContradicted : Verdict::kUndecided;
}

void judgeExistence(Judgement& judgement, const std::string& lacking) {
  if (judgement.cases > 0) {
    judgement.value = static_cast<double>(judgement.clean) / static_cast<double>(judgement.cases);
  }
  if (judgement.clean > 0) {
    judgement.verdict = Verdict::kConfirmed;
  } else if (lacking.empty()) {
    judgement.verdict = Verdict::kContradicted;
  } else {
    judgement.reason = "no clean case among " + lacking;
  }
}

}  // namespace

std::string countsText(std::size_t cases, std::size_t scenes) {
  return fmt::format("{} case{} of {} scene{}", cases, cases == 1 ? "" : "s", scenes, scenes == 1 ? "" : "s");
}

std::string_view verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::kConfirmed:
      return "confirmed";
    case Verdict::kContradicted:
      return "contradicted";
    case Verdict::kUndecided:
      return "undecided";
    case Verdict::kNotMeasurable:
      return "not measurable";
    case Verdict::kNoVerdict:
      return "no verdict (quick)";
    case Verdict::kReported:
      return "reported";
    case Verdict::kDoesNotApply:
      return "does not apply";
  }
  return "?";
}

Judgement judge(const Part& part, const Measurement& measured, const Sample& least) {
  Judgement judgement;
  judgement.remark = measured.remark;
  judgement.reason = measured.lacking;
  if (!measured.lacking.empty()) return judgement;
  const bool counts_clean = part.statistic == Statistic::kShare || part.statistic == Statistic::kExistence;
  ByScene scenes;
  for (const auto& [scene, value] : measured.cases) {
    if (std::isnan(value)) continue;
    const bool clean = part.clean.contains(value);
    ++judgement.cases;
    judgement.clean += counts_clean && clean ? 1 : 0;
    scenes[scene].push_back(part.statistic != Statistic::kShare ? value : clean ? 1 : 0);
  }
  Values all;
  for (const auto& [scene, values] : scenes) {
    judgement.scenes.push_back(scene);
    all.insert(all.end(), values.begin(), values.end());
  }
  const std::string lacking = lackingSample(judgement.cases, scenes.size(), least);
  if (part.statistic == Statistic::kExistence) {
    judgeExistence(judgement, lacking);
    return judgement;
  }
  if (judgement.cases > 0) {
    judgement.value = statisticOf(part.statistic, all);
    std::tie(judgement.low, judgement.high) = intervalOf(part.statistic, scenes);
  }
  if (part.statistic == Statistic::kReport) {
    judgement.verdict = judgement.cases > 0 ? Verdict::kReported : Verdict::kNotMeasurable;
    judgement.reason = judgement.cases > 0 ? "" : lacking;
  } else if (lacking.empty()) {
    judgement.verdict = verdictOn(part.confirmed, judgement.low, judgement.high);
  } else {
    judgement.reason = lacking;
  }
  return judgement;
}

std::string numberText(const Part& part, const Judgement& judgement) {
  if (judgement.cases == 0) return "–";
  if (part.statistic == Statistic::kExistence) return fmt::format("{} of {} cases", judgement.clean, judgement.cases);
  const bool share = part.statistic == Statistic::kShare;
  const double scale = share ? 100 : 1;
  const std::string_view unit = share ? "%" : std::string_view(part.unit);
  const auto text = [&](double x) { return std::isinf(x) ? "infinite" : fmt::format("{:.3g}", scale * x); };
  if (std::isinf(judgement.low)) return "infinite";
  return fmt::format("{} [{}, {}]{}{}", text(judgement.value), text(judgement.low), text(judgement.high),
                     unit.empty() ? "" : " ", unit);
}

std::string explainedNumber(const Part& part, const Judgement& judgement) {
  const bool explained = std::isinf(judgement.value) && !judgement.remark.empty();
  return numberText(part, judgement) + (explained ? " (" + judgement.remark + ")" : "");
}

Verdict combined(const std::vector<Verdict>& parts) {
  for (const Verdict verdict : {Verdict::kContradicted, Verdict::kNotMeasurable, Verdict::kNoVerdict,
                                Verdict::kUndecided, Verdict::kConfirmed, Verdict::kReported}) {
    if (std::find(parts.begin(), parts.end(), verdict) != parts.end()) return verdict;
  }
  return Verdict::kDoesNotApply;
}

}  // namespace irk::claims
