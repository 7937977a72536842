#include "core/stages/start_values.h"

#include <algorithm>
#include <cmath>

#include "core/base/buffer.h"
#include "core/base/legendre.h"
#include "core/base/small_product.h"
#include "irk/multiprecision.h"

namespace irk {

IRK_STRATEGIES(Predictor, "predictor")

namespace {

// Extrapolation multiplies the stages' errors (Newton's tolerance) by up to sum_j |E_ij|. Above this limit the
// polynomial's highest coefficients are left out: at s = 10 and equal steps the full polynomial amplifies by 1e7. The
// amplification grows with the distance from the past step and is largest at the farthest stage.
constexpr double kAmplificationLimit = 1e4;
// Past steps of up to this many stages, as variable order has them, need no allocation.
constexpr Index kReservedStages = 13;

/// The collocation polynomial of the step before.
template <class Real>
class Extrapolated : public StagePredictor<Real> {
 public:
  explicit Extrapolated(const Scheme<Real>& scheme);
  void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) override {
    const MatView<Real> matrix = weights(*past.scheme, Real((from.t - past.t) / past.h), Real(h / past.h));
    inlinedProduct(past.W.data(), past.W.rows(), past.W.rows(), matrix, W.data(), W.rows());
  }

 private:
  // Column i, applied to W_past, gives the start values of stage i. Two sets are kept, because doubling alternates
  // between the two halves of a step.
  struct Weights {
    const Scheme<Real>* past = nullptr;
    Real offset{-1}, ratio{-1};
    Buffer<Real> matrix;  // s of the past x s
  };
  MatView<Real> weights(const Scheme<Real>& past, const Real& offset, const Real& ratio);
  void compute(Weights& weights);

  const Scheme<Real>& scheme_;
  Weights weights_[2];
  int newest_ = 0;
  Index farthest_ = 0;  // stage
  Buffer<Real> basis_;  // s of the past x s; column i: P_0, P_1, ... at stage i of the new step
};

template <class Real>
Extrapolated<Real>::Extrapolated(const Scheme<Real>& scheme) : scheme_(scheme) {
  scheme.c.maxCoeff(&farthest_);
  const Index most = std::max(scheme.s, kReservedStages);
  basis_.resize(most, scheme.s);
  for (Weights& w : weights_) w.matrix.resize(most, scheme.s);
}

template <class Real>
MatView<Real> Extrapolated<Real>::weights(const Scheme<Real>& past, const Real& offset, const Real& ratio) {
  for (Weights& w : weights_) {
    if (w.past == &past && w.offset == offset && w.ratio == ratio) return w.matrix.view();
  }
  newest_ = 1 - newest_;
  Weights& w = weights_[newest_];
  w.past = &past;
  w.offset = offset;
  w.ratio = ratio;
  compute(w);
  return w.matrix.view();
}

// w(t_past + tau h_past) = sum_k P_k(tau) (V^-1 W^T)_k at tau_i = offset + ratio c_i, truncated after
// the largest degree whose amplification stays below the limit.
template <class Real>
void Extrapolated<Real>::compute(Weights& w) {
  const Index s = scheme_.s, degrees = w.past->s;
  MatView<Real> basis = basis_.resize(degrees, s);
  MatView<Real> matrix = w.matrix.resize(degrees, s);
  for (Index i = 0; i < s; ++i) {
    legendre<Real>(Real(w.offset + w.ratio * scheme_.c[i]), basis.col(i));
  }
  const auto amplification = [&] { return static_cast<double>(Real(matrix.col(farthest_).cwiseAbs().sum())); };
  const Mat<Real>& to_stages = w.past->legendre_inverse_transposed;
  inlinedProduct(to_stages.data(), degrees, degrees, basis, matrix.data(), degrees);
  if (amplification() <= kAmplificationLimit) return;
  matrix.setZero();
  for (Index k = 0; k < degrees; ++k) {
    for (Index i = 0; i < s; ++i) matrix.col(i) += basis(k, i) * to_stages.col(k);
    if (amplification() > kAmplificationLimit && k > 0) {
      for (Index i = 0; i < s; ++i) matrix.col(i) -= basis(k, i) * to_stages.col(k);
      return;
    }
  }
}

/// The stages of the step before; if their number differs, their polynomial.
template <class Real>
class Previous final : public Extrapolated<Real> {
 public:
  using Extrapolated<Real>::Extrapolated;
  void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) override {
    if (past.W.cols() != W.cols()) return Extrapolated<Real>::fill(past, from, h, W);
    W = past.W;
  }
};

/// (a, k, z) at the step's start.
template <class Real>
class Acceleration final : public StagePredictor<Real> {
 public:
  explicit Acceleration(const Scheme<Real>&) {}
  void fill(const StagePolynomial<Real>&, const State<Real>& from, const Real&, Mat<Real>& W) override {
    W.colwise() = from.w;
  }
};

}  // namespace

template <>
Catalogue<Predictor>& catalogue<Predictor>() {
  static Catalogue<Predictor> all({
      {.id = Predictor::kExtrapolated,
       .meaning = "collocation polynomial of the step before",
       .extrapolates = true,
       .make = makes<PredictorMaker, Extrapolated>()},
      {.id = Predictor::kPrevious,
       .meaning = "stages of the step before (paper)",
       .make = makes<PredictorMaker, Previous>()},
      {.id = Predictor::kAcceleration,
       .meaning = "(a, k, z) at the step's start",
       .make = makes<PredictorMaker, Acceleration>()},
  });
  return all;
}

template <class Real>
StartValues<Real>::StartValues(Predictor kind, const Scheme<Real>& scheme)
    : scheme_(scheme), predictor_(catalogue<Predictor>()[kind].make.template of<Real>()(scheme)) {}

template <class Real>
void StartValues<Real>::fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) {
  if (past.valid) {
    predictor_->fill(past, from, h, W);
  } else {
    W.colwise() = from.w;
  }
  for (Index i = 0; i < scheme_.first; ++i) W.col(i) = from.w;
}

IRK_INSTANTIATE_CLASS(StartValues)

}  // namespace irk
