// The analysis of an audit: every drawn run judged, and how many are right, failed or wrong.
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

/// audit.csv: one row per drawn run that has been made, in the order of the draw; `run` counts from 0.
/// `states`: final u, v, x, z by the key of the run.
Table auditTable(const std::vector<DrawnRun>& drawn, const Table& runs,
                 const std::map<std::string, Vec<double>>& states, const Answers& answers);

/// audit_summary.csv: counts of judgements, `by` each of all, configuration, treatment, scene, family,
/// formulation, configuration and treatment; and by configuration over the runs that have to be
/// free of wrong ones: switches treated by default, located, or none in the scene (`bar`).
Table summaryTable(const Table& audit);

/// Writes references.csv, audit.csv and audit_summary.csv of the study's runs into `folder`; returns the
/// lines of summaryText. After an interrupt neither audit.csv nor its summary is there; the references found
/// so far are kept.
std::string auditRuns(const Study& study, const Table& runs, const std::filesystem::path& folder,
                      int jobs, std::ostream& progress);

/// A few lines: counts by configuration, and the worst wrong successes with their commands.
std::string summaryText(const Table& audit, const Table& summary, std::size_t worst);

}  // namespace irk::audit
