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

template <class Real>
double relativeError(const Real& value, const Real& reference, double scale) {
  const double magnitude = std::max(std::abs(static_cast<double>(reference)), scale);
  return std::abs(static_cast<double>(Real(value - reference))) / magnitude;
}

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

template <class Real>
void compareExact(const Scene<Real>& scene, const Sizes& n, const State<Real>& state, RunErrors& errors) {
  const Vec<Real> y = components(state);
  const Vec<Real> reference = components(scene.exact(state.t));
  for (Index i = 0; i < std::min(y.size(), reference.size()); ++i) {
    if (std::isnan(static_cast<double>(reference[i]))) continue;
    const double error = relativeError(y[i], reference[i], scaleOf(scene.scale, i));
    raise(group(errors, n, i), error);
    raise(errors.all, error);
  }
}

template <class Real>
void compareReference(const Scene<Real>& scene, const Sizes& n, const State<Real>& state, const Reference& reference,
                      RunErrors& errors, RunErrors& accuracies) {
  const Real value = decimalNumber<Real>(reference.value);
  const auto accuracy = [&](double scale) {
    return reference.accuracy / std::max(std::abs(static_cast<double>(value)), scale);
  };
  const auto at = std::find(scene.names.begin(), scene.names.end(), reference.component);
  if (at != scene.names.end()) {
    const Index i = at - scene.names.begin();
    const double scale = scaleOf(scene.scale, i);
    const double error = relativeError(components(state)[i], value, scale);
    raise(group(errors, n, i), error);
    raise(errors.all, error);
    raise(group(accuracies, n, i), accuracy(scale));
    raise(accuracies.all, accuracy(scale));
    return;
  }
  for (const auto& output : scene.outputs) {
    if (output.name == reference.component) {
      raise(errors.all, relativeError(output.value(state), value, 1));
      raise(accuracies.all, accuracy(1));
    }
  }
}

// The errors by the most accurate references at the state's time, and the accuracies of these.
template <class Real>
void compareReferences(const Scene<Real>& scene, const std::vector<Reference>& references, const State<Real>& state,
                       RunErrors& errors, RunErrors& accuracies) {
  const Sizes n = scene.sizes();
  for (const auto& [component, reference] : bestAt(references, static_cast<double>(state.t))) {
    compareReference(scene, n, state, *reference, errors, accuracies);
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

template <class Real>
RunErrors errorsOf(const Scene<Real>& scene, const std::vector<Reference>& references, const State<Real>& state) {
  RunErrors errors;
  const Sizes n = scene.sizes();
  errors.drift = driftOf(scene, state);
  if (scene.exact) compareExact(scene, n, state, errors);
  if (!std::isnan(errors.all)) {
    errors.reference = ReferenceKind::kExact;
    return errors;
  }
  RunErrors ignored;
  compareReferences(scene, references, state, errors, ignored);
  if (!std::isnan(errors.all)) errors.reference = ReferenceKind::kFile;
  return errors;
}

template <class Real>
RunErrors errorsByComputed(const Scene<Real>& scene, const std::vector<Reference>& computed, const State<Real>& state) {
  RunErrors errors, accuracies;
  errors.drift = driftOf(scene, state);
  compareReferences(scene, computed, state, errors, accuracies);
  if (std::isnan(errors.all)) return errors;
  errors.reference = ReferenceKind::kComputed;
  errors.accuracy = accuracies.all;
  if (errors.all < kMeasurable * accuracies.all) {
    errors.remark = fmt::format("error below {:.0e}, ten times the reference's accuracy: not measurable",
                                kMeasurable * accuracies.all);
  }
  for (auto error : {&RunErrors::all, &RunErrors::u, &RunErrors::v, &RunErrors::x, &RunErrors::z}) {
    if (errors.*error < kMeasurable * accuracies.*error) errors.*error = std::numeric_limits<double>::quiet_NaN();
  }
  return errors;
}

template Vec<double> components(const State<double>&);
template Vec<mp50> components(const State<mp50>&);
template Vec<mp100> components(const State<mp100>&);
template RunErrors errorsOf(const Scene<double>&, const std::vector<Reference>&, const State<double>&);
template RunErrors errorsByComputed(const Scene<double>&, const std::vector<Reference>&, const State<double>&);
template RunErrors errorsOf(const Scene<mp50>&, const std::vector<Reference>&, const State<mp50>&);
template RunErrors errorsByComputed(const Scene<mp50>&, const std::vector<Reference>&, const State<mp50>&);
template RunErrors errorsOf(const Scene<mp100>&, const std::vector<Reference>&, const State<mp100>&);
template RunErrors errorsByComputed(const Scene<mp100>&, const std::vector<Reference>&, const State<mp100>&);

}  // namespace irk
