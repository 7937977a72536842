// Functions that evaluations of claims share: choosing rows, errors over several times, costs at equal errors.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/median.h"
#include "experiments/claims/measurement.h"
#include "experiments/runs/run_table.h"

namespace irk::claims {

/// Pairs of column and cell.
using Cells = std::vector<std::pair<std::string_view, std::string_view>>;

/// The rows with these cells.
Table where(const Table& table, const Cells& cells);
using Blocks = std::vector<std::string_view>;
/// The runs of a built-in study that belong to one of these blocks. Throws Misuse for a table without the column of
/// blocks, std::logic_error for a block that the study does not have.
Table inBlocks(const ResultTables& tables, std::string_view study, const Blocks& blocks);
/// The rows that the test accepts.
Table where(const Table& table, const std::function<bool(const TableRow&)>& test);
/// The numbers of a column, NaN left out.
std::vector<double> numbersOf(const Table& table, std::string_view column);

/// The rows of a setting: configuration `paper`, or `embedded` and `variable`. Throws MissingResults naming the study
/// if there are none.
Table inSetting(const Table& table, std::string_view study, Setting setting);

inline constexpr int kReferenceTimes = 10;
/// Runs that differ in t_end only become one row, that of the last t_end, whose errors (error, error_u, ...) are the
/// largest at all these times: an integration to an earlier time takes the same steps up to there. An error that is
/// not known at ten times is NaN. Runs with fewer times are left out; throws MissingResults naming the study if none
/// remain.
Table overTimes(const Table& runs, std::string_view study);

/// The runs of blocks of a study in a setting, with errors over ten times.
Table timedRuns(const ResultTables& tables, std::string_view study, const Blocks& blocks, Setting setting);

/// The runs of all blocks of the study claims whose names begin with `beginning`. Throws std::logic_error if there are
/// none.
Table claimRuns(const ResultTables& tables, std::string_view beginning);
/// The same, in a setting.
Table claimRuns(const ResultTables& tables, std::string_view beginning, Setting setting);
/// The same, with errors over ten times.
Table timedClaimRuns(const ResultTables& tables, std::string_view beginning, Setting setting);

/// Residual evaluations of a run, over plain numbers and over dual ones.
double evaluationsAt(const Table& runs, const TableRow& run);

/// The errors at which costs are compared.
std::span<const double> comparedErrors();

/// The cost at which a series reaches an error, NaN if it does not. `error` names the column.
double seriesCost(const Table& runs, const RunSeries& series, std::string_view cost, std::string_view error,
                  double target);

/// Costs of `other` divided by those of `base`, at equal errors.
struct CostRatios {
  std::vector<Case> cases = {};  ///< one per pair of series and error that both reach
  int lost = 0;                  ///< errors that only `base` reaches
  int won = 0;                   ///< errors that only `other` reaches
};
/// Compares series that differ in one column only.
CostRatios compareCosts(const Table& runs, std::string_view column, std::string_view base, std::string_view other,
                        std::string_view cost);

/// Series of one scene that reach an error, and their costs.
struct Race {
  std::string scene;
  double error;
  std::vector<std::pair<const RunSeries*, double>> costs;

  /// The least cost of the series that the test accepts; infinity of none.
  double least(const std::function<bool(const TableRow& run)>& test) const;
};
/// One race for each error, scene, its settings, and cells of the columns `also`. The result points into `series`.
std::vector<Race> races(const Table& runs, const std::vector<RunSeries>& series, std::string_view error_column,
                        const std::vector<std::string_view>& also = {});

/// For each scene with its settings and cells: the race at the smallest error that at least `competitors` series reach.
std::vector<Race> atSmallestError(const Table& runs, const std::vector<RunSeries>& series, std::size_t competitors,
                                  const std::vector<std::string_view>& also = {});

}  // namespace irk::claims
