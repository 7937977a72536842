#include "experiments/report/answers/measured_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
    jacobians.push_back(fmt::format("{} of the steps with `{}`", percentText(median(of.jacobians)), formulation));
  }
  std::string sentence =
      fmt::format("At steps of {} the multiplier has a median error of {}", errorText(h), listText(errors));
  if (!jacobians.empty())
    sentence += fmt::format("; simplified Newton needs a new Jacobian in {}", listText(jacobians));
  return sentence + ".";
}

std::string estimateSentence(const Table& estimates) {
  int steps = 0, above = 0, far = 0;
  for (const auto& row : estimates.rows) {
    const double ratio = numberAt(estimates, row, "doubling");
    if (std::isnan(ratio)) continue;
    ++steps;
    above += ratio > 1 ? 1 : 0;
    far += ratio > 10 ? 1 : 0;
  }
  if (steps == 0) return {};
  return fmt::format(
      "Of {} estimates by step doubling, the true error of the step is larger in {}, and more than ten times as large "
      "in {}.",
      steps, percentText(static_cast<double>(above) / steps), percentText(static_cast<double>(far) / steps));
}

std::string scalingSentence(const Table& slopes) {
  std::vector<std::string> parts;
  for (const auto& row : slopes.rows) {
    const bool plain = textAt(slopes, row, "over") == "n" && textAt(slopes, row, "threads") == "1";
    const double slope = numberAt(slopes, row, "slope");
    if (!plain || std::isnan(slope)) continue;
    parts.push_back(fmt::format("n^{:.2f} on {} (`{}`, {}, `{}`)", slope, textAt(slopes, row, "scene"),
                                textAt(slopes, row, "solver"), textAt(slopes, row, "storage"),
                                textAt(slopes, row, "at")));
  }
  return parts.empty() ? "" : fmt::format("The time of a step grows with n unknowns like {}.", listText(parts));
}

std::string familiesFailSentence(const Table& runs) {
  struct Count {
    int runs = 0, failed = 0;
    double part() const { return static_cast<double>(failed) / runs; }
  };
  std::map<std::string, Count> counts;
  for (const auto& row : runs.rows) {
    Count& count = counts[textAt(runs, row, "family")];
    ++count.runs;
    count.failed += succeededAt(runs, row) ? 0 : 1;
  }
  if (counts.size() < 2) return {};
  const auto [least, most] = std::minmax_element(
      counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second.part() < b.second.part(); });
  if (most->second.failed == 0) return "No run fails.";
  return fmt::format("`{}` fails most often, in {} of {} runs; `{}` least often, in {} of {}.", most->first,
                     most->second.failed, most->second.runs, least->first, least->second.failed, least->second.runs);
}

std::string phasesSentence(const Table& phases) {
  constexpr std::string_view kParts[] = {"residual", "jacobian", "factorization", "solve", "update", "step", "start"};
  // By solver and number of unknowns, the shares of each part.
  std::map<std::string, std::map<double, std::map<std::string_view, std::vector<double>>>> shares;
  for (const auto& row : phases.rows) {
    auto& here = shares[textAt(phases, row, "solver")][numberAt(phases, row, "n")];
    for (const auto part : kParts) here[part].push_back(numberAt(phases, row, fmt::format("share_{}", part)));
  }
  const auto largest = [](const auto& by_part) {
    std::pair<std::string_view, double> found{"", -1};
    for (const auto& [part, values] : by_part) {
      if (const double share = median(values); share > found.second) found = {part, share};
    }
    return found;
  };
  std::vector<std::string> texts;
  for (const auto& [solver, by_size] : shares) {
    const auto first = largest(by_size.begin()->second), last = largest(by_size.rbegin()->second);
    const double n = by_size.begin()->first, most = by_size.rbegin()->first;
    std::string text = fmt::format("`{}` {} ({:.0f} %) at n = {}", solver, first.first, 100 * first.second, n);
    if (most > n) text += fmt::format(", {} ({:.0f} %) at n = {}", last.first, 100 * last.second, most);
    texts.push_back(text);
  }
  return texts.empty() ? "" : fmt::format("The part with the largest median share: {}.", fmt::join(texts, "; "));
}

std::string energySentence(const Table& energy) {
  std::map<std::string, std::map<std::string, double>> largest;  // by scene and summation
  for (const auto& row : energy.rows) {
    double& error = largest[textAt(energy, row, "scene")][textAt(energy, row, "summation")];
    error = std::max(error, numberAt(energy, row, "largest"));
  }
  std::vector<std::string> texts;
  for (const auto& [scene, by_summation] : largest) {
    std::vector<std::string> errors;
    for (const auto& [summation, error] : by_summation)
      errors.push_back(fmt::format("{:.0e} with `{}`", error, summation));
    texts.push_back(fmt::format("{} on {}", listText(errors), scene));
  }
  return texts.empty() ? "" : fmt::format("The largest relative error of the energy: {}.", fmt::join(texts, "; "));
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
