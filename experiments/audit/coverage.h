// Whether an error bar covers the true error of a result (thresholds.h).
#pragma once

#include "irk/options.h"
#include "irk/scalar.h"

namespace irk::audit {

/// Components u, v, x, z of a scene, one after the other; all vectors but `scale` have the same size.
struct MeasuredResult {
  Vec<double> state;
  Vec<double> bars;       ///< absolute; NaN: unknown
  Vec<double> reference;  ///< NaN: unknown; infinite: there is no solution
  Vec<double> scale;      ///< missing ones are 1
  Tolerances tolerances;
  double accuracy = 0;  ///< of the reference, relative to max(|reference|, scale)
};

/// The largest part of what covers it that an error reaches, over the first `judged` components, and over the others
/// where their bar is known: a success is covered up to 1. NaN if the bar of a judged component is unknown, or if no
/// component has a reference; infinite where there is no solution.
double partOfCover(const MeasuredResult& result, Index judged);

/// The largest |y - reference| / (atol scale + rtol |reference|) over the first `judged` components: the measure of
/// error bars. NaN if none has a reference; infinite where there is no solution.
double errorInTolerances(const MeasuredResult& result, Index judged);

}  // namespace irk::audit
