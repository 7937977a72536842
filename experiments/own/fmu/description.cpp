#include "experiments/own/fmu/description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

#include "irk/misuse.h"

namespace irk::own {
namespace {

using Node = pugi::xml_node;

std::string text(const Node& node, const char* attribute) { return node.attribute(attribute).as_string(); }
bool flag(const Node& node, const char* attribute) { return node.attribute(attribute).as_bool(); }

constexpr std::size_t kMostElements = 1'000'000;

std::vector<std::string> startsIn(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

/// The variables of one file, by their number from 1 on (version 2) or by reference (version 3).
class Variables {
 public:
  Variables(const Node& root, int version) : version_(version) {
    for (const Node& type : root.child("TypeDefinitions").children()) types_[text(type, "name")] = type;
    for (const Node& node : root.child("ModelVariables").children()) {
      if (node.type() != pugi::node_element) continue;
      nodes_.push_back(node);
      by_reference_.try_emplace(node.attribute("valueReference").as_uint(), node);
    }
  }
  const std::vector<Node>& all() const { return nodes_; }
  Node numbered(unsigned number) const {
    if (number >= 1 && number <= nodes_.size()) return nodes_[number - 1];
    throw Misuse(fmt::format("modelDescription.xml: there is no variable number {}", number));
  }
  Node referenced(unsigned reference) const {
    const auto found = by_reference_.find(reference);
    if (found != by_reference_.end()) return found->second;
    throw Misuse(fmt::format("modelDescription.xml: there is no variable with valueReference {}", reference));
  }
  // The element that holds type, unit and start: a child in version 2, the variable itself in version 3.
  Node typed(const Node& variable) const {
    if (version_ == 3) return variable;
    for (const Node& child : variable.children()) {
      const std::string_view name = child.name();
      if (name == "Real" || name == "Integer" || name == "Boolean" || name == "Enumeration" || name == "String") {
        return child;
      }
    }
    return {};
  }
  std::string attribute(const Node& variable, const char* name) const {
    const Node own = typed(variable);
    if (own.attribute(name)) return text(own, name);
    const auto type = types_.find(text(own, "declaredType"));
    if (type == types_.end()) return "";
    return version_ == 3 ? text(type->second, name) : text(type->second.first_child(), name);
  }
  // Whether a number can be given for it; its type.
  bool isNumber(const Node& variable, FmuType& type) const {
    const std::string_view name = typed(variable).name();
    const bool real = name == "Real" || name == "Float64", integer = name == "Integer" || name == "Int32";
    type = real ? FmuType::kReal : integer ? FmuType::kInteger : FmuType::kBoolean;
    return real || integer || name == "Boolean";
  }
  FmuVariable read(const Node& node) const {
    FmuVariable v;
    // Names become names of columns and options.
    for (const char letter : text(node, "name")) {
      if (letter != ' ' && letter != '"') v.name += letter == ',' ? '.' : letter == '=' || letter == ';' ? '_' : letter;
    }
    v.meaning = text(node, "description");
    v.reference = node.attribute("valueReference").as_uint();
    isNumber(node, v.type);
    v.unit = attribute(node, "unit");
    v.start = attribute(node, "start");
    const auto number = [&](const char* name, double& to) {
      const std::string given = attribute(node, name);
      if (!given.empty()) to = std::strtod(given.c_str(), nullptr);
    };
    number("min", v.min);
    number("max", v.max);
    number("nominal", v.nominal);
    v.nominal = v.nominal < 0 ? -v.nominal : v.nominal;
    if (!(v.nominal > 0)) v.nominal = 1;
    return v;
  }

  // A variable, or the elements of an array row by row.
  std::vector<FmuVariable> elements(const Node& node) const {
    const FmuVariable whole = read(node);
    const std::vector<std::size_t> sizes = sizesOf(node);
    if (sizes.empty()) return {whole};
    const std::vector<std::string> starts = startsIn(whole.start);
    std::vector<FmuVariable> all(countOf(sizes), whole);
    if (starts.size() > 1 && starts.size() != all.size()) {
      throw Misuse(fmt::format("modelDescription.xml: {} has {} elements and {} start values", whole.name, all.size(),
                               starts.size()));
    }
    std::vector<std::size_t> index(sizes.size(), 1);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].name += fmt::format("[{}]", fmt::join(index, "."));
      all[i].element = i;
      all[i].count = all.size();
      if (!starts.empty()) all[i].start = starts[starts.size() == 1 ? 0 : i];
      for (std::size_t k = sizes.size(); k-- > 0 && ++index[k] > sizes[k];) index[k] = 1;
    }
    return all;
  }
  std::size_t count(const Node& node) const { return countOf(sizesOf(node)); }

 private:
  // The sizes of an array; none for a number. A size is a number or a structural parameter, which keeps its start.
  std::vector<std::size_t> sizesOf(const Node& node) const {
    std::vector<std::size_t> sizes;
    std::size_t all = 1;
    for (const Node& dimension : node.children("Dimension")) {
      const auto parameter = dimension.attribute("valueReference");
      const std::string given = text(parameter ? referenced(parameter.as_uint()) : dimension, "start");
      const bool whole = !given.empty() && given.size() < 9 && given.find_first_not_of("0123456789") == given.npos;
      sizes.push_back(whole ? std::stoul(given) : 0);
      all *= sizes.back();
      if (sizes.back() == 0 || all > kMostElements) {
        throw Misuse(fmt::format(
            "modelDescription.xml: {}: a dimension has start = '{}'; arrays of 1 to {} elements are possible",
            text(node, "name"), given, kMostElements));
      }
    }
    return sizes;
  }
  static std::size_t countOf(const std::vector<std::size_t>& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
  }

  int version_;
  std::vector<Node> nodes_;
  std::map<unsigned, Node> by_reference_;
  std::map<std::string, Node> types_;
};

int versionOf(const Node& root) {
  const std::string version = text(root, "fmiVersion");
  if (version == "2.0") return 2;
  if (version == "3.0") return 3;
  throw Misuse(fmt::format("fmiVersion = '{}': 2.0 and 3.0 are possible", version));
}

void readModel(const Node& root, FmuDescription& fmu) {
  const Node model = root.child("ModelExchange");
  if (!model) throw Misuse("it is for co-simulation only: Model Exchange is expected");
  if (flag(model, "needsExecutionTool")) throw Misuse("it needs the tool that has written it (needsExecutionTool)");
  fmu.name = text(root, "modelName");
  fmu.token = text(root, fmu.version == 2 ? "guid" : "instantiationToken");
  fmu.identifier = text(model, "modelIdentifier");
  fmu.once_per_process = flag(model, "canBeInstantiatedOnlyOncePerProcess");
  fmu.directional_derivatives =
      flag(model, fmu.version == 2 ? "providesDirectionalDerivative" : "providesDirectionalDerivatives");
  fmu.states_kept = flag(model, fmu.version == 2 ? "canGetAndSetFMUstate" : "canGetAndSetFMUState");
  fmu.steps_completed =
      fmu.version == 2 ? !flag(model, "completedIntegratorStepNotNeeded") : flag(model, "needsCompletedIntegratorStep");
  for (const Node& file : model.child("SourceFiles").children("File")) fmu.sources.push_back(text(file, "name"));
  const Node experiment = root.child("DefaultExperiment");
  fmu.start = experiment.attribute("startTime").as_double(0);
  fmu.stop = experiment.attribute("stopTime").as_double(fmu.start + 1);
}

// States in the order of ModelStructure.
void readStates(const Node& root, const Variables& variables, FmuDescription& fmu) {
  const Node structure = root.child("ModelStructure");
  std::vector<Node> derivatives;
  if (fmu.version == 2) {
    fmu.indicators = root.attribute("numberOfEventIndicators").as_uint();
    for (const Node& unknown : structure.child("Derivatives").children("Unknown")) {
      derivatives.push_back(variables.numbered(unknown.attribute("index").as_uint()));
    }
  } else {
    for (const Node& child : structure.children("EventIndicator")) {
      fmu.indicators += variables.count(variables.referenced(child.attribute("valueReference").as_uint()));
    }
    for (const Node& unknown : structure.children("ContinuousStateDerivative")) {
      derivatives.push_back(variables.referenced(unknown.attribute("valueReference").as_uint()));
    }
  }
  for (const Node& derivative : derivatives) {
    const auto of = variables.typed(derivative).attribute("derivative").as_uint();
    if (of == 0 && !variables.typed(derivative).attribute("derivative")) {
      throw Misuse(fmt::format("modelDescription.xml: {} has no attribute derivative", text(derivative, "name")));
    }
    const Node state = fmu.version == 2 ? variables.numbered(of) : variables.referenced(of);
    const std::vector<FmuVariable> elements = variables.elements(state);
    if (variables.count(derivative) != elements.size()) {
      throw Misuse(fmt::format("modelDescription.xml: the state {} has {} elements, and its derivative {} has {}",
                               text(state, "name"), elements.size(), text(derivative, "name"),
                               variables.count(derivative)));
    }
    fmu.states.insert(fmu.states.end(), elements.begin(), elements.end());
    fmu.derivatives.resize(fmu.states.size(), derivative.attribute("valueReference").as_uint());
  }
  if (fmu.states.empty()) throw Misuse("it has no continuous states: there is nothing to integrate");
}

void requireNumericStart(const FmuVariable& v) {
  char* end = nullptr;
  std::strtod(v.start.c_str(), &end);
  const bool truth = v.type == FmuType::kBoolean && (v.start == "true" || v.start == "false");
  if (truth || *end == 0) return;
  throw Misuse(fmt::format("modelDescription.xml: {} has the start value '{}': a number is expected", v.name, v.start));
}

void readOthers(const Variables& variables, FmuDescription& fmu) {
  std::map<unsigned, bool> is_state;
  for (const auto& state : fmu.states) is_state[state.reference] = true;
  for (const Node& node : variables.all()) {
    FmuType type = FmuType::kReal;
    if (!variables.isNumber(node, type)) continue;
    const std::string causality = text(node, "causality"), initial = text(node, "initial");
    const bool state = is_state.contains(node.attribute("valueReference").as_uint());
    const bool exact = initial.empty() || initial == "exact";
    const bool can_be_set = (causality == "parameter" || causality == "input" || (state && exact)) &&
                            !variables.attribute(node, "start").empty();
    const bool output = causality == "output" && type == FmuType::kReal && !state;
    if (!can_be_set && !output) continue;
    for (FmuVariable& v : variables.elements(node)) {
      v.input = causality == "input" && type == FmuType::kReal;
      if (can_be_set) requireNumericStart(v);
      (can_be_set ? fmu.settable : fmu.outputs).push_back(std::move(v));
    }
  }
}

}  // namespace

FmuDescription readDescription(const std::filesystem::path& xml) {
  pugi::xml_document document;
  const auto result = document.load_file(xml.c_str());
  if (!result) {
    throw Misuse(fmt::format("modelDescription.xml: {} (at byte {})", result.description(), result.offset));
  }
  const Node root = document.child("fmiModelDescription");
  if (!root) throw Misuse("modelDescription.xml: it has no element fmiModelDescription");
  FmuDescription fmu;
  fmu.version = versionOf(root);
  readModel(root, fmu);
  const Variables variables(root, fmu.version);
  readStates(root, variables, fmu);
  readOthers(variables, fmu);
  return fmu;
}

void readBuildDescription(const std::filesystem::path& sources, FmuDescription& fmu) {
  pugi::xml_document document;
  if (!document.load_file((sources / "buildDescription.xml").c_str())) return;
  for (const Node& build : document.child("fmiBuildDescription").children("BuildConfiguration")) {
    if (text(build, "modelIdentifier") != fmu.identifier) continue;
    for (const Node& set : build.children("SourceFileSet")) {
      for (const Node& file : set.children("SourceFile")) fmu.sources.push_back(text(file, "name"));
      for (const Node& definition : set.children("PreprocessorDefinition")) {
        const std::string value = text(definition, "value");
        fmu.definitions.push_back(text(definition, "name") + (value.empty() ? "" : "=" + value));
      }
    }
  }
}

std::vector<int> velocitiesOf(const FmuDescription& fmu) {
  const std::size_t n = fmu.states.size();
  std::map<std::pair<unsigned, std::size_t>, std::size_t> place;  // of a state, by its reference and element
  for (std::size_t v = 0; v < n; ++v) place.try_emplace({fmu.states[v].reference, fmu.states[v].element}, v);
  std::vector<int> velocity(n, -1);
  std::vector<bool> taken(n, false);
  for (std::size_t q = 0; q < n; ++q) {
    const auto found = place.find({fmu.derivatives[q], fmu.states[q].element});
    if (found == place.end() || taken[q]) continue;
    const std::size_t v = found->second;
    if (v == q || taken[v]) continue;
    velocity[q] = static_cast<int>(v);
    taken[q] = taken[v] = true;
  }
  return velocity;
}

}  // namespace irk::own
