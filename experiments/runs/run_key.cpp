// Everything that determines the numbers of a run, as one text and as a key.
#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

#include "core/base/input_file.h"
#include "core/control/order_controller.h"
#include "experiments/base/numbers.h"
#include "experiments/own/files.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/run_spec.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// A hash of A, b and c, rounded to double.
std::uint64_t tableauHash(const Tableau<double>& tableau) {
  std::string bytes;
  const auto append = [&bytes](const auto& numbers) {
    bytes.append(reinterpret_cast<const char*>(numbers.data()),
                 static_cast<std::size_t>(numbers.size()) * sizeof(double));
  };
  append(tableau.A);
  append(tableau.b);
  append(tableau.c);
  return fnv1a(bytes);
}

std::string hashedCoefficients(const std::string& method, int max_stages, OrderControl order) {
  if (!choosesOrder(order)) return hexText(tableauHash(makeTableau<double>(method)));
  const Methods<double> methods = makeMethods<double>(method, max_stages, 1);
  std::string all;
  for (const auto& member : methods.members()) all += hexText(tableauHash(member));
  return hexText(fnv1a(all));
}

// The coefficients of a run's method: a hash of its file's contents or of its tableaus. Empty for a peer of the
// program, and for a method that cannot be made, whose run is refused.
std::string coefficients(const RunSpec& spec) {
  if (const PeerEntry* peer = findPeer(spec.method)) return peer->source;
  static std::mutex mutex;
  static std::map<std::tuple<std::string, int, OrderControl>, std::string> known;
  const bool variable = choosesOrder(spec.options.order);
  const std::tuple name{spec.method, variable ? spec.max_stages : 0, spec.options.order};
  {
    const std::lock_guard lock(mutex);
    const auto found = known.find(name);
    if (found != known.end()) return found->second;
  }
  if (std::filesystem::is_regular_file(spec.method)) return hexText(fnv1a(readInputFile(spec.method)));
  std::string text;
  try {
    text = hashedCoefficients(spec.method, spec.max_stages, spec.options.order);
  } catch (const Misuse&) {
  }
  const std::lock_guard lock(mutex);
  return known[name] = text;
}

// Empty for a scene that cannot be made: its run is refused.
std::string tablesOf(const RunSpec& spec) {
  try {
    return own::hashOfTables(findScene(spec.scene), settingsAtStep(spec));
  } catch (const Misuse&) {
    return "";
  }
}

// Hashes of the users' files that the spec needs; empty for a spec of the program's own parts.
std::string ownFiles(const RunSpec& spec) {
  std::string text;
  const auto add = [&text](const std::string& kind, const std::string& id) {
    const std::string hash = own::hashOf(kind, id);
    if (!hash.empty()) text.append(";").append(kind).append(" from=").append(hash);
  };
  add("scene", spec.scene);
  const std::string tables = tablesOf(spec);
  if (!tables.empty()) text += ";tables=" + tables;
  for (const auto& field : specFields()) {
    if (field.kind == FieldKind::kAxis) add(field.name, field.get(spec));
  }
  return text;
}

}  // namespace

std::string keyText(const RunSpec& spec, const std::vector<Parameter>& parameters) {
  auto text = canonicalText(spec);
  for (const auto& parameter : parameters) {
    if (!spec.settings.contains(parameter.name)) {
      text.append(";").append(parameter.name).append("=").append(parameter.default_value);
    }
  }
  return text + ";coefficients=" + coefficients(spec) + ownFiles(spec);
}

std::string specKey(const RunSpec& spec) {
  return hexText(fnv1a(keyText(resolved(spec), findScene(spec.scene).parameters)));
}

std::string integratorName(const RunSpec& spec) {
  if (findPeer(spec.method)) return spec.method;
  if (spec.options.order == OrderControl::kVariable) return spec.configuration;
  if (choosesOrder(spec.options.order)) return spec.configuration + ":" + std::string(spec.options.order.id);
  return spec.configuration + ":" + spec.method;
}

}  // namespace irk
