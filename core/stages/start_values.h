// Start values of Newton's iteration.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/options/catalogue.h"
#include "core/stages/scheme.h"
#include "irk/system.h"

namespace irk {

/// The stages of a solved step: the polynomial through (c_i, w_i) on [t, t + h].
template <class Real>
struct StagePolynomial {
  const Scheme<Real>* scheme = nullptr;
  Real t{}, h{};
  Mat<Real> W;  ///< n x s; n columns of zero length until the first step
  bool valid = false;
};

/// A strategy of the axis `predictor`. Owns its scratch.
template <class Real>
class StagePredictor {
 public:
  virtual ~StagePredictor() = default;
  /// Writes start values W (n x s) for the step [from.t, from.t + h]; `past` is valid and may have any number of
  /// stages.
  virtual void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) = 0;
};

/// Arguments: the scheme, and the tolerance of steps (the larger one of rtol and atol), 0 for fixed steps.
template <class Real>
using PredictorMaker = std::function<std::unique_ptr<StagePredictor<Real>>(const Scheme<Real>&, double tolerance)>;

/// A strategy of the axis `predictor`: the source of start values.
template <>
struct Strategy<Predictor> {
  Predictor id;
  std::string meaning;
  Needs needs = {};
  /// accurate from a longer step as well: half steps start from the whole step's stages
  bool extrapolates = false;
  PerScalar<PredictorMaker> make;  ///< keeps a reference to the scheme
};
template <>
Catalogue<Predictor>& catalogue<Predictor>();

/// Computes start values with the predictor that the options name.
template <class Real>
class StartValues {
 public:
  /// Keeps a reference to the scheme. `tolerance`: see PredictorMaker.
  StartValues(Predictor kind, const Scheme<Real>& scheme, double tolerance);

  /// Writes start values W (n x s) for the step [from.t, from.t + h]: from the polynomial `past` (of any number of
  /// stages) if it is valid, else from (a, k, z) of `from`. The explicit first stage always comes from `from`.
  void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W);

 private:
  const Scheme<Real>& scheme_;
  std::unique_ptr<StagePredictor<Real>> predictor_;
};

}  // namespace irk
