#include "experiments/claims/claims.h"

#include <algorithm>

#include "irk/misuse.h"

namespace irk::claims {
namespace {

Measurement measure(Evaluation evaluate, Setting setting, const ResultTables& tables) {
  try {
    return evaluate(tables, setting);
  } catch (const MissingResults& missing) {
    return cannotMeasure(missing.what());
  } catch (const Misuse& old) {  // a table of another version
    return cannotMeasure(old.what());
  }
}

}  // namespace

Finding findingOn(const Part& part, Setting setting, const ResultTables& tables,
                  const std::vector<std::string>& multibody, Evaluation evaluate) {
  if (!evaluate) evaluate = evaluationOf(part.id);
  const std::string& not_applied = part.not_applied[static_cast<std::size_t>(setting)];
  Finding finding;
  if (!not_applied.empty()) {
    finding.judged.verdict = Verdict::kDoesNotApply;
    finding.judged.reason = not_applied;
    return finding;
  }
  finding.measured = measure(evaluate, setting, tables);
  if (part.multibody_only) {
    std::erase_if(finding.measured.cases, [&](const Case& one) {
      return std::find(multibody.begin(), multibody.end(), one.scene) == multibody.end();
    });
  }
  finding.judged = judge(part, finding.measured);
  if (tables.areQuick()) {
    const bool measured = finding.judged.cases > 0;
    finding.judged.verdict = measured ? Verdict::kNoVerdict : Verdict::kNotMeasurable;
    if (measured) finding.judged.reason = std::string(kPreliminary);
  }
  return finding;
}

Verdict ClaimFindings::verdict(Setting setting) const {
  std::vector<Verdict> verdicts;
  for (const auto& part : parts) verdicts.push_back(part[static_cast<std::size_t>(setting)].judged.verdict);
  return combined(verdicts);
}

std::vector<ClaimFindings> judgeClaims(const Protocol& protocol, const ResultTables& tables) {
  std::vector<ClaimFindings> all;
  for (const auto& claim : protocol.claims) {
    ClaimFindings findings{&claim, {}};
    for (const auto& part : claim.parts) {
      findings.parts.push_back({findingOn(part, Setting::kPaper, tables, protocol.multibody),
                                findingOn(part, Setting::kBest, tables, protocol.multibody)});
    }
    all.push_back(std::move(findings));
  }
  return all;
}

}  // namespace irk::claims
