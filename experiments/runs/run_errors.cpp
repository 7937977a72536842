#include "experiments/runs/run_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "experiments/base/decimal.h"

namespace irk {
namespace {

// References are given at times such as 0.3, which a run reaches up to round-off.
constexpr double kSameTime = 1e-12;

void raise(double& largest, double error) {
  if (!std::isnan(error) && !(largest >= error)) largest = error;
}

// The deviation of a component or output from its reference.
struct Deviation {
  double distance;   // |y - ref|
  double magnitude;  // |ref|
  double scale;      // the magnitude below which errors are absolute
  double ratio;      // atol / rtol

  // Infinite where there is no solution.
  double error() const { return std::isinf(magnitude) ? magnitude : distance / std::max(magnitude, scale); }
};

void raise(RunErrors& errors, const Deviation& d) {
  raise(errors.all, d.error());
  raise(errors.mixed, d.distance / (d.ratio + d.magnitude));
  if (d.magnitude > 0) raise(errors.relative, d.distance / d.magnitude);
}

template <class Real>
double distanceOf(const Real& value, const Real& reference) {
  return std::abs(static_cast<double>(Real(value - reference)));
}

double digitsOf(double error) { return 0 - std::log10(error); }

// The most accurate reference of each component at time t.
std::map<std::string, const Reference*> bestAt(const std::vector<Reference>& references, double t) {
  std::map<std::string, const Reference*> best;
  for (const Reference& reference : references) {
    if (std::abs(reference.t - t) > kSameTime * std::max(1.0, std::abs(t))) continue;
    const auto [at, added] = best.try_emplace(reference.component, &reference);
    if (!added && reference.accuracy < at->second->accuracy) at->second = &reference;
  }
  return best;
}

// The error of the group (u, v, x or z) that contains component i.
double& group(RunErrors& errors, const Sizes& n, Index i) {
  if (i < n.nu) return errors.u;
  if (i < 2 * n.nu) return errors.v;
  return i < 2 * n.nu + n.nx ? errors.x : errors.z;
}

double scaleOf(const Vec<double>& scale, Index i) { return i < scale.size() ? scale[i] : 1; }

/// Compares the final state of a scene with references.
template <class Real>
class Comparison {
 public:
  Comparison(const Scene<Real>& scene, const State<Real>& state, const ToleranceRatio& ratio)
      : scene_(scene), n_(scene.sizes()), state_(state), y_(components(state)), ratio_(ratio) {}

  RunErrors errors;
  RunErrors accuracies;  ///< of the references, in the measures of the errors

  void withExact() {
    const Vec<Real> reference = components(scene_.exact(state_.t));
    for (Index i = 0; i < std::min(y_.size(), reference.size()); ++i) {
      if (!std::isnan(static_cast<double>(reference[i]))) add(i, reference[i], 0);
    }
  }

  void with(const Reference& reference) {
    const Real value = decimalNumber<Real>(reference.value);
    const auto at = std::find(scene_.names.begin(), scene_.names.end(), reference.component);
    if (at != scene_.names.end()) {
      add(at - scene_.names.begin(), value, reference.accuracy);
      return;
    }
    for (const auto& output : scene_.outputs) {
      if (output.name != reference.component) continue;
      Deviation d{distanceOf(output.value(state_), value), std::abs(static_cast<double>(value)), 1,
                  ratio_.atol_over_rtol};
      raise(errors, d);
      d.distance = reference.accuracy;
      raise(accuracies, d);
    }
  }

 private:
  void add(Index i, const Real& reference, double accuracy) {
    Deviation d{distanceOf(y_[i], reference), std::abs(static_cast<double>(reference)), scaleOf(scene_.scale, i),
                ratio_.atol_over_rtol * scaleOf(ratio_.scale, i)};
    raise(group(errors, n_, i), d.error());
    raise(errors, d);
    d.distance = accuracy;
    raise(group(accuracies, n_, i), d.error());
    raise(accuracies, d);
  }

  const Scene<Real>& scene_;
  Sizes n_;
  const State<Real>& state_;
  Vec<Real> y_;
  const ToleranceRatio& ratio_;
};

// Compares with the most accurate references at the state's time.
template <class Real>
void compare(Comparison<Real>& comparison, const std::vector<Reference>& references, const State<Real>& state) {
  for (const auto& [component, reference] : bestAt(references, static_cast<double>(state.t))) {
    comparison.with(*reference);
  }
}

template <class Real>
double driftOf(const Scene<Real>& scene, const State<Real>& state) {
  const auto system = scene.system({});
  const Sizes n = system->sizes();
  double drift = std::numeric_limits<double>::quiet_NaN();
  Vec<Real> r(n.n());
  if (n.constraints > 0) system->evaluate(Level::kPosition, pointOf(state), {r.data(), r.size()});
  for (Index i = n.nu + n.nx; i < n.nu + n.nx + n.constraints; ++i) {
    raise(drift, std::abs(static_cast<double>(r[i])));
  }
  return drift;
}

}  // namespace

std::string_view referenceName(ReferenceKind kind) {
  switch (kind) {
    case ReferenceKind::kNone:
      return "none";
    case ReferenceKind::kExact:
      return "exact";
    case ReferenceKind::kFile:
      return "file";
    case ReferenceKind::kComputed:
      return "computed";
  }
  return "?";
}

RunErrors largerErrors(const RunErrors& a, const RunErrors& b) {
  RunErrors larger;
  raise(larger.drift, a.drift);
  raise(larger.drift, b.drift);
  if (a.reference == ReferenceKind::kNone || b.reference == ReferenceKind::kNone) return larger;
  larger = a;
  for (auto error : {&RunErrors::all, &RunErrors::u, &RunErrors::v, &RunErrors::x, &RunErrors::z, &RunErrors::drift,
                     &RunErrors::accuracy}) {
    raise(larger.*error, b.*error);
  }
  return larger;
}

template <class Real>
Vec<Real> components(const State<Real>& s) {
  Vec<Real> y(s.u.size() + s.v.size() + s.x.size() + s.z().size());
  y << s.u, s.v, s.x, s.z();
  return y;
}

double RunErrors::mescd() const { return digitsOf(mixed); }
double RunErrors::scd() const { return digitsOf(relative); }

template <class Real>
RunErrors errorsOf(const Scene<Real>& scene, const std::vector<Reference>& references, const State<Real>& state,
                   const ToleranceRatio& ratio) {
  Comparison<Real> comparison(scene, state, ratio);
  RunErrors& errors = comparison.errors;
  errors.drift = driftOf(scene, state);
  if (scene.exact) comparison.withExact();
  if (!std::isnan(errors.all)) {
    errors.reference = ReferenceKind::kExact;
    return errors;
  }
  compare(comparison, references, state);
  if (!std::isnan(errors.all)) errors.reference = ReferenceKind::kFile;
  return errors;
}

template <class Real>
RunErrors errorsByComputed(const Scene<Real>& scene, const std::vector<Reference>& computed, const State<Real>& state,
                           const ToleranceRatio& ratio) {
  Comparison<Real> comparison(scene, state, ratio);
  RunErrors& errors = comparison.errors;
  const RunErrors& accuracies = comparison.accuracies;
  errors.drift = driftOf(scene, state);
  for (const Reference& one : computed) {
    if (one.component == kEventTime) errors.t = distanceOf(state.t, decimalNumber<Real>(one.value));
  }
  compare(comparison, computed, state);
  if (std::isnan(errors.all)) return errors;
  errors.reference = ReferenceKind::kComputed;
  errors.accuracy = accuracies.all;
  if (errors.all < kMeasurable * accuracies.all) {
    errors.remark = fmt::format("error below {:.0e}, ten times the reference's accuracy: not measurable",
                                kMeasurable * accuracies.all);
  }
  for (auto error : {&RunErrors::all, &RunErrors::u, &RunErrors::v, &RunErrors::x, &RunErrors::z, &RunErrors::mixed,
                     &RunErrors::relative}) {
    if (errors.*error < kMeasurable * accuracies.*error) errors.*error = std::numeric_limits<double>::quiet_NaN();
  }
  return errors;
}

template Vec<double> components(const State<double>&);
template Vec<BigFloat> components(const State<BigFloat>&);
template RunErrors errorsOf(const Scene<double>&, const std::vector<Reference>&, const State<double>&,
                            const ToleranceRatio&);
template RunErrors errorsByComputed(const Scene<double>&, const std::vector<Reference>&, const State<double>&,
                                    const ToleranceRatio&);
template RunErrors errorsOf(const Scene<BigFloat>&, const std::vector<Reference>&, const State<BigFloat>&,
                            const ToleranceRatio&);
template RunErrors errorsByComputed(const Scene<BigFloat>&, const std::vector<Reference>&, const State<BigFloat>&,
                                    const ToleranceRatio&);

}  // namespace irk
