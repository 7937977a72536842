#include "experiments/commands/cli.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <ostream>

#include "experiments/base/failure.h"
#include "experiments/commands/arguments.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/shell.h"
#include "experiments/own/crash.h"
#include "experiments/own/files.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/own_files.h"
#include "experiments/tables/licences.h"
#include "irk/registration.h"

namespace irk {
namespace {

using Action = std::function<int(Streams)>;

constexpr Range kJobs = Range::integers(0, 1024), kDigits = Range::integers(1, 75);

/// The verbs, their options and the function that each verb calls.
class Program {
 public:
  Program() : app_("Benchmark suite for implicit Runge-Kutta schemes of any order", "irk") {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", versionText());
    addPaper();
    addRun();
    addSolve();
    addEnsemble();
    addNew();
    addList();
    addTableau();
    addPlots();
    addMerging();
    addTables();
    addReference();
    addShell();
  }

  int run(std::vector<std::string> arguments, Streams streams) {
    if (!arguments.empty() && arguments.front() == "complete") {
      return printNextWords(app_, {arguments.begin() + 1, arguments.end()}, streams.out);
    }
    refuseEmpty(arguments);
    replaceHelpVerb(arguments);
    requireKnownVerb(app_, arguments, 0);
    requireKnownOption(arguments);
    const std::string help = helpOf(arguments);
    std::reverse(arguments.begin(), arguments.end());  // CLI11 wants them reversed
    try {
      app_.parse(arguments);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app_.exit(error, streams.out, streams.err);  // --help, --version
      throw Misuse(std::string(error.what()) + "; see " + help);
    }
    return action_(streams);
  }

 private:
  CLI::App* verb(CLI::App& parent, const std::string& name, const std::string& meaning, Action action) {
    auto* sub = parent.add_subcommand(name, meaning);
    const std::string examples = examplesOf(&parent == &app_ ? name : parent.get_name() + ' ' + name);
    if (!examples.empty()) sub->footer("Examples:\n" + examples);
    sub->final_callback([this, action = std::move(action)] { action_ = action; });
    return sub;
  }

  void addRunnerOptions(CLI::App& sub) {
    sub.add_flag("--fresh", fresh_, "Make finished runs again.");
    sub.add_flag("--wait", wait_, "Wait where another process writes to the same study.");
    sub.add_option("--stale", stale_, "What is done with runs that other code has made: keep | remake.")
        ->check(CLI::IsMember({"keep", "remake"}))
        ->capture_default_str();
    addJobs(sub, "Threads; 0 = one per processor.");
    const auto cores = "Cores on which runs are timed at once; 0 = as many as do not disturb each other.";
    sub.add_option("--timing-cores", timing_cores_, numberHelp(cores, kJobs, "0"))->type_name("INTEGER");
    addTimes(sub);
    addQuick(sub);
    addResults(sub);
  }
  void addJobs(CLI::App& sub, std::string_view meaning) {
    sub.add_option("--jobs", jobs_, numberHelp(meaning, kJobs, "0"))->type_name("INTEGER");
  }
  void addTimes(CLI::App& sub) {
    sub.add_option("--times", times_, "Which times count: all | here, those measured on this processor.")
        ->check(CLI::IsMember({"all", "here"}))
        ->capture_default_str();
  }
  void addResults(CLI::App& sub) {
    sub.add_option("--results", results_, "The folder of the results.")->capture_default_str();
  }
  void addQuick(CLI::App& sub) {
    sub.add_flag("--quick", quick_, "The small variant of each study, in RESULTS/quick.");
  }
  // Full and quick results are kept in separate trees.
  std::string results() const { return quick_ ? results_ + "/quick" : results_; }
  StudyVariant variant() const { return quick_ ? StudyVariant::kQuick : StudyVariant::kFull; }

  store::StoreOptions storeOptions() const {
    store::StoreOptions options;
    if (fresh_) options.finished = store::FinishedRuns::kRunAgain;
    if (stale_ == "remake") options.stale = store::StaleRows::kRemake;
    if (times_ == "here") options.times = store::Times::kHere;
    if (wait_) options.if_locked = store::IfLocked::kWait;
    return options;
  }

  RunOptions runOptions() {
    RunOptions options;
    options.study = study_;
    options.variant = variant();
    options.peers = peers_;
    options.runner.results = results();
    options.runner.jobs = integer("jobs", jobs_, kJobs);
    options.runner.timing_cores = integer("timing-cores", timing_cores_, kJobs);
    options.runner.store = storeOptions();
    if (!shard_.empty()) options.runner.shard = parseShard(shard_);
    return options;
  }

  void addPaper() {
    addRunnerOptions(*verb(app_, "paper", "every study of the paper, figures and the report page",
                           [this](Streams s) { return paperCommand(runOptions(), s); }));
  }

  void addRun() {
    auto* sub = verb(app_, "run", "one study", [this](Streams s) { return runCommand(runOptions(), s); });
    sub->add_option("study", study_, "id or TOML file")->required();
    sub->add_option("--shard", shard_,
                    "Make part i of n only: i/n, or in an array job auto/n; see merge. [default: all]");
    addPeersOption(*sub, peers_);
    addRunnerOptions(*sub);
    auto* slurm = verb(app_, "slurm", "print a job script of Slurm: a study in n parts", [this](Streams s) {
      return slurmCommand({study_, shard_, variant(), results_, std::max(1, integer("jobs", jobs_, kJobs))}, s);
    });
    slurm->add_option("study", study_, "id or TOML file")->required();
    slurm->add_option("-n", shard_, "The number of parts, at most one per series.")->required();
    addJobs(*slurm, "Threads of each part; 0 = 1.");
    addQuick(*slurm);
    addResults(*slurm);
    auto* status = verb(app_, "status", "how far a study is: planned, finished, failed, stale, foreign, time needed",
                        [this](Streams s) { return statusCommand(runOptions(), s); });
    status->add_option("study", study_, "id or TOML file")->required();
    status->add_option("--shard", shard_, "Count part i of n only: i/n or auto/n. [default: all]");
    addPeersOption(*status, peers_);
    addQuick(*status);
    addResults(*status);
  }

  void addSolve() {
    auto* sub =
        verb(app_, "solve", "one integration", [this](Streams s) { return takeFields(), solveCommand(solve_, s); });
    addSolveOptions(*sub, solve_);
    addLoad(*sub);
    for (const auto& field : specFields()) addField(*sub, field, solve_, fields_);
    addDigits(*sub, fields_["scalar"]);
  }

  void addEnsemble() {
    auto* sub = verb(app_, "ensemble", "one scene over a grid of parameters or starts, a row per run",
                     [this](Streams s) { return takeFields(), ensembleCommand(ensemble_, s); });
    addEnsembleOptions(*sub, solve_, ensemble_);
    addLoad(*sub);
    addJobs(*sub, "Threads; 0 = one per processor.");
    for (const auto& field : specFields()) addField(*sub, field, solve_, fields_);
  }

  void addLoad(CLI::App& sub) {
    sub.add_option("--load", load_, "Your scenes, integrators, strategies: FILE.cpp or LIBRARY.so.")
        ->take_all()
        ->expected(1)
        ->type_name("FILE");
  }
  void loadFiles() const { std::for_each(load_.begin(), load_.end(), loadOwn); }

  void takeFields() {
    loadFiles();
    for (const auto& [field, value] : fields_) {
      if (!value.empty()) solve_.fields.emplace_back(field, value);
    }
    ensemble_.run = solve_;
    ensemble_.jobs = integer("jobs", jobs_, kJobs);
  }

  void addNew() {
    auto* sub = verb(app_, "new", "write a first file", [this](Streams s) { return newCommand(what_, out_, s); });
    sub->add_option("kind", what_, "scene or study")->required();
    sub->add_option("file", out_, "the scene's file to write, such as four_bar.cpp; for a study the scene")->required();
  }

  void addList() {
    auto* sub = verb(app_, "list", "scenes, methods, studies and options with their values", [this](Streams s) {
      loadFiles();
      return listCommand(what_, scenes_, s);
    });
    addLoad(*sub);
    sub->add_option("what", what_, "scenes, methods, studies, analyses, strategies, numbers, constants or columns");
    sub->add_option("scene", scenes_.scene, "one scene, with its parameters");
    sub->add_option("--collection", scenes_.collection, "The scenes of: ivp, multibody, switching or probes.");
    sub->add_flag("--long", scenes_.long_form, "Each scene with its kind, unknowns, source and parameters.");
    sub->add_flag("--json", scenes_.json, "Print the scenes as a JSON array.");
  }

  void addTableau() {
    auto* tableau = app_.add_subcommand("tableau", "coefficients of a method");
    tableau->require_subcommand(1);
    auto* show = verb(*tableau, "show", "print it",
                      [this](Streams s) { return tableauShow(method_, integer("digits", digits_, kDigits), s); });
    show->add_option("--digits", digits_, numberHelp("Significant digits.", kDigits, "17"))->type_name("INTEGER");
    auto* check = verb(*tableau, "check", "does it keep what it declares, and what is it?",
                       [this](Streams s) { return tableauCheck(method_, s); });
    auto* write = verb(*tableau, "export", "as a file or as source text",
                       [this](Streams s) { return tableauExport(method_, format_, s); });
    write->add_option("--format", format_, "file (a tableau file), latex, numpy or c.")->capture_default_str();
    for (auto* sub : {show, check, write}) {
      sub->add_option("method", method_, "id or file")->required();
    }
    auto* plot = verb(*tableau, "plot", "regions of stability and order stars",
                      [this](Streams s) { return tableauPlot(methods_, out_, s); });
    plot->add_option("methods", methods_, "ids or files")->required();
    plot->add_option("--out", out_, "Draw to FILE.svg and FILE.png, with the numbers in FILE.csv.")
        ->capture_default_str();
    auto* table = verb(*tableau, "table", "properties of all families, 1 to 20 stages",
                       [this](Streams s) { return tableauTable(results_, s); });
    addResults(*table);
  }

  void addPlots() {
    auto* plot = verb(app_, "plot", "the figures of a study",
                      [this](Streams s) { return plotCommand(study_, variant(), results(), s); });
    plot->add_option("study", study_, "id or TOML file")->required();
    addQuick(*plot);
    addResults(*plot);
    auto* report = verb(app_, "report", "all figures, the report page and the explorer",
                        [this](Streams s) { return reportCommand(results(), s); });
    addQuick(*report);
    addResults(*report);
    auto* publish =
        verb(app_, "publish", "answers, figures and small tables of a full run, for readers", [this](Streams s) {
          return publishCommand({out_, results(), variant()}, s);
        });
    publish->add_option("folder", out_, "a new folder, or that of a former publication: plots/results")->required();
    addQuick(*publish);
    addResults(*publish);
    auto* judged = verb(app_, "claims", "the paper's claims and what the results say about them",
                        [this](Streams s) { return claimsCommand(results(), sensitivity_, s); });
    judged->add_flag("--sensitivity", sensitivity_, "Intervals, thresholds halved and doubled, each scene left out.");
    addQuick(*judged);
    addResults(*judged);
  }

  void addMerging() {
    auto* merge = verb(app_, "merge", "join the results of shards", [this](Streams s) {
      return mergeCommand({folders_, study_, results(), variant(), partial_, storeOptions()}, s);
    });
    merge->add_option("folders", folders_, "folders of one study, or of its shards")->required();
    merge->add_flag("--partial", partial_, "Merge although runs are missing, or disagree.");
    merge->add_flag("--wait", wait_, "Wait where another process writes to the same study.");
    addTimes(*merge);
    addQuick(*merge);
    merge->add_option("--study", study_, "The study's id or TOML file, if the tables' own is not built in.");
    addResults(*merge);
    auto* compare = verb(app_, "compare", "what differs between two studies, trees of results or publications",
                         [this](Streams s) { return compareCommand(compare_, s); });
    addCompareOptions(*compare, compare_);
  }

  void addTables() {
    const auto options = [this] {
      tables_.study = study_;
      tables_.results = results();
      tables_.variant = variant();
      return tables_;
    };
    auto* query = verb(app_, "query", "a question in SQL to the tables of a study",
                       [options](Streams s) { return queryCommand(options(), s); });
    auto* write = verb(app_, "export", "the tables of a study as a database of SQLite",
                       [options](Streams s) { return exportCommand(options(), s); });
    for (auto* sub : {query, write}) {
      sub->add_option("study", study_, "id or TOML file")->required();
      addQuick(*sub);
      addResults(*sub);
    }
    query->add_option("sql", tables_.sql, "a select statement; table runs is runs.csv, and so on")->required();
    query->add_flag("--json", tables_.json, "Print rows as JSON objects, one per line.");
    write->add_option("file", tables_.file, "the database, such as order.sqlite")->required();
  }

  void addReference() {
    auto* sub =
        verb(app_, "reference", "reference values in 50 digits: two methods, two tolerances each", [this](Streams s) {
          reference_.jobs = integer("jobs", jobs_, kJobs);
          return referenceCommand(reference_, s);
        });
    sub->add_option("scenes", reference_.scenes, "see: irk list scenes; all if left out");
    addJobs(*sub, "Threads; 0 = one per processor.");
    sub->add_flag("--check", reference_.check, "Write nothing; status 1 if a file disagrees with what is computed.");
    sub->add_option("--out", reference_.out, "The folder of the files.");
    sub->add_flag("--into-sources", reference_.into_sources,
                  "Write to problems/reference of the sources instead of --out.");
  }

  void addShell() {
    auto* completion = verb(app_, "completion", "a script for the shell that completes verbs, options and their values",
                            [this](Streams s) { return printCompletion(shell_, s.out), 0; });
    completion->add_option("shell", shell_, "bash, zsh or fish")->required();
  }

  CLI::App app_;
  Action action_;
  bool quick_ = false, fresh_ = false, wait_ = false, partial_ = false, sensitivity_ = false;
  std::string stale_ = "keep", times_ = "all", jobs_ = "0", timing_cores_ = "0", digits_ = "17", results_ = "results";
  std::string study_, shard_, what_, method_, shell_, out_ = "stability", format_ = "file";
  std::vector<std::string> folders_, methods_, load_, peers_;
  std::map<std::string, std::string> fields_;
  SolveOptions solve_;
  EnsembleArguments ensemble_;
  CompareOptions compare_;
  TableOptions tables_;
  SceneList scenes_;
  ReferenceOptions reference_;
};

}  // namespace

int runProgram(const std::vector<std::string>& arguments, Streams streams) {
  int status = 0;
  const own::ReportTo report(streams.err);
  const own::ExitGuard guard;
  try {
    runRegistrations("");
    status = Program().run(arguments, streams);
  } catch (...) {
    status = reportException(streams.err);
  }
  if (streams.out.flush()) return status;
  if (status == 0) printErrorLine(streams.err, "the output cannot be written: is the disk full?");
  return status == 0 ? kFailedStatus : status;
}

}  // namespace irk
