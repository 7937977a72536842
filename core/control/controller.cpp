#include "core/control/controller.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/constants.h"

namespace irk {

namespace {

/// A size at which Newton's method failed. The error estimate does not show such failures and would ask for that size
/// at once. The kBarredSteps-th call of `limit` is the first one that allows it again; until then no size grows beyond
/// nine tenths of it (kSafety).
class BarredSize {
 public:
  void failed(double h) {
    failed_ = h;
    steps_ = kBarredSteps.whole();
  }
  void forget() { steps_ = 0; }
  /// The size that follows an accepted step of size h whose error estimate asks for `wanted`.
  double limit(double wanted, double h) {
    const bool barred = steps_ > 0 && --steps_ > 0;
    return barred ? std::min(wanted, std::max(h, kSafety * failed_)) : wanted;
  }

 private:
  double failed_ = 0;
  int steps_ = 0;
};

/// Paper, section 6, with the error in units of the tolerance:
///   f = gamma (1 / (s_min eps))^(1/(p+1))                                        (6.1)
///   gamma = (eps_i / eps_{i-1}) (h_{i-1} / h_i)^p, after every change of step     (6.3)
/// The step is repeated if eps > 1. Its size stays the same unless f changes it by at least `change_at_least`. It grows
/// only if eps < 1 / s_max, s_max = s_min^2, and by at most `growth_at_most`.
class PaperController : public StepController {
 public:
  /// `gamma`: whether the factor gamma of (6.3) is used. The exponent is 1 / (p + beyond_order).
  struct Rules {
    bool gamma = true;
    int beyond_order = 1;
  };
  PaperController(const StepOptions& o, int order) : PaperController(o, order, Rules{}) {}
  PaperController(const StepOptions& o, int order, Rules rules)
      : o_(o), rules_(rules), p_(order), exponent_(exponentOf(order)), s_max_(o.s_min * o.s_min) {}

  StepDecision decide(double error, double h) override {
    // An estimate of zero would divide by zero; it gives the largest growth.
    const double eps = std::max(error, kTinyError);
    if (rules_.gamma && last_h_ > 0 && last_h_ != h) {
      const double gamma = eps / last_error_ * std::pow(last_h_ / h, p_);
      // The paper's text breaks off at "restrict gamma <". A gamma above 1 would enlarge the step because the error
      // grew faster than expected. A gamma far below 1 would prevent growth at round-off, where the error no longer
      // follows h^p.
      gamma_ = std::clamp(gamma, kGammaMin.value, 1.0);
    }
    last_error_ = eps;
    last_h_ = h;
    const double f = gamma_ * std::pow(1 / (o_.s_min * eps), exponent_);
    if (error > 1) return {false, h * std::min(f, 1 / o_.change_at_least)};
    if (f >= o_.change_at_least && eps < 1 / s_max_) {
      return {true, barred_.limit(h * std::min(f, o_.growth_at_most), h)};
    }
    if (f <= 1 / o_.change_at_least) return {true, h * f};
    return {true, h};
  }
  // The paper does not say what follows a Newton failure.
  double afterFailure(double h) override {
    barred_.failed(h);
    return h / o_.change_at_least;
  }
  void forget() override {
    gamma_ = 1;
    last_h_ = 0;
    barred_.forget();
  }
  void changeOrder(int order, double error, double h) override {
    p_ = order;
    exponent_ = exponentOf(order);
    gamma_ = 1;
    last_error_ = std::max(error, kTinyError);
    last_h_ = h;
  }

 private:
  double exponentOf(int order) const { return 1.0 / (order + rules_.beyond_order); }

  StepOptions o_;
  Rules rules_;
  int p_;
  double exponent_;
  double s_max_;
  double gamma_ = 1;
  double last_error_ = 0, last_h_ = 0;
  BarredSize barred_;
};

/// The later HOTINT source (paper/README erratum 5): s_min = 2, s_max = 4, exponent 1/p, no gamma.
class HotintController final : public PaperController {
 public:
  HotintController(const StepOptions& o, int order)
      : PaperController(rules(o), order, {.gamma = false, .beyond_order = 0}) {}

 private:
  static StepOptions rules(StepOptions o) {
    o.s_min = 2;
    return o;
  }
};

/// The paper's controller without (6.3): gamma stays 1.
class PaperWithoutGamma final : public PaperController {
 public:
  PaperWithoutGamma(const StepOptions& o, int order) : PaperController(o, order, {.gamma = false}) {}
};

// x^(1/degree), x >= 0. Square roots are faster than a power.
double root(double x, int degree) {
  if (!std::has_single_bit(static_cast<unsigned>(degree))) return std::pow(x, 1.0 / degree);
  for (; degree > 1; degree /= 2) x = std::sqrt(x);
  return x;
}

/// Gustafsson's predictive controller (1994), HW II (IV.8.25). It assumes a constant ratio of successive errors:
///   h_new = 0.9 h eps^(-1/(p+1)) min(1, (h_i / h_{i-1}) (eps_{i-1} / eps_i)^(1/(p+1))).
/// The size is kept if it would grow by less than a fifth, because new factors cost more than that gains; with
/// expensive factors it is kept up to a larger growth. The first step after a rejection does not grow.
class PredictiveController final : public StepController {
 public:
  PredictiveController(const StepOptions& options, int order)
      : h_min_(options.h_min), degree_(order + 1), least_root_(root(kErrorFloor, degree_)) {}

  StepDecision decide(double error, double h) override {
    const double eps = std::max(error, kTinyError);
    const double now = root(eps, degree_);
    double factor = kSafety / now;
    if (error > 1) {
      rejected_ = true;
      return {false, h * std::clamp(factor, kShrinkAtMost.value, kSafety.value)};
    }
    if (last_h_ > 0) factor *= std::min(1.0, h / last_h_ * last_root_ / now);
    last_h_ = h;
    last_root_ = std::max(now, least_root_);
    factor = std::clamp(factor, kShrinkAtMost.value, rejected_ ? 1.0 : kGrowAtMost.value);
    rejected_ = false;
    const double grown = factor < 1 || factor > keep_up_to_ ? h * factor : h;
    return {true, barred_.limit(grown, h)};
  }
  double afterFailure(double h) override {
    rejected_ = true;
    barred_.failed(h);
    const bool far_off = last_h_ == 0 && first_failures_++ > 0;
    return far_off ? std::max(h * kShrinkAtMost, std::min(h / 2, h_min_)) : h / 2;
  }
  void forget() override {
    last_h_ = 0;
    first_failures_ = 0;
    barred_.forget();
    rejected_ = false;
  }
  // If steps could grow by the ratio 1 + r each and the size is kept up to a growth of k, the cost per unit of time is
  // proportional to (ln k + r steps) / (1 - 1/k). The best k therefore grows with the cost of factors. Measured on
  // dense chains of beams, n = 60 ... 200: with k = 2 instead of 1.2 radau_iia_5 takes 0.26 ... 0.36 of the time, with
  // a smaller error.
  void factorsCost(double steps) override { keep_up_to_ = std::clamp(steps, kKeepUpTo.value, kKeepAtMost.value); }
  void changeOrder(int order, double error, double h) override {
    degree_ = order + 1;
    least_root_ = root(kErrorFloor, degree_);
    last_root_ = std::max(root(std::max(error, 0.0), degree_), least_root_);
    last_h_ = h;
  }

 private:
  double h_min_;
  double keep_up_to_ = kKeepUpTo;
  int degree_;                         // p + 1, of the roots
  double least_root_;                  // of kErrorFloor
  double last_root_ = 0, last_h_ = 0;  // of the last step: the root of its error, size
  BarredSize barred_;
  int first_failures_ = 0;
  bool rejected_ = false;
};

}  // namespace

Strategy<StepControl> predictiveControl() {
  return {
      StepControl::kPredictive, "Gustafsson's, HW II (IV.8.25)", {.estimate = true}, kConstruct<PredictiveController>};
}
Strategy<StepControl> paperControl() {
  return {StepControl::kPaper, "section 6 of the paper", {.estimate = true}, kConstruct<PaperController>};
}
Strategy<StepControl> paperControlWithoutGamma() {
  return {{"paper_no_gamma"},
          "the paper's, without the factor gamma of (6.3)",
          {.estimate = true},
          kConstruct<PaperWithoutGamma>};
}
Strategy<StepControl> hotintControl() {
  return {StepControl::kHotint,
          "the paper's, as in the later HOTINT source",
          {.estimate = true},
          kConstruct<HotintController>};
}
Strategy<StepControl> fixedStepControl() { return {StepControl::kFixed, "constant steps", {}, nullptr}; }

}  // namespace irk
