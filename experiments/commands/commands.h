// The verbs of the program. Each returns the exit status, 0 for success, 1 for failure, 130 for an interrupt, and
// throws on misuse.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/base/streams.h"
#include "experiments/commands/list_scenes.h"
#include "experiments/reference/library.h"
#include "experiments/runner/runner.h"
#include "experiments/runs/run.h"

namespace irk {

struct SolveOptions {
  std::string scene;
  /// Fields of the spec by name, as the user gave them.
  std::vector<std::pair<std::string, std::string>> fields;
  std::vector<std::string> settings;  ///< name=value
  std::string step, tol;              ///< empty: not given
  std::string plot;                   ///< a file for the figure, in a folder that exists; .svg or .png is cut off
  std::string out;                    ///< a file for the solution over time, see solutionFile
  std::string points;                 ///< its equally spaced times; empty: the accepted steps
  bool bars = false;                  ///< whether each of its rows has error bars
  bool json = false;
};
/// Whether the user gave this field of the spec.
bool isGiven(const SolveOptions& options, std::string_view field);
int solveCommand(const SolveOptions& options, Streams streams);

/// The references of runs of `solve`: made on all processors, until an interrupt, with one line each to `err` and, on a
/// terminal, a line that says how far they are.
class SolveReferences {
 public:
  explicit SolveReferences(std::ostream& err);
  /// The Watch::reference of a run: makes the references at all its reference times together.
  std::function<MadeReference(const RunSpec&)> of(const RunSpec& whole);

 private:
  StatusLine status_;
  ReferenceLibrary library_;
};

/// The spec that the options describe; what they leave out is as in `defaults`. Throws Misuse.
RunSpec solveSpec(const SolveOptions& options, RunSpec defaults = {});

/// The JSON object that `irk solve --json` prints, see solve.schema.json; indent -1: in one line.
std::string solveJson(const RunRecord& record, int indent = 2);

/// `the error is 5e+04 tolerances` for a success whose error in u, v or x, at t_end or over time, is above the audit's
/// bar; else empty. Errors of multipliers are not judged.
std::string largeErrorText(const RunRecord& record);

/// The runs that options with lists describe, `m=1,2,4`: all combinations. `tol` changes fastest, then `step`, `set`
/// slowest. Throws Misuse for empty and repeated items.
struct Sweep {
  struct Run {
    SolveOptions options;             ///< without lists
    std::vector<std::string> values;  ///< of the lists
  };
  std::vector<std::string> names;  ///< of the lists: "m", "tol"; empty: one run
  std::vector<Run> runs;
};
Sweep sweepOf(const SolveOptions& options);
/// Makes the runs of a sweep: a table with a line per run or, with `json`, a line with its JSON object. Returns 1 if
/// a run failed.
int solveSweep(const Sweep& sweep, Streams streams);

struct EnsembleArguments {
  SolveOptions run;                 ///< its settings may have lists and ranges (gridAxis); json: JSON lines
  std::vector<std::string> starts;  ///< component=VALUES, likewise
  int jobs = 0;                     ///< threads; 0 = one per processor
};
/// Prints a row per member of a grid, or writes it to `run.out`: values, outcome, final state, counters. Returns 1 if a
/// run failed.
int ensembleCommand(const EnsembleArguments& arguments, Streams streams);

struct RunOptions {
  std::string study;  ///< id or file
  StudyVariant variant = StudyVariant::kFull;
  RunnerOptions runner;
  std::vector<std::string> peers = {};  ///< integrators besides those that the study names
};
int runCommand(const RunOptions& options, Streams streams);

/// Runs every study of the paper, then draws figures and report. Ignores `options.study`.
int paperCommand(const RunOptions& options, Streams streams);

/// The studies of irk paper, in the order in which they are run.
std::vector<std::string> paperStudies();

struct PublishOptions {
  std::string into;                 ///< the folder of the publication
  std::string results = "results";  ///< with `quick`
  StudyVariant variant = StudyVariant::kFull;
};
/// Writes the results of all studies of the paper and of the audit for readers (report/publish/publish.h). Throws
/// Failure if a study is missing, not finished, or made by code with other numbers than this program's; Misuse for
/// results of quick runs without the variant quick. Returns 1 for a figure that is missing or figures that are too
/// large.
int publishCommand(const PublishOptions& options, Streams streams);

/// `what`: scenes, methods, studies, analyses, strategies, numbers, constants, columns, or empty for all. `scenes`
/// belongs to the first. Throws Misuse.
int listCommand(const std::string& what, const SceneList& scenes, Streams streams);

/// The tables of experiments/guide/tables.md, which is embedded at build time. Markdown: for each a heading `## FILE`,
/// what a row is, and a line per column with its unit and meaning.
extern const std::string_view kColumnsPage;

/// Writes a first file, which runs as it is. `kind` scene: the file `file`. `kind` study: SCENE_costs.toml beside the
/// scene `file`, an id or a file. Throws Misuse if the file exists.
int newCommand(const std::string& kind, const std::string& file, Streams streams);

struct ReferenceOptions {
  std::vector<std::string> scenes;  ///< empty: all
  int jobs = 0;                     ///< threads; 0 = one per processor
  bool check = false;               ///< compare the files with what is computed, write nothing
  std::string out;                  ///< folder of the files; empty: that of the sources, see into_sources
  bool into_sources = false;        ///< write there; checking needs no permission
};
/// Computes references. Returns 1 if a run failed, an exact solution is contradicted, or (check) a file differs from
/// the computed values.
int referenceCommand(const ReferenceOptions& options, Streams streams);

int tableauShow(const std::string& id_or_file, int digits, Streams streams);
int tableauCheck(const std::string& id_or_file, Streams streams);
int tableauExport(const std::string& id_or_file, const std::string& format, Streams streams);
/// Writes `out`.csv, .svg and .png: stability regions and order stars of the methods, which are ids or files.
int tableauPlot(const std::vector<std::string>& methods, const std::string& out, Streams streams);
/// Writes results/tableaus/: the families' members up to 20 stages.
int tableauTable(const std::string& results, Streams streams);

/// Draws the figures of a study, given by its id or TOML file, from its results.
int plotCommand(const std::string& id_or_file, StudyVariant variant, const std::string& results, Streams streams);
int reportCommand(const std::string& results, Streams streams);
/// Prints the paper's claims and whether the results confirm them; with `sensitivity` everything that is known of each.
int claimsCommand(const std::string& results, bool sensitivity, Streams streams);

/// Prints the progress of a study. Always returns 0.
int statusCommand(const RunOptions& options, Streams streams);

struct SlurmOptions {
  std::string study;  ///< id or file
  std::string shards;
  StudyVariant variant = StudyVariant::kFull;
  std::string results = "results";  ///< without `quick`
  int jobs = 1;
};
/// Prints a job script.
int slurmCommand(const SlurmOptions& options, Streams streams);

struct MergeOptions {
  std::vector<std::string> folders;
  std::string study;  ///< id or file; empty: the study that the tables name
  std::string results = "results";
  StudyVariant variant = StudyVariant::kFull;
  bool partial = false;  ///< merge although runs are missing or conflict
  store::StoreOptions store;
};
/// Returns 1 and writes nothing if runs are missing or conflict and `partial` is not set.
int mergeCommand(MergeOptions options, Streams streams);

/// Whether a study is given by its file, not by its id.
bool isStudyFile(const std::string& id_or_file);

/// The tables of a study, for SQL.
struct TableOptions {
  std::string study;  ///< id or file
  std::string sql;    ///< of query: a select statement
  std::string file;   ///< of export
  bool json = false;
  std::string results = "results";  ///< with `quick`
  StudyVariant variant = StudyVariant::kFull;
};
/// Prints the rows that a select statement gives, as CSV or as JSON lines. Throws Misuse for any other statement.
int queryCommand(const TableOptions& options, Streams streams);
/// Writes all tables to a database of SQLite. Throws Misuse instead of replacing a file that it has not written.
int exportCommand(const TableOptions& options, Streams streams);

struct CompareOptions {
  std::string first, second;  ///< folders of a study, of results, or of publications
  std::string errors = "2", times = "5%", alpha = "0.05", counters = "0%";
};
/// Returns 0 if there is no difference beyond noise, else 1.
int compareCommand(const CompareOptions& options, Streams streams);

}  // namespace irk
