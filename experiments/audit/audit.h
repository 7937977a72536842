// The analysis of an audit: judges every drawn run and counts the right, failed and wrong ones.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "experiments/audit/answers.h"
#include "experiments/audit/judge.h"
#include "experiments/study/draw.h"
#include "experiments/tables/table.h"

namespace irk::audit {

/// audit.csv: one row per drawn run that has been made, in the order of the draw; `run` counts from 0. `states` has
/// the final u, v, x, z by the key of the run.
Table auditTable(const std::vector<DrawnRun>& drawn, const Table& runs,
                 const std::map<std::string, Vec<double>>& states, const Answers& answers);

/// audit_summary.csv: counts of judgements over all runs, and grouped by configuration, treatment, scene, family,
/// formulation, and configuration with treatment. The group `bar` counts by configuration the runs that must not be
/// wrong: those whose switches are treated by default or located, and those of scenes without switches.
Table summaryTable(const Table& audit);

/// Writes references.csv, audit.csv and audit_summary.csv of the study's runs to `folder`; returns the lines of
/// summaryText. After an interrupt audit.csv and its summary do not exist; the references found so far are kept.
std::string auditRuns(const Study& study, const Table& runs, const std::filesystem::path& folder, int jobs,
                      std::ostream& progress);

/// A few lines: counts by configuration, and the `worst` largest wrong successes with their commands.
std::string summaryText(const Table& audit, const Table& summary, std::size_t worst);

}  // namespace irk::audit
