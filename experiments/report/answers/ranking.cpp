#include "experiments/report/answers/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "experiments/report/answers/answer.h"

namespace irk::report {
namespace {

constexpr double kAsFast = 1.1;  // costs that differ by less are called equal

// The mean of logarithms, as a factor.
class GeometricMean {
 public:
  void add(double x) {
    sum_ += std::log(x);
    ++count_;
  }
  int count() const { return count_; }
  double value() const { return count_ > 0 ? std::exp(sum_ / count_) : std::numeric_limits<double>::quiet_NaN(); }

 private:
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace

std::vector<Ranked> ranking(const SolverCosts& costs) {
  const auto least = leastCosts(costs);
  std::vector<Ranked> all;
  for (const auto& [solver, problems] : costs) {
    Ranked ranked{.solver = solver};
    GeometricMean mean;
    for (const auto& [problem, cost] : problems) {
      const auto best = least.find(problem);
      if (best == least.end()) continue;
      ++ranked.given;
      if (std::isfinite(cost)) mean.add(cost / best->second);
    }
    ranked.solved = mean.count();
    ranked.factor = mean.value();
    if (ranked.solved > 0) all.push_back(std::move(ranked));
  }
  std::sort(all.begin(), all.end(), [](const Ranked& a, const Ranked& b) {
    return std::tuple(-a.solved, a.factor, a.solver) < std::tuple(-b.solved, b.factor, b.solver);
  });
  return all;
}

int solvable(const SolverCosts& costs) { return static_cast<int>(leastCosts(costs).size()); }

double ratio(const SolverCosts& costs, const std::string& slow, const std::string& fast) {
  GeometricMean mean;
  const auto a = costs.find(slow), b = costs.find(fast);
  if (a == costs.end() || b == costs.end()) return mean.value();
  for (const auto& [problem, cost] : a->second) {
    const auto other = b->second.find(problem);
    if (other != b->second.end() && std::isfinite(cost) && std::isfinite(other->second)) mean.add(cost / other->second);
  }
  return 2 * mean.count() < solvable(costs) ? std::numeric_limits<double>::quiet_NaN() : mean.value();
}

std::map<std::string, int> wins(const SolverCosts& costs) {
  const auto least = leastCosts(costs);
  std::map<std::string, int> count;
  for (const auto& [solver, problems] : costs) {
    for (const auto& [problem, cost] : problems) {
      const auto best = least.find(problem);
      if (best != least.end() && cost <= best->second) ++count[solver];
    }
  }
  return count;
}

std::string comparison(double factor, const Ranked& best, const Ranked& other, int problems) {
  if (other.solver.empty()) return "no other reaches this error";
  std::string text =
      std::isnan(factor)
          ? fmt::format("no ratio: too few problems in common with the best other library's solver, `{}`", other.solver)
      : factor < 1 / kAsFast ? fmt::format("{} times as slow as `{}`", factorText(1 / factor), other.solver)
      : factor < kAsFast     ? fmt::format("as fast as `{}`", other.solver)
                             : fmt::format("{} times as fast as `{}`", factorText(factor), other.solver);
  if (other.solved < best.solved) {
    text += fmt::format(", which solves {} of {}", other.solved, problems);
    if (other.given < problems)
      text += fmt::format(" and was not asked for so small an error in {}", problems - other.given);
  }
  return text;
}

}  // namespace irk::report
