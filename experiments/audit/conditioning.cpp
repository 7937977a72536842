#include "experiments/audit/conditioning.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>

#include "experiments/audit/judge.h"
#include "experiments/base/decimal.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_errors.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"
#include "irk/scene_file.h"

namespace irk::audit {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// u, v, x at the start and at the end.
struct Motion {
  Vec<BigFloat> start, end;
};

Vec<BigFloat> stateOf(const State<BigFloat>& s) {
  Vec<BigFloat> y(s.u.size() + s.v.size() + s.x.size());
  y << s.u, s.v, s.x;
  return y;
}

// nullopt if there is no such scene: the parameter is out of range, or has no consistent start.
std::optional<Motion> motionOf(const SceneEntry& entry, const Settings& settings, double t_end) {
  try {
    const auto scene = makeScene<BigFloat>(entry, settings);
    if (!scene.exact) return {};
    return Motion{stateOf(scene.start), stateOf(scene.exact(decimalNumber<BigFloat>(t_end)))};
  } catch (const Misuse&) {
    return {};
  } catch (const std::logic_error&) {
    return {};
  }
}

// The largest |a - b| / max(|b|, scale); NaN without components. The differences are formed in 50 digits.
double distance(const Vec<BigFloat>& a, const Vec<BigFloat>& b, const Vec<double>& scale) {
  if (a.size() != b.size()) return kNone;
  double largest = a.size() > 0 ? 0 : kNone;
  for (Index i = 0; i < a.size(); ++i) {
    const double magnitude = std::max(std::abs(static_cast<double>(b[i])), i < scale.size() ? scale[i] : 1);
    const double size = std::abs(static_cast<double>(BigFloat(a[i] - b[i]))) / magnitude;
    largest = std::isfinite(size) ? std::max(largest, size) : std::numeric_limits<double>::infinity();
  }
  return largest;
}

// The value as a number; nullopt if it is a word or has no digits behind the point.
std::optional<double> numberOf(const Parameter& p, const std::string& text) {
  if (!p.choices.empty() || p.whole || p.text) return {};
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

}  // namespace

double growthByClosedForm(const std::string& id, const Settings& settings, double t_end) {
  const SceneEntry& entry = findScene(id);
  if (!entry.make_big_float) return kNone;
  const Settings values = completedSettings(id, entry.parameters, settings);
  const auto motion = motionOf(entry, values, t_end);
  if (!motion) return kNone;
  const Vec<double> scale = makeScene<double>(entry, values).scale;
  double growth = kNone;
  for (const Parameter& p : entry.parameters) {
    const auto value = numberOf(p, values.at(p.name));
    if (!value) continue;
    const double step = kPerturbation * (*value == 0 ? 1 : std::abs(*value));
    Settings moved = values;
    moved[p.name] = numberText(*value + step <= p.max ? *value + step : *value - step);
    const auto other = motionOf(entry, moved, t_end);
    if (!other) continue;
    const double at_start = distance(other->start, motion->start, scale);
    if (at_start > 0) growth = std::fmax(growth, distance(other->end, motion->end, scale) / at_start);
  }
  return growth;
}

}  // namespace irk::audit
