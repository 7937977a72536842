// The one judge of all claims: from measured values to a verdict.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/claims/claim.h"
#include "experiments/claims/measurement.h"

namespace irk::claims {

enum class Verdict {
  kConfirmed,
  kContradicted,
  kUndecided,
  kNotMeasurable,
  kNoVerdict,  ///< measured, but on the small studies of --quick
  kReported,
  kDoesNotApply,
};

/// `confirmed`, `contradicted`, `undecided`, `not measurable`, `no verdict (quick)`, `reported`, `does not apply`.
std::string_view verdictText(Verdict verdict);

/// `12 cases of 3 scenes`.
std::string countsText(std::size_t cases, std::size_t scenes);

/// The least sample for a verdict on a median or a share.
struct Sample {
  std::size_t cases = 10, scenes = 3;
};
inline constexpr Sample kAnySample{1, 1};

struct Judgement {
  Verdict verdict = Verdict::kNotMeasurable;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< the statistic; for existence the share of clean cases
  double low = value, high = value;                         ///< 90 % interval; NaN for existence
  std::size_t cases = 0, clean = 0;                         ///< clean: shares and existence only
  std::vector<std::string> scenes = {};                     ///< of the cases, sorted
  std::string reason = {};                                  ///< why it is not measurable or does not apply
  std::string remark = {};                                  ///< that of the measurement
};

/// The judgement of a part by its cases:
/// - Median and share: `not measurable` below the sample; `confirmed` if the whole 90 % interval lies in the range,
///   `contradicted` if it lies on one side outside of it, else `undecided`. The interval is a bootstrap that resamples
///   scenes, not cases, because cases of one scene are not independent. The same on every machine.
/// - Existence: `confirmed` by one clean case; `contradicted` if a full sample has none, else `not measurable`.
/// - Report: no verdict.
Judgement judge(const Part& part, const Measurement& measured, const Sample& least = {});

/// `1.52 [1.49, 1.55] times`; `3 of 12 cases`; `infinite`; `–` without cases.
std::string numberText(const Part& part, const Judgement& judgement);
/// The same; behind an infinite one the remark of its measurement, which says why: `infinite (9 of 12 runs fail.)`.
std::string explainedNumber(const Part& part, const Judgement& judgement);

/// The verdict on a claim by the verdicts on its parts: contradicted if one part is; otherwise not measurable if one
/// is; otherwise without verdict if one is; otherwise undecided if one is; otherwise confirmed. Parts that are only
/// reported or do not apply do not count. If no part counts, the claim is reported or does not apply.
Verdict combined(const std::vector<Verdict>& parts);

}  // namespace irk::claims
