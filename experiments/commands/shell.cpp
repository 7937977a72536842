#include "experiments/commands/shell.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/base/text.h"
#include "experiments/base/split.h"
#include "experiments/base/streams.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/study/builtin_studies.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

using Words = std::vector<std::string>;

// Methods with more stages are not offered for completion.
constexpr Index kCompletedStages = 9;

Words scenes() {
  Words ids;
  for (const auto& scene : sceneCatalogue()) ids.push_back(scene.id);
  return ids;
}

Words methods() {
  Words ids;
  for (const auto& family : familyCatalogue()) {
    for (Index s = family.min_stages; s <= kCompletedStages; ++s) ids.push_back(family.id + '_' + std::to_string(s));
  }
  for (const auto& peer : peerCatalogue()) ids.push_back(peer.id);
  return ids;
}

Words studies() {
  Words ids;
  for (const auto& study : builtinStudies()) ids.emplace_back(study.id);
  return ids;
}

// The words listed in a type such as "TEXT:{keep,remake}".
Words listed(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return split(std::string_view(type).substr(open + 1, close - open - 1), ',');
}

// The name of an option as the user writes it, or of an argument.
std::string nameOf(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name();
  return option.get_lnames().empty() ? '-' + option.get_snames().front() : "--" + option.get_lnames().front();
}

/// The values that an option or argument takes.
struct Values {
  Words words;
  bool files = false;  ///< file names are offered as well
};

Values valuesOf(const CLI::Option& option) {
  static const std::map<std::string, Values> named{
      {"scene", {scenes(), true}},
      {"scenes", {scenes(), true}},
      {"--method", {methods(), true}},
      {"method", {methods(), true}},
      {"methods", {methods(), true}},
      {"study", {studies(), true}},
      {"--study", {studies(), true}},
      {"shell", {{"bash", "fish", "zsh"}}},
      {"kind", {{"scene", "study"}}},
      {"what", {{"analyses", "columns", "constants", "methods", "numbers", "scenes", "strategies", "studies"}}},
  };
  const std::string name = nameOf(option);
  const auto found = named.find(name);
  if (found != named.end()) return found->second;
  for (const auto& field : specFields()) {
    if (field.kind != FieldKind::kAxis || optionName(field.name) != name) continue;
    Values ids;
    for (const auto& choice : field.choices()) ids.words.push_back(choice.id);
    return ids;
  }
  const std::string type = option.get_type_name();
  return {listed(type), type == "TEXT" || type == "FILE"};
}

struct Parts {
  std::vector<const CLI::Option*> arguments, options;
};

Parts partsOf(const CLI::App& verb) {
  Parts parts;
  for (const CLI::Option* option : verb.get_options({})) {
    (option->get_positional() ? parts.arguments : parts.options).push_back(option);
  }
  return parts;
}

// The completion asks the command as the user has typed it. Bash does not expand its tilde.
constexpr std::string_view kBash = R"(_irk() {
  local program=${COMP_WORDS[0]/#\~/$HOME}
  local words=$("$program" complete "${COMP_WORDS[@]:1:$COMP_CWORD}" 2>/dev/null | cut -f1)
  COMPREPLY=( $(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}") )
}
complete -o default -F _irk irk ./irk
)";
constexpr std::string_view kZsh = R"((( $+functions[compdef] )) || { autoload -Uz compinit && compinit; }
autoload -Uz bashcompinit && bashcompinit
)";
constexpr std::string_view kFish = R"(function __irk
  set -l typed (commandline -ct)
  set -l words (commandline -opc) "$typed"
  $words[1] complete $words[2..-1] 2>/dev/null; and __fish_complete_path "$typed"
end
complete -c irk -f -a '(__irk)'
)";

// A word and, behind a tab, the first sentence of its description.
void printWord(const std::string& word, const std::string& description, std::ostream& out) {
  const auto end = std::min(description.find(". "), description.find(" ["));
  fmt::print(out, "{}\t{}\n", word, description.substr(0, end));
}

// Returns 0 if a file may stand there as well, else 1.
int printValues(const std::vector<const CLI::Option*>& options, std::ostream& out) {
  bool files = false;
  for (const CLI::Option* option : options) {
    const Values values = valuesOf(*option);
    files = files || values.files;
    for (const auto& word : values.words) printWord(word, "", out);
  }
  return files ? 0 : kFailedStatus;
}

}  // namespace

std::string examplesOf(const std::string& verb) {
  static const std::map<std::string, std::string> examples{
      {"solve",
       "  irk solve slider_crank --method radau_iia_5 --tol 1e-8\n"
       "  irk solve van_der_pol --method radau_iia_9 --tol 1e-6 --plot vdp\n"
       "  irk solve bouncing_mass --out run.csv --points 500\n"
       "  irk solve kepler --set e=0.1,0.3 --tol 1e-4,1e-6         all combinations, a line per run"},
      {"run",
       "  irk run order --quick\n  irk run my_study.toml --jobs 4\n"
       "  irk run work_precision --peers radau@libhairer.so,rodas@libhairer.so"},
      {"paper", "  irk paper --quick"},
      {"new", "  irk new scene four_bar.cpp\n  irk new study four_bar.cpp"},
      {"ensemble",
       "  irk ensemble van_der_pol --set eps=1e-6..1e-3:1000:log --tol 1e-6 --out vdp.csv\n"
       "  irk ensemble robertson --start y2=0,1e-6 --start y1=0.5..1:50   all combinations, a row per run"},
      {"list", "  irk list scenes\n  irk list scenes kepler\n  irk list methods"},
      {"status", "  irk status order"},
      {"plot", "  irk plot order"},
      {"slurm", "  irk slurm order -n 16 > order.sh"},
      {"merge", "  irk merge shard1/order shard2/order --results joined"},
      {"publish", "  irk publish plots/results"},
      {"query", "  irk query order \"select method, max(steps_accepted) from runs group by method\""},
      {"export", "  irk export order order.sqlite"},
      {"compare", "  irk compare results other_results"},
      {"reference", "  irk reference kepler --check"},
      {"tableau show", "  irk tableau show radau_iia_3 --digits 30"},
      {"tableau check", "  irk tableau check my_method.txt"},
      {"tableau export", "  irk tableau export radau_iia_3 > my_method.txt"},
      {"tableau plot", "  irk tableau plot gauss_3 radau_iia_3 --out regions"},
      {"completion", "  source <(irk completion bash)\n  irk completion fish > ~/.config/fish/completions/irk.fish"},
  };
  const auto found = examples.find(verb);
  return found == examples.end() ? "" : found->second;
}

void printCompletion(const std::string& shell, std::ostream& out) {
  const Words shells{"bash", "zsh", "fish"};
  if (std::find(shells.begin(), shells.end(), shell) == shells.end()) throw Misuse(unknownName("shell", shell, shells));
  if (shell == "zsh") out << kZsh;
  out << (shell == "fish" ? kFish : kBash);
}

int printNextWords(const CLI::App& program, std::vector<std::string> words, std::ostream& out) {
  if (words.empty()) words.emplace_back();
  const CLI::App* verb = &program;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    for (const CLI::App* inner : verb->get_subcommands({})) {
      if (inner->get_name() == words[i]) verb = inner;
    }
  }
  const Parts parts = partsOf(*verb);
  const std::string before = words.size() > 1 ? words[words.size() - 2] : "";
  for (const CLI::Option* option : parts.options) {
    if (nameOf(*option) == before && option->get_items_expected_max() > 0) return printValues({option}, out);
  }
  if (words.back().starts_with('-')) {
    for (const CLI::Option* option : parts.options) printWord(nameOf(*option), option->get_description(), out);
    return kFailedStatus;
  }
  for (const CLI::App* inner : verb->get_subcommands({})) printWord(inner->get_name(), inner->get_description(), out);
  return printValues(parts.arguments, out);
}

}  // namespace irk
