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

// Extrapolation multiplies the stages' errors by up to sum_j |E_ij|. Above a limit the polynomial's highest
// coefficients are left out: at s = 10 and equal steps the full polynomial amplifies by 1e7. The amplification grows
// with the distance from the past step and is largest at the farthest stage. Newton's method leaves kappa tolerances in
// a stage; with the limit 1 / tolerance these become the part kappa of a solution of size 1, whatever the tolerance is.
// On 22 scenes, with it instead of 1e4: residuals .83 to 1.04 and errors .4 to 1.0 at 1e-2, .94 to 1.00 and .6 to 1.0
// at 1e-3. Below 1e-4 it would allow more (residuals .97 to .87 with variable order, errors .7 to 1.5): not done.
constexpr double kAmplificationLimit = 1e4;
double amplificationLimit(double tolerance) { return std::min(kAmplificationLimit, 1 / tolerance); }
// Past steps of up to this many stages, as variable order has them, need no allocation.
constexpr Index kReservedStages = 13;

/// The collocation polynomial of the step before: W V^-T P, with the Legendre polynomials P at the new stages. With s
/// stages before and after, V^-T P costs s^3 products where the step size has changed, and W times it n s^2. Where n is
/// at most s / 2, the polynomial's coefficients W V^-T are computed first: 2 n s^2 in all.
template <class Real>
class Extrapolated : public StagePredictor<Real> {
 public:
  Extrapolated(const Scheme<Real>& scheme, double tolerance);
  void fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) override;

 private:
  // What the two schemes and the ratio of the step sizes determine. Two sets are kept, because doubling alternates
  // between the two halves of a step.
  struct Weights {
    const Scheme<Real>* past = nullptr;
    Real offset{-1}, ratio{-1};
    Buffer<Real> basis;   // P: degrees x s; column i belongs to stage i of the new step
    Buffer<Real> matrix;  // V^-T P: s of the past x s; unused where coefficients come first
  };
  Weights& weights(const StagePolynomial<Real>& past, const Real& offset, const Real& ratio);
  void compute(Weights& weights);
  void computeWithCoefficientsFirst(Weights& weights);
  MatView<Real> evaluateBasis(Weights& weights, Index degrees) const;
  MatView<Real> multiply(Weights& weights) const;
  Index degreesWithinLimit(Weights& weights);
  static bool coefficientsFirst(const StagePolynomial<Real>& past) { return 2 * past.W.rows() <= past.W.cols(); }

  const Scheme<Real>& scheme_;
  double limit_;  // of the amplification
  Weights weights_[2];
  int newest_ = 0;
  Index farthest_ = 0;  // stage
  Buffer<Real> row_;    // of V^-T P, at the farthest stage
  Buffer<Real> coefficients_;
};

// The leading columns of a square matrix, which have no gaps.
template <class Real>
Eigen::Map<const Mat<Real>> leading(const Mat<Real>& matrix, Index columns) {
  return {matrix.data(), matrix.rows(), columns};
}

template <class Row>
double amplification(const Row& row) {
  return static_cast<double>(row.cwiseAbs().sum());
}

template <class Real>
Extrapolated<Real>::Extrapolated(const Scheme<Real>& scheme, double tolerance)
    : scheme_(scheme), limit_(amplificationLimit(tolerance)) {
  scheme.c.maxCoeff(&farthest_);
  const Index most = std::max(scheme.s, kReservedStages);
  row_.resize(most, 1);
  coefficients_.resize(most / 2, most);  // coefficientsFirst bounds n
  for (Weights& w : weights_) {
    w.basis.resize(most, scheme.s);
    w.matrix.resize(most, scheme.s);
  }
}

template <class Real>
void Extrapolated<Real>::fill(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h, Mat<Real>& W) {
  const Index n = past.W.rows();
  // The difference of two times is not exactly h, and weights are kept for equal offsets.
  const bool follows = from.t == past.t + past.h;
  const Real offset = follows ? Real(1) : Real((from.t - past.t) / past.h);
  Weights& w = weights(past, offset, Real(h / past.h));
  if (!coefficientsFirst(past)) return inlinedProduct(past.W.data(), n, n, w.matrix.view(), W.data(), n);
  const MatView<Real> basis = w.basis.view();
  MatView<Real> coefficients = coefficients_.resize(n, basis.rows());
  smallProduct(past.W.data(), n, n, leading(past.scheme->legendre_inverse_transposed, basis.rows()),
               coefficients.data(), n);
  smallProduct(coefficients.data(), n, n, basis, W.data(), n);
}

template <class Real>
auto Extrapolated<Real>::weights(const StagePolynomial<Real>& past, const Real& offset, const Real& ratio) -> Weights& {
  for (Weights& w : weights_) {
    if (w.past == past.scheme && w.offset == offset && w.ratio == ratio) return w;
  }
  newest_ = 1 - newest_;
  Weights& w = weights_[newest_];
  w.past = past.scheme;
  w.offset = offset;
  w.ratio = ratio;
  coefficientsFirst(past) ? computeWithCoefficientsFirst(w) : compute(w);
  return w;
}

// w(t_past + tau h_past) = sum_k P_k(tau) (V^-1 W^T)_k at tau_i = offset + ratio c_i.
template <class Real>
MatView<Real> Extrapolated<Real>::evaluateBasis(Weights& w, Index degrees) const {
  MatView<Real> basis = w.basis.resize(degrees, scheme_.s);
  for (Index i = 0; i < scheme_.s; ++i) legendre<Real>(Real(w.offset + w.ratio * scheme_.c[i]), basis.col(i));
  return basis;
}

template <class Real>
MatView<Real> Extrapolated<Real>::multiply(Weights& w) const {
  const Index stages = w.past->s;
  const MatView<Real> basis = w.basis.view();
  MatView<Real> matrix = w.matrix.resize(stages, scheme_.s);
  inlinedProduct(w.past->legendre_inverse_transposed.data(), stages, stages, basis, matrix.data(), stages);
  return matrix;
}

template <class Real>
void Extrapolated<Real>::compute(Weights& w) {
  evaluateBasis(w, w.past->s);
  if (amplification(multiply(w).col(farthest_)) <= limit_) return;
  evaluateBasis(w, degreesWithinLimit(w));
  multiply(w);
}

template <class Real>
void Extrapolated<Real>::computeWithCoefficientsFirst(Weights& w) {
  const Index stages = w.past->s;
  const VecView<Real> farthest(evaluateBasis(w, stages).col(farthest_).data(), stages);
  MatView<Real> row = row_.resize(stages, 1);
  smallProduct(w.past->legendre_inverse_transposed.data(), stages, stages, farthest, row.data(), stages);
  if (amplification(row) > limit_) evaluateBasis(w, degreesWithinLimit(w));
}

// The largest number of degrees whose amplification stays below the limit, at least 1.
template <class Real>
Index Extrapolated<Real>::degreesWithinLimit(Weights& w) {
  const MatView<Real> basis = w.basis.view();
  MatView<Real> row = row_.resize(w.past->s, 1);
  row.setZero();
  for (Index k = 0; k < basis.rows(); ++k) {
    row += basis(k, farthest_) * w.past->legendre_inverse_transposed.col(k);
    if (k > 0 && amplification(row) > limit_) return k;
  }
  return basis.rows();
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
  Acceleration(const Scheme<Real>&, double) {}
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
StartValues<Real>::StartValues(Predictor kind, const Scheme<Real>& scheme, double tolerance)
    : scheme_(scheme),
      predictor_(madeBy(catalogue<Predictor>()[kind].make.template of<Real>(), kind, scheme, tolerance)) {}

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
