#include "experiments/commands/shell.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/base/text.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/study/builtin_studies.h"
#include "experiments/tables/build_info.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

using Words = std::vector<std::string>;

// Methods with more stages are not offered for completion.
constexpr Index kCompletedStages = 9;

struct Verb {
  std::string name;  // "solve", "tableau show"
  const CLI::App* app;
};

std::vector<Verb> verbsOf(const CLI::App& program) {
  std::vector<Verb> verbs;
  for (const CLI::App* sub : program.get_subcommands({})) {
    const auto inner = sub->get_subcommands({});
    for (const CLI::App* child : inner) verbs.push_back({sub->get_name() + ' ' + child->get_name(), child});
    if (inner.empty()) verbs.push_back({sub->get_name(), sub});
  }
  return verbs;
}

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
  Words words;
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  for (std::size_t begin = open + 1; begin < close;) {
    const std::size_t end = std::min(type.find(',', begin), close);
    words.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

// The name of an option as the user writes it, or of an argument.
std::string nameOf(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name();
  return option.get_lnames().empty() ? '-' + option.get_snames().front() : "--" + option.get_lnames().front();
}

/// The values that an option or argument takes.
struct Values {
  Words words;
  bool files = false;  ///< file names are offered as well, or if there are no words
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
      {"kind", {{"scene"}}},
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

void printBash(const CLI::App& program, std::ostream& out) {
  Words first;
  std::map<std::string, Words> second;
  for (const Verb& verb : verbsOf(program)) {
    const std::size_t blank = verb.name.find(' ');
    const std::string name = verb.name.substr(0, blank);
    if (std::find(first.begin(), first.end(), name) == first.end()) first.push_back(name);
    if (blank != std::string::npos) second[name].push_back(verb.name.substr(blank + 1));
  }
  fmt::print(out, "_irk() {{\n  local words verb=${{COMP_WORDS[1]}} cur=${{COMP_WORDS[COMP_CWORD]}} at=2\n");
  for (const auto& [name, inner] : second) {
    fmt::print(out, "  if [[ $verb == {0} ]]; then verb=\"{0} ${{COMP_WORDS[2]}}\"; at=3; fi\n", name);
  }
  fmt::print(out, "  if (( COMP_CWORD == 1 )); then words='{}'\n", fmt::join(first, " "));
  for (const auto& [name, inner] : second) {
    fmt::print(out, "  elif (( COMP_CWORD == 2 && at == 3 )); then words='{}'\n", fmt::join(inner, " "));
  }
  fmt::print(out, "  else\n    case \"$verb ${{COMP_WORDS[COMP_CWORD - 1]}}\" in\n");
  for (const Verb& verb : verbsOf(program)) {
    for (const CLI::Option* option : partsOf(*verb.app).options) {
      const Words words = valuesOf(*option).words;
      if (words.empty()) continue;
      fmt::print(out, "      '{} {}') words='{}';;\n", verb.name, nameOf(*option), fmt::join(words, " "));
    }
  }
  fmt::print(out, "      *) case \"$verb\" in\n");
  for (const Verb& verb : verbsOf(program)) {
    Words arguments, options;
    const Parts parts = partsOf(*verb.app);
    for (const CLI::Option* option : parts.options) options.push_back(nameOf(*option));
    for (const CLI::Option* argument : parts.arguments) {
      for (auto& word : valuesOf(*argument).words) arguments.push_back(std::move(word));
    }
    fmt::print(out, "        '{}') if [[ $cur == -* ]]; then words='{}'; else words='{}'; fi;;\n", verb.name,
               fmt::join(options, " "), fmt::join(arguments, " "));
  }
  fmt::print(out,
             "      esac;;\n    esac\n  fi\n  COMPREPLY=( $(compgen -W \"$words\" -- \"$cur\") )\n}}\n"
             "complete -o default -F _irk irk ./irk\n");
}

std::string fishQuoted(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'' || text[i] == '\\') text.insert(i++, 1, '\\');
  }
  return '\'' + text + '\'';
}

// The first sentence: shells show one line.
std::string shortened(const std::string& description) {
  return fishQuoted(description.substr(0, std::min(description.find(". "), description.find(" ["))));
}

void printFishOption(const CLI::Option& option, const std::string& when, std::ostream& out) {
  const std::string name = nameOf(option);
  const bool is_long = name.starts_with("--");
  fmt::print(out, "complete -c irk -n '{}' {} {} -d {}", when, is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1),
             shortened(option.get_description()));
  const Values values = valuesOf(option);
  if (option.get_items_expected_max() > 0) out << (values.files ? " -r -F" : " -x");
  if (!values.words.empty()) fmt::print(out, " -a '{}'", fmt::join(values.words, " "));
  out << '\n';
}

void printFish(const CLI::App& program, std::ostream& out) {
  for (const CLI::App* sub : program.get_subcommands({})) {
    fmt::print(out, "complete -c irk -n __fish_use_subcommand -f -a {} -d {}\n", sub->get_name(),
               fishQuoted(sub->get_description()));
  }
  for (const Verb& verb : verbsOf(program)) {
    const std::size_t blank = verb.name.find(' ');
    std::string when = "__fish_seen_subcommand_from " + verb.name.substr(0, blank);
    if (blank != std::string::npos) {
      const std::string inner = verb.name.substr(blank + 1);
      fmt::print(out, "complete -c irk -n '{}; and test (count (commandline -opc)) -eq 2' -f -a {} -d {}\n", when,
                 inner, fishQuoted(verb.app->get_description()));
      when += "; and __fish_seen_subcommand_from " + inner;
    }
    const Parts parts = partsOf(*verb.app);
    bool files = false;
    Words words;
    for (const CLI::Option* argument : parts.arguments) {
      Values values = valuesOf(*argument);
      files = files || values.files;
      words.insert(words.end(), values.words.begin(), values.words.end());
    }
    fmt::print(out, "complete -c irk -n '{}'{} -a '{}'\n", when, files ? "" : " -f", fmt::join(words, " "));
    for (const CLI::Option* option : parts.options) printFishOption(*option, when, out);
  }
}

// Text of roff: no line begins with a control character, and dashes are those of the keyboard.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '-') {
      safe += "\\-";
    } else if (c == '\\') {
      safe += "\\e";
    } else if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) {
      safe += std::string("\\&") + c;
    } else {
      safe += c;
    }
  }
  return safe;
}

void printEntry(const CLI::Option& option, std::ostream& out) {
  std::string type = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  type = type.substr(0, type.find(':'));  // the values follow in the text
  fmt::print(out, ".TP\n\\fB{}\\fR{}\n{}\n", roff(nameOf(option)), roff(type.empty() ? "" : ' ' + type),
             roff(option.get_description()));
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
      {"man", "  irk man > irk.1; man ./irk.1"},
  };
  const auto found = examples.find(verb);
  return found == examples.end() ? "" : found->second;
}

void printCompletion(const CLI::App& program, const std::string& shell, std::ostream& out) {
  const Words shells{"bash", "zsh", "fish"};
  if (std::find(shells.begin(), shells.end(), shell) == shells.end()) throw Misuse(unknownName("shell", shell, shells));
  if (shell == "fish") return printFish(program, out);
  if (shell == "zsh") {
    out << "(( $+functions[compdef] )) || { autoload -Uz compinit && compinit; }\n"
           "autoload -Uz bashcompinit && bashcompinit\n";
  }
  printBash(program, out);
}

void printManual(const CLI::App& program, std::ostream& out) {
  fmt::print(out, ".TH IRK 1 \"\" \"irk {}\"\n.SH NAME\nirk \\- {}\n", buildInfo().version,
             roff(program.get_description()));
  fmt::print(out, ".SH SYNOPSIS\n\\fBirk\\fR \\fIverb\\fR [\\fIarguments\\fR] [\\fIoptions\\fR]\n.SH VERBS\n");
  for (const Verb& verb : verbsOf(program)) {
    const Parts parts = partsOf(*verb.app);
    fmt::print(out, ".SS irk {}", verb.name);
    for (const CLI::Option* argument : parts.arguments) fmt::print(out, " {}", argument->get_name());
    fmt::print(out, "\n{}\n", roff(verb.app->get_description()));
    for (const CLI::Option* argument : parts.arguments) printEntry(*argument, out);
    for (const CLI::Option* option : parts.options) {
      if (nameOf(*option) != "--help") printEntry(*option, out);
    }
    const std::string examples = examplesOf(verb.name);
    if (!examples.empty()) fmt::print(out, ".PP\nExamples:\n.PP\n.nf\n{}\n.fi\n", roff(examples));
  }
  fmt::print(out,
             ".SH EXIT STATUS\n0 success; 1 the run failed; 2 misuse, with one line that says what and where; 130 "
             "interrupted.\n");
}

}  // namespace irk
