#include "experiments/runs/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

#include "core/base/text.h"
#include "core/control/order_controller.h"
#include "core/options/fixed_steps.h"
#include "core/options/option_fields.h"
#include "experiments/base/split.h"
#include "experiments/own/files.h"
#include "experiments/runs/configurations.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "irk/scene.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// Sets each `field=value` of a text with items separated by ';'.
void setFields(RunSpec& spec, std::string_view text) {
  while (!text.empty()) {
    const auto item = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const auto equals = item.find('=');
    if (equals == std::string_view::npos) {
      throw Misuse(fmt::format("'{}' in a run's text is not of the form field=value", item));
    }
    findField(item.substr(0, equals)).set(spec, item.substr(equals + 1));
  }
}

Field<RunSpec> sceneField() {
  return {.name = "scene",
          .meaning = "The system to integrate.",
          .form = "irk list scenes, or a file of your own: scene.cpp, scene.so or model.fmu",
          .get = [](const RunSpec& s) { return s.scene; },
          .set = [](RunSpec& s, std::string_view id) { s.scene = sceneNamed(std::string(id)); }};
}

// The text `name=value name=value`.
Settings settingsIn(std::string_view text) {
  Settings settings;
  for (const auto& item : split(text, ' ')) {
    if (!item.empty()) addSetting(settings, item);
  }
  return settings;
}

Field<RunSpec> settingsField() {
  return {.name = "settings",
          .meaning = "Parameters of the scene.",
          .form = "name=value, see irk list scenes",
          .get = [](const RunSpec& s) { return settingsText(s.settings); },
          .set = [](RunSpec& s, std::string_view value) { s.settings = settingsIn(value); }};
}

// The field of the axis `configuration`, whose ids set other fields as well.
Field<RunSpec> configurationField() {
  Field<RunSpec> field{.name = "configuration",
                       .meaning = "A named choice of strategies, which other options override.",
                       .kind = FieldKind::kAxis,
                       .get = [](const RunSpec& s) { return s.configuration; },
                       .set =
                           [](RunSpec& s, std::string_view id) {
                             const auto& configuration = findConfiguration(id);
                             s.configuration = id;
                             setFields(s, configuration.fields);
                           }};
  field.choices = [] {
    std::vector<Choice> choices;
    for (const auto& [id, meaning, fields] : configurations()) {
      choices.push_back({std::string(id), fmt::format("{}{}{}", meaning, fields.empty() ? "" : ": ", fields)});
    }
    return choices;
  };
  return field;
}

// Ids are written `radau_iia_5`. The nearest name to `Radau-IIA-5` by letters alone would be that of another family.
void refuseOtherSpelling(std::string_view method) {
  std::string id(method);
  for (char& c : id) c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto number = id.find_last_not_of("0123456789") + 1;
  if (id == method || number < 2 || std::filesystem::exists(method)) return;
  const bool known = findPeer(id) || isFamily(id) || isFamily(id.substr(0, number - 1));
  if (known) throw Misuse(fmt::format("unknown method '{}'; did you mean '{}'?", method, id));
}

Field<RunSpec> methodField() {
  return {.name = "method",
          .meaning = "The integration method.",
          .form =
              "family_stages or another library's integrator (irk list methods), a tableau file, a solver "
              "PATH.so or CODE@PATH.so, or a family with order variable",
          .get = [](const RunSpec& s) { return s.method; },
          .set =
              [](RunSpec& s, std::string_view value) {
                requirePlain("method", value, ";\n");
                refuseOtherSpelling(value);
                s.method = loadMethod(value);
              }};
}

// A number, or `scene` for the scene's own end (NaN).
Field<RunSpec> endField() {
  auto field = numberField<RunSpec>(
      "t_end",
      "The time at which the integration ends; scene = the scene's own. Before the start: the integration goes "
      "backward in time.",
      kAnyNumber, [](auto& s) -> auto& { return s.t_end; });
  field.get = [get = field.get](const RunSpec& s) { return std::isnan(s.t_end) ? "scene" : get(s); };
  field.set = [set = field.set](RunSpec& s, std::string_view text) {
    if (text == "scene") {
      s.t_end = std::numeric_limits<double>::quiet_NaN();
    } else {
      set(s, text);
    }
  };
  return field;
}

Field<RunSpec> atolOfField() {
  return {.name = "atol_of",
          .meaning = "Absolute tolerances of single components, instead of atol times their scale.",
          .form = "name=value name=value, names as solve prints them",
          .get = [](const RunSpec& s) { return settingsText(s.atol_of); },
          .set =
              [](RunSpec& s, std::string_view text) {
                s.atol_of = settingsIn(text);
                for (const auto& [name, value] : s.atol_of) parseNumber("atol_of " + name, value, kPositive);
              },
          .unused = [](const RunSpec& s) -> std::string_view {
            return hasFixedSteps(s.options.step) ? "fixed steps have no tolerance" : "";
          }};
}

Field<RunSpec> maxStagesField() {
  auto field = numberField<RunSpec>(
      "max_stages", "The most stages of variable order.", Range::integers(1, kMaxStages),
      [](auto& s) -> auto& { return s.max_stages; });
  field.unused = [](const RunSpec& s) -> std::string_view {
    return !choosesOrder(s.options.order) ? "it belongs to order 'variable'" : "";
  };
  return field;
}

// A study file has `error_bar = true`.
Field<RunSpec> errorBarField() {
  auto field = axisField<RunSpec>(
      "Whether a second, independent integration measures the error of a success.",
      [](auto& s) -> auto& { return s.error_bar; });
  field.set = [set = field.set](RunSpec& s, std::string_view text) {
    set(s, text == "true" ? "measured" : text == "false" ? "none" : text);
  };
  return field;
}

// The fields that a series runs through. All other fields, new ones too, are part of the name of a series.
constexpr std::string_view kSwept[] = {"h", "rtol", "atol"};

#define IRK_MEMBER(path) \
  [](auto& s) -> auto& { return s.path; }

// The fields of all members of RunSpec; `options` contributes its own.
std::vector<SpecField> makeFields() {
  auto before = std::to_array<Field<RunSpec>>(
      {sceneField(), settingsField(), configurationField(), methodField(),
       axisField<RunSpec>("The form of the equations, above all of constraints.", IRK_MEMBER(formulation)),
       axisField<RunSpec>("Whether the rows of constraints are scaled by the step size.", IRK_MEMBER(scaling)),
       axisField<RunSpec>("Which position constraints are integrated.", IRK_MEMBER(constraints)),
       axisField<RunSpec>("How switches of the scene are treated.", IRK_MEMBER(discontinuity)),
       axisField<RunSpec>("The kind of numbers of the computation.", IRK_MEMBER(scalar))});
  auto after = std::to_array<Field<RunSpec>>(
      {atolOfField(), maxStagesField(), endField(),
       numberField<RunSpec>("time_limit", "The run ends as timeout after this CPU time in seconds; 0 = no limit.",
                            kNotNegative, IRK_MEMBER(time_limit)),
       axisField<RunSpec>("How errors are measured if no reference is stored.", IRK_MEMBER(reference)),
       numberField<RunSpec>("reference_times", "The largest error is taken at this many times, equally far apart.",
                            Range::integers(1, kMaxReferenceTimes), IRK_MEMBER(reference_times)),
       errorBarField()});
  constexpr std::size_t kOwn = std::tuple_size_v<decltype(before)> + std::tuple_size_v<decltype(after)>;
  static_assert(kOwn + 1 == memberCount<RunSpec>(), "a member of RunSpec has no field");
  std::vector<SpecField> fields;
  for (auto& field : before) fields.push_back({std::move(field)});
  for (const auto& option : optionFields()) fields.push_back({fieldOfMember(option, &RunSpec::options)});
  for (auto& field : after) fields.push_back({std::move(field)});
  for (auto& field : fields) {
    field.swept = std::find(std::begin(kSwept), std::end(kSwept), field.name) != std::end(kSwept);
  }
  return fields;
}
#undef IRK_MEMBER

}  // namespace

std::string sceneNamed(const std::string& id_or_file) {
  if (!own::isFile(id_or_file) && !isLibrary(id_or_file)) return findScene(id_or_file).id;
  const std::string id = own::loadFile(id_or_file);
  if (id.empty()) throw Misuse(id_or_file + ": it holds no scene: IRK_SCENE(...) is expected");
  return id;
}

std::span<const SpecField> specFields() {
  static const std::vector<SpecField> fields = makeFields();
  return fields;
}

const SpecField& findField(std::string_view name) {
  if (name == kErrorBarKey) name = axisName<ErrorBarUse>();
  return entryNamed("field", name, specFields(), &SpecField::name);
}

std::string optionName(std::string_view field) {
  if (field == "scene") return "scene";
  if (field == "settings") return "--set";
  if (field == "h") return "--step";
  std::string option = "--" + std::string(field);
  if (field == axisName<ErrorBarUse>()) option = "--" + std::string(kErrorBarKey);
  std::replace(option.begin() + 2, option.end(), '_', '-');
  return option;
}

std::string helpText(const SpecField& field) {
  const std::string value = field.defaultText();
  return fmt::format("{} [{}{}{}]", field.meaning, field.allowed(), value.empty() ? "" : "; default ", value);
}

std::string canonicalText(const RunSpec& spec) {
  std::string text;
  for (const auto& field : specFields()) {
    if (!text.empty()) text += ';';
    text.append(field.name) += '=';
    text += field.get(spec);
  }
  return text;
}

RunSpec parseSpec(std::string_view text) {
  RunSpec spec;
  setFields(spec, text);
  if (spec.scene.empty()) throw Misuse("a run's text names no scene");
  return spec;
}

void validate(const RunSpec& spec) {
  RunSpec copy;
  for (const auto& field : specFields()) field.set(copy, field.get(spec));
}

}  // namespace irk
