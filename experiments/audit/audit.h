// The analysis of an audit: judges every drawn run and counts the right, failed and wrong ones.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "experiments/audit/answers.h"
#include "experiments/audit/judge.h"
#include "experiments/study/draw.h"
#include "experiments/tables/table.h"

namespace irk::audit {

/// audit.csv: one row per drawn run that has been made, in the order of the draw; `run` counts from 0. `states` has
/// the final u, v, x, z by the key of the run.
void writeAudit(const Draw& draw, const std::filesystem::path& runs, const std::filesystem::path& states,
                const Answers& answers, const std::filesystem::path& file);

/// audit_summary.csv of an audit.csv: counts of judgements and of successes that are wrong beside them (judge.h), over
/// all runs of our own, and grouped by configuration, treatment, scene, family, formulation, and configuration with
/// treatment; those of other libraries are in the groups `other_library` only. The group `bar` counts by configuration
/// the runs that must not be wrong: those whose switches are treated by default or
/// located, and those of scenes without switches.
Table summaryTable(const std::filesystem::path& audit);

/// Reads runs.csv and states.csv in the study's folder, and writes references.csv, audit.csv, audit_summary.csv and the
/// tables of bar_tables.h there; returns the lines of summaryText and of both tables. After an interrupt audit.csv and
/// its tables do not exist; the references found so far are kept.
std::string auditRuns(const Study& study, const std::filesystem::path& folder, int jobs, std::ostream& progress);

/// A few lines about an audit.csv: counts by configuration, and the `worst` largest wrong successes with their
/// commands.
std::string summaryText(const std::filesystem::path& audit, const Table& summary, std::size_t worst);

}  // namespace irk::audit
