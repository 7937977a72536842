#include "experiments/commands/arguments.h"

#include <algorithm>
#include <regex>

#include "core/base/number_text.h"
#include "core/base/text.h"
#include "irk/misuse.h"

namespace irk {

void refuseEmpty(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument.empty()) {
      throw Misuse(i == 0 ? "an empty argument: a verb is expected, see irk --help"
                          : "an empty value after '" + arguments[i - 1] + "': a value is expected");
    }
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1) {
      throw Misuse("an empty value in '" + argument + "': a value is expected");
    }
  }
}

void replaceHelpVerb(std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front() != "help") return;
  arguments.erase(arguments.begin());
  arguments.emplace_back("--help");
}

namespace {

// What follows a verb: a misspelt option gets the nearest name. CLI11 would only say that it did not expect it.
void requireKnownOptionsOf(const CLI::App& verb, const std::vector<std::string>& arguments, std::size_t first) {
  const CLI::App* const parent = verb.get_parent();
  const std::string name_of_verb =
      "irk " + (parent->get_parent() ? parent->get_name() + ' ' : std::string()) + verb.get_name();
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options({})) {
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (std::size_t i = first; i < arguments.size(); ++i) {
    const std::string name = arguments[i].substr(0, arguments[i].find('='));
    if (!name.starts_with("--") || name == "--" || std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw Misuse("unknown option '" + name + "' of " + name_of_verb + "; did you mean '" + nearestName(name, known) +
                 "'? All options: " + name_of_verb + " --help");
  }
}

}  // namespace

void requireKnownVerb(CLI::App& parent, const std::vector<std::string>& arguments, std::size_t i) {
  const auto verbs = parent.get_subcommands({});
  if (verbs.empty()) return requireKnownOptionsOf(parent, arguments, i);
  if (i == arguments.size() || arguments[i].starts_with('-')) return;
  std::vector<std::string> known;
  for (auto* sub : verbs) {
    known.push_back(sub->get_name());
    if (known.back() == arguments[i]) return requireKnownVerb(*sub, arguments, i + 1);
  }
  throw Misuse(unknownName("verb", arguments[i], known));
}

void requireKnownOption(const std::vector<std::string>& arguments) {
  const std::vector<std::string> known{"--help", "-h", "--version"};
  if (arguments.empty() || !arguments.front().starts_with('-')) return;
  if (std::find(known.begin(), known.end(), arguments.front()) == known.end()) {
    throw Misuse(unknownName("option before a verb", arguments.front(), known));
  }
}

std::string helpOf(const std::vector<std::string>& arguments) {
  const bool verb = !arguments.empty() && !arguments.front().starts_with('-');
  return verb ? "irk " + arguments.front() + " --help" : "irk --help";
}

const char* valueName(FieldKind kind) {
  switch (kind) {
    case FieldKind::kAxis:
      return "ID";
    case FieldKind::kNumber:
      return "NUMBER";
    case FieldKind::kInteger:
      return "INTEGER";
    case FieldKind::kText:
      break;
  }
  return "TEXT";
}

std::string numberHelp(std::string_view meaning, const Range& range, std::string_view value) {
  return std::string(meaning) + " [" + range.text() + "; default " + std::string(value) + "]";
}

int integer(std::string_view name, std::string_view text, const Range& range) {
  return static_cast<int>(parseInteger(name, text, range));
}

void addPeersOption(CLI::App& sub, std::vector<std::string>& peers) {
  sub.add_option("--peers", peers,
                 "Your solvers, which run where ida_bdf (index 2) or cvode_bdf does: PATH.so, CODE@PATH.so, PATH.cpp. "
                 "Name them again with the next run of the study: its tables hold what was asked for last.")
      ->delimiter(',')
      ->type_name("LIST");
}

void addSolveOptions(CLI::App& sub, SolveOptions& run) {
  sub.add_option("--tol", run.tol,
                 "Sets both rtol and atol. A list of values, of this or of any option, makes all combinations. [0 < x]")
      ->type_name("NUMBER");
  sub.add_flag("--json", run.json, "Print one JSON object.");
  sub.add_option("--plot", run.plot, "Draw the solution to FILE.svg and FILE.png, in a folder that exists.")
      ->type_name("FILE");
  sub.add_option(
         "--out", run.out,
         "Write the solution over time to FILE.csv or, as JSON lines, to FILE.jsonl: components, outputs, steps, "
         "and a row before and after each located switch. A run that fails leaves what it has computed.")
      ->type_name("FILE");
  sub.add_option(
         "--points", run.points,
         "So many equally spaced times in --out, both ends included [2 .. 1000000; default: the accepted steps]")
      ->type_name("INTEGER");
  sub.add_flag("--bars", run.bars,
               "Adds to each point in --out its error bars, from one more integration of another method.");
}

void addField(CLI::App& sub, const SpecField& field, SolveOptions& run, std::map<std::string, std::string>& fields) {
  const std::string option = optionName(field.name);
  const auto describe = [&](CLI::Option* added, const std::string& remark = "") {
    added->description(remark + helpText(field))->type_name(valueName(field.kind));
    return added;
  };
  if (field.name == "scene") {
    describe(sub.add_option(option, run.scene))->required();
  } else if (field.name == "settings") {
    describe(sub.add_option(option, run.settings))->take_all()->expected(1);
  } else if (field.name == "h") {
    describe(sub.add_option(option, run.step), "Sets h, and control fixed with estimate none unless they are given. ");
  } else if (field.name == "reference") {
    sub.add_flag_callback(option, [&fields] { fields["reference"] = "auto"; })
        ->description("Sets auto. " + helpText(field));
  } else if (field.name == axisName<ErrorBarUse>()) {
    describe(sub.add_option(option, fields[field.name]), "With solve the default is measured. ");
    sub.add_flag_callback("--refine", [&fields] { fields["error_bars"] = "refined"; })
        ->description("Sets error-bar refined: the result of the stricter integration, with the same bar.");
  } else {
    describe(sub.add_option(option, fields[field.name]));
  }
}

void addDigits(CLI::App& sub, std::string& scalar) {
  sub.add_option_function<std::string>(
         "--digits",
         [&scalar](const std::string& digits) { scalar = std::regex_replace(digits, std::regex("(^|,)"), "$1mp"); },
         "Compute in so many decimal digits: short for --scalar mpN. [30 .. 1000]")
      ->excludes(sub.get_option("--scalar"))
      ->type_name("INTEGER");
}

void addEnsembleOptions(CLI::App& sub, SolveOptions& run, EnsembleArguments& ensemble) {
  sub.add_option("--tol", run.tol, "Sets both rtol and atol. [0 < x]")->type_name("NUMBER");
  sub.add_option(
         "--start", ensemble.starts,
         "component=VALUES: a component of u, v or x at the start. VALUES, also of --set: items with ',' between; "
         "A..B:N are N numbers from A to B, A..B:N:log with equal ratios. All combinations are run.")
      ->take_all()
      ->expected(1)
      ->type_name("TEXT");
  sub.add_option("--out", run.out, "Write the rows to FILE.csv instead of standard output.")->type_name("FILE");
  sub.add_flag("--json", run.json, "Print rows as JSON objects, one per line.");
}

void addCompareOptions(CLI::App& sub, CompareOptions& options) {
  sub.add_option("first", options.first, "folder of a study, of results, or of a publication")->required();
  sub.add_option("second", options.second, "another one")->required();
  sub.add_option("--errors", options.errors, "Errors differ from this factor on.")->capture_default_str();
  sub.add_option("--times", options.times, "Ratios of times up to this percentage are noise.")->capture_default_str();
  sub.add_option("--alpha", options.alpha, "How probably noise alone makes a time differ.")->capture_default_str();
  sub.add_option("--counters", options.counters, "Counters differ from this percentage on.")->capture_default_str();
}

}  // namespace irk
