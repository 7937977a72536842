#include "experiments/analyses/orders/row_theory.h"

#include <cmath>
#include <cstdlib>

#include "experiments/runs/fields.h"
#include "experiments/runs/run_spec.h"
#include "experiments/runs/run_table.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// For |h lambda| above this, a stiff component agrees with its limit to several digits.
constexpr double kStiffLimit = 1e3;

// The kind of a scene that its settings make stiff.
std::optional<SystemKind> stiffKind(const SceneEntry& scene, const std::string& settings, double h) {
  const std::string text = stiffnessText(scene, settings);
  const bool test = scene.kind == SceneKind::kStiffTest;
  if (text.ends_with("/h")) return test ? std::optional(SystemKind::kStiffFixedZ) : std::nullopt;
  const double value = std::abs(std::strtod(text.c_str(), nullptr));
  const double stiffness = scene.stiffness.reciprocal ? 1 / value : value;
  if (test && stiffness * h >= kStiffLimit) return SystemKind::kStiffFixedLambda;
  return stiffness <= 1 ? std::optional(SystemKind::kOde) : std::nullopt;
}

std::optional<SystemKind> mechanicalKind(const std::string& formulation) {
  if (formulation == "index3") return SystemKind::kMechanical3;
  if (formulation == "index2") return SystemKind::kMechanical2;
  if (formulation == "index2_projected") return SystemKind::kProjected;
  if (formulation == "ggl") return SystemKind::kGgl;
  return {};
}

}  // namespace

Sizes sizesOf(const Table& runs, const TableRow& row) {
  RunSpec spec;
  findField("scene").set(spec, textAt(runs, row, "scene"));
  findField("settings").set(spec, textAt(runs, row, "settings"));
  return makeScene<double>(spec.scene, settingsAtStep(spec)).sizes();
}

std::string stiffnessText(const SceneEntry& scene, const std::string& settings) {
  const std::string& name = scene.stiffness.parameter;
  const std::string start = ' ' + name + '=', all = ' ' + settings;
  if (const auto at = all.find(start); at != all.npos) {
    const auto value = at + start.size();
    return all.substr(value, all.find(' ', value) - value);
  }
  for (const Parameter& parameter : scene.parameters) {
    if (parameter.name == name) return parameter.default_value;
  }
  return {};
}

std::optional<SystemKind> kindOf(const Table& runs, const TableRow& row, double h) {
  const SceneEntry& scene = findScene(textAt(runs, row, "scene"));
  switch (scene.kind) {
    case SceneKind::kStiffTest:
    case SceneKind::kSingularlyPerturbed:
      return stiffKind(scene, textAt(runs, row, "settings"), h);
    case SceneKind::kIndex1:
      return SystemKind::kIndex1;
    case SceneKind::kIndex2:
      return SystemKind::kIndex2;
    case SceneKind::kIndex3:
      return SystemKind::kIndex3;
    case SceneKind::kOde:
    case SceneKind::kConstrained:
      break;
  }
  const auto& formulation = textAt(runs, row, "formulation");
  const Sizes n = sizesOf(runs, row);
  if (n.nz == 0 || formulation == "first_order") return SystemKind::kOde;
  return n.constraints < n.nz ? std::nullopt : mechanicalKind(formulation);
}

Theory theoryFor(const Table& runs, const TableRow& row, std::optional<SystemKind> kind, char component) {
  if (!kind) return {};
  const auto stages = static_cast<Index>(numberAt(runs, row, "stages"));
  // z is solved again from u, v and x, so its order is that of v.
  const bool consistent =
      component == 'z' && textAt(runs, row, "multipliers") == "consistent" && sizesOf(runs, row).constraints > 0;
  const auto order = theoreticalOrder(textAt(runs, row, "family"), stages, *kind, consistent ? 'v' : component);
  if (order) return {order->order, std::string(order->source)};
  if (*kind != SystemKind::kOde) return {};
  try {
    return {static_cast<double>(makeTableau<double>(textAt(runs, row, "method")).order), "tableau"};
  } catch (const Misuse&) {  // the file is no longer there
    return {};
  }
}

}  // namespace irk
