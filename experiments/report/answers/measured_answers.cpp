#include "experiments/report/answers/measured_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "experiments/base/median.h"
#include "experiments/report/answers/answer.h"
#include "experiments/runs/run_table.h"

namespace irk::report {
namespace {

// The smallest step at which every formulation has a successful run with a known multiplier; 0 if there is none.
double smallestCommonStep(const Table& runs) {
  std::map<double, std::set<std::string>> at;
  std::set<std::string> all;
  for (const auto& row : runs.rows) {
    if (!succeededAt(runs, row) || std::isnan(numberAt(runs, row, "error_z"))) continue;
    at[numberAt(runs, row, "h")].insert(textAt(runs, row, "formulation"));
    all.insert(textAt(runs, row, "formulation"));
  }
  for (const auto& [h, formulations] : at) {
    if (formulations == all) return h;
  }
  return 0;
}

std::string percentText(double part) { return fmt::format("{:.2g} %", 100 * part); }

// `3 %`, or `0.8 to 22 %` of several values.
std::string rangeText(const std::vector<double>& parts) {
  const auto [least, most] = std::minmax_element(parts.begin(), parts.end());
  const std::string last = percentText(*most);
  return percentText(*least) == last ? last : fmt::format("{:.2g} to {}", 100 * *least, last);
}

// Runs that end without one correct digit; failed runs need no error.
bool isUseless(const Table& runs, const TableRow& row) {
  constexpr double kOneDigit = 0.1;
  if (!succeededAt(runs, row)) return true;
  return std::ranges::any_of(std::array{"error_u", "error_v", "error_x"},
                             [&](const char* column) { return numberAt(runs, row, column) > kOneDigit; });
}

}  // namespace

std::string smallStepsSentence(const Table& runs) {
  const double h = smallestCommonStep(runs);
  if (h <= 0) return {};
  struct Found {
    std::vector<double> errors, jacobians;
  };
  std::map<std::string, Found> found;
  for (const auto& row : runs.rows) {
    const double error = numberAt(runs, row, "error_z");
    if (numberAt(runs, row, "h") != h || !succeededAt(runs, row) || std::isnan(error)) continue;
    Found& of = found[textAt(runs, row, "formulation")];
    of.errors.push_back(error);
    if (textAt(runs, row, "newton") == "simplified") {
      of.jacobians.push_back(numberAt(runs, row, "jacobians") / numberAt(runs, row, "steps_accepted"));
    }
  }
  std::vector<std::string> errors, jacobians;
  for (const auto& [formulation, of] : found) {
    errors.push_back(fmt::format("{:.0e} with `{}`", median(of.errors), formulation));
    if (of.jacobians.empty()) continue;
    jacobians.push_back(fmt::format("{} of the steps with `{}`", rangeText(of.jacobians), formulation));
  }
  std::string sentence =
      fmt::format("At steps of {} the multiplier has a median error of {}", errorText(h), listText(errors));
  if (!jacobians.empty())
    sentence += fmt::format("; simplified Newton needs a new Jacobian in {}", listText(jacobians));
  return sentence + ".";
}

std::string estimateSentence(const Table& estimates) {
  struct Count {
    int steps = 0, above = 0, far = 0;
    double part(int count) const { return static_cast<double>(count) / steps; }
  };
  std::map<std::string, Count> counts;  // by component
  Count all;
  for (const auto& row : estimates.rows) {
    const double ratio = numberAt(estimates, row, "doubling");
    if (std::isnan(ratio)) continue;
    for (Count* count : {&all, &counts[textAt(estimates, row, "group")]}) {
      ++count->steps;
      count->above += ratio > 1 ? 1 : 0;
      count->far += ratio > 10 ? 1 : 0;
    }
  }
  if (all.steps == 0) return {};
  std::vector<std::string> far;
  for (const auto& [group, count] : counts) {
    far.push_back(fmt::format("{} of those of {}", percentText(count.part(count.far)), group));
  }
  return fmt::format(
      "Of {} estimates by step doubling, the true error of the step is larger in {}, and more than ten times as large "
      "in {}.",
      all.steps, percentText(all.part(all.above)), listText(far));
}

std::string scalingSentence(const Table& slopes) {
  constexpr double kMostConfidence = 0.5;              // an exponent less certain than that tells nothing
  std::map<std::string, std::vector<double>> certain;  // by scene, solver and storage
  int uncertain = 0;
  for (const auto& row : slopes.rows) {
    const bool plain = textAt(slopes, row, "over") == "n" && textAt(slopes, row, "threads") == "1";
    const double slope = numberAt(slopes, row, "slope");
    if (!plain || std::isnan(slope)) continue;
    if (!(numberAt(slopes, row, "confidence") <= kMostConfidence)) {
      ++uncertain;
      continue;
    }
    certain[fmt::format("{} (`{}`, {})", textAt(slopes, row, "scene"), textAt(slopes, row, "solver"),
                        textAt(slopes, row, "storage"))]
        .push_back(slope);
  }
  std::vector<std::string> parts;
  for (const auto& [place, exponents] : certain) {
    const auto [least, most] = std::minmax_element(exponents.begin(), exponents.end());
    const std::string low = fmt::format("n^{:.2f}", *least), high = fmt::format("n^{:.2f}", *most);
    parts.push_back(fmt::format("{} on {}", low == high ? low : low + " to " + high, place));
  }
  if (parts.empty()) return {};
  std::string text = fmt::format("The time of a step grows with n unknowns like {}", listText(parts));
  if (uncertain > 0)
    text += fmt::format("; {} more exponents are uncertain by more than {}", uncertain, kMostConfidence);
  return text + ".";
}

std::string familiesFailSentence(const Table& runs) {
  struct Count {
    int runs = 0, useless = 0;
    double part() const { return static_cast<double>(useless) / runs; }
  };
  std::map<std::string, Count> counts;
  for (const auto& row : runs.rows) {
    Count& count = counts[textAt(runs, row, "family")];
    ++count.runs;
    count.useless += isUseless(runs, row) ? 1 : 0;
  }
  if (counts.size() < 2) return {};
  std::vector<std::pair<std::string, Count>> sorted(counts.begin(), counts.end());
  std::ranges::stable_sort(sorted, std::greater(), [](const auto& one) { return one.second.part(); });
  if (sorted.front().second.useless == 0) return "No run fails or ends without a correct digit.";
  std::vector<std::string> parts;
  for (const auto& [family, count] : sorted) {
    parts.push_back(fmt::format("`{}` {} of {}", family, percentText(count.part()), count.runs));
  }
  return fmt::format("Runs that fail or end without a correct digit: {}.", listText(parts));
}

std::string phasesSentence(const Table& phases) {
  constexpr std::string_view kParts[] = {"residual",     "jacobian", "factorization", "solve", "filter_factorization",
                                         "filter_solve", "update",   "step"};
  constexpr double kFewest = 30;  // unknowns; with fewer the parts are as short as a call of the clock
  // By scene and solver, then by the number of unknowns, the shares of each part in the time of these parts.
  std::map<std::string, std::map<double, std::map<std::string_view, std::vector<double>>>> shares;
  for (const auto& row : phases.rows) {
    const double n = numberAt(phases, row, "n");
    if (n < kFewest) continue;
    double sum = 0;
    for (const auto part : kParts) sum += numberAt(phases, row, fmt::format("share_{}", part));
    auto& here = shares[fmt::format("{}, `{}`", textAt(phases, row, "scene"), textAt(phases, row, "solver"))][n];
    for (const auto part : kParts) here[part].push_back(numberAt(phases, row, fmt::format("share_{}", part)) / sum);
  }
  const auto largest = [](const auto& by_part) {
    std::pair<std::string_view, double> found{"", -1};
    for (const auto& [part, values] : by_part) {
      if (const double share = median(values); share > found.second) found = {part, share};
    }
    return fmt::format("{} ({:.0f} %)", found.first, 100 * found.second);
  };
  std::vector<std::string> texts;
  for (const auto& [place, by_size] : shares) {
    const double n = by_size.begin()->first, most = by_size.rbegin()->first;
    std::string text = fmt::format("{}: {} at n = {}", place, largest(by_size.begin()->second), n);
    if (most > n) text += fmt::format(", {} at n = {}", largest(by_size.rbegin()->second), most);
    texts.push_back(text);
  }
  return texts.empty() ? "" : fmt::format("The part of the steps that takes most time: {}.", fmt::join(texts, "; "));
}

std::string energySentence(const Table& energy) {
  using BySummation = std::map<std::string, double>;
  std::map<std::string, std::map<std::string, BySummation>> largest;  // by scene and method
  for (const auto& row : energy.rows) {
    double& error =
        largest[textAt(energy, row, "scene")][textAt(energy, row, "method")][textAt(energy, row, "summation")];
    error = std::max(error, numberAt(energy, row, "largest"));
  }
  const auto least = [](const BySummation& errors) {
    return std::ranges::min_element(errors, {}, [](const auto& one) { return one.second; })->second;
  };
  std::vector<std::string> texts;
  for (const auto& [scene, by_method] : largest) {
    // The others have errors of the method itself, which no summation changes.
    const auto& [method, by_summation] =
        *std::ranges::min_element(by_method, {}, [&](const auto& one) { return least(one.second); });
    std::vector<std::string> errors;
    for (const auto& [summation, error] : by_summation)
      errors.push_back(fmt::format("{:.0e} with `{}`", error, summation));
    texts.push_back(fmt::format("{} on {} (`{}`)", listText(errors), scene, method));
  }
  return texts.empty()
             ? ""
             : fmt::format(
                   "The largest error of the energy, in the unit of the scene, with the method that keeps it best: {}.",
                   fmt::join(texts, "; "));
}

std::string stepsSentence(const Table& runs) {
  struct Found {
    std::vector<double> accepted;
    double rejected = 0, all = 0;
  };
  std::map<std::string, Found> found;
  for (const auto& row : runs.rows) {
    if (!succeededAt(runs, row)) continue;
    const double accepted = numberAt(runs, row, "steps_accepted");
    const double rejected = numberAt(runs, row, "steps_rejected_error") + numberAt(runs, row, "steps_rejected_newton");
    Found& of = found[textAt(runs, row, "method")];
    of.accepted.push_back(accepted);
    of.rejected += rejected;
    of.all += accepted + rejected;
  }
  std::vector<std::string> texts;
  for (const auto& [method, of] : found) {
    texts.push_back(fmt::format("{:.0f} with `{}`, {} of all tries rejected", median(of.accepted), method,
                                percentText(of.rejected / of.all)));
  }
  return texts.empty() ? "" : fmt::format("Steps, as a median: {}.", fmt::join(texts, "; "));
}

}  // namespace irk::report
