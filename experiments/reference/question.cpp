#include "experiments/reference/question.h"

#include <fmt/format.h>

#include "experiments/base/numbers.h"
#include "experiments/own/files.h"
#include "experiments/runs/setup.h"
#include "experiments/tables/build_info.h"

namespace irk {

ReferenceQuestion referenceQuestion(const RunSpec& resolved) {
  return {resolved.scene, settingsAtStep(resolved), resolved.t_end, resolved.discontinuity == Discontinuity::kSmooth,
          resolved.options.stop_at};
}

std::string keyText(const ReferenceQuestion& question) {
  const SceneEntry& scene = findScene(question.scene);
  std::string settings;
  for (const auto& parameter : scene.parameters) {
    const auto given = question.settings.find(parameter.name);
    const bool is_given = given != question.settings.end();
    settings += fmt::format("{}={};", parameter.name, is_given ? given->second : parameter.default_value);
  }
  const std::string tables = own::hashOfTables(scene, question.settings);
  return fmt::format("scene={};source={}{};{}t_end={}{};smooth={};code={}", scene.id, sourceOf(scene), tables, settings,
                     numberText(question.t_end), question.stop_at.empty() ? "" : ";stop_at=" + question.stop_at,
                     question.smooth, buildInfo().code);
}

std::string placeText(const std::vector<ReferenceQuestion>& questions) {
  const ReferenceQuestion& first = questions.front();
  const std::string others =
      questions.size() == 1 ? ""
                            : fmt::format(" ... {} ({} times)", numberText(questions.back().t_end), questions.size());
  return fmt::format("{}{}{}{}, t = {}{}{}", first.scene, first.settings.empty() ? "" : " ",
                     settingsText(first.settings), first.smooth ? " smooth" : "", numberText(first.t_end), others,
                     first.stop_at.empty() ? "" : " or " + first.stop_at);
}

std::string placeText(const ReferenceQuestion& question) { return placeText(std::vector{question}); }

std::string sourceOf(const SceneEntry& scene) { return own::hashOf("scene", scene.id); }

}  // namespace irk
