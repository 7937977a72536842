#include "experiments/runs/texts/component_names.h"

#include <regex>

namespace irk {
namespace {

// The place, among the scene's (u, v, x, z), of component i of a group of the system; -1 if the scene has no such
// component.
Index placeOf(char group, Index i, const Sizes& scene, const Sizes& system) {
  if (group == 'u') return i < scene.nu ? i : -1;
  if (group == 'v') return i < scene.nu ? scene.nu + i : -1;
  if (group == 'z') return i < scene.nz ? 2 * scene.nu + scene.nx + i : -1;
  // Formulations of first order have (u, v, x) of the scene as x.
  const Index place = system.nu == scene.nu ? 2 * scene.nu + i : i;
  return place < 2 * scene.nu + scene.nx ? place : -1;
}

}  // namespace

std::string withNames(const std::string& message, const std::vector<std::string>& names, const Sizes& scene,
                      const Sizes& system) {
  static const std::regex component("\\b([uvxz])\\[([0-9]{1,6})\\]");
  // The start is always in the scene's unknowns.
  const Sizes& unknowns = message.starts_with("at the start:") ? scene : system;
  std::string text;
  auto rest = message.begin();
  for (std::sregex_iterator found(message.begin(), message.end(), component), none; found != none; ++found) {
    const char group = *(*found)[1].first;
    const Index i = std::stoi((*found)[2].str());
    const Index place = placeOf(group, i, scene, unknowns);
    text.append(rest, (*found)[0].first);
    const bool named = place >= 0 && place < static_cast<Index>(names.size());
    const bool ggl = group == 'z' && i >= scene.nz && i < unknowns.nz;
    text += named ? names[static_cast<std::size_t>(place)]
            : ggl ? "GGL's multiplier " + std::to_string(i - scene.nz)
                  : found->str();
    rest = (*found)[0].second;
  }
  return text.append(rest, message.end());
}

}  // namespace irk
