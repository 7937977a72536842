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
  /// W (n x s) for the step [from.t, from.t + h], from the valid polynomial `past` of any number of stages.
  virtual void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) = 0;
};

template <class Real>
using PredictorMaker = std::function<std::unique_ptr<StagePredictor<Real>>(const Scheme<Real>&)>;

/// Where start values come from.
template <>
struct Strategy<Predictor> {
  Predictor id;
  std::string meaning;
  Needs needs = {};
  bool extrapolates = false;       ///< good from a longer step, too: half steps start from the whole step's stages
  PerScalar<PredictorMaker> make;  ///< keeps a reference to the scheme
};
template <>
Catalogue<Predictor>& catalogue<Predictor>();

/// Start values by the predictor of the options.
template <class Real>
class StartValues {
 public:
  /// Keeps a reference to the scheme.
  StartValues(Predictor kind, const Scheme<Real>& scheme);

  /// W (n x s) for the step [from.t, from.t + h], from the polynomial `past` (of any number of
  /// stages) where it is valid, else from (a, k, z) of `from`. The explicit first stage is always that of `from`.
  void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W);

 private:
  const Scheme<Real>& scheme_;
  std::unique_ptr<StagePredictor<Real>> predictor_;
};

}  // namespace irk
