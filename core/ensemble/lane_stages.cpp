#include "core/ensemble/lane_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.h"
#include "core/estimates/embedded.h"

namespace irk {
namespace {

// As in core/stages/stage_equations.cpp, start_values.cpp and newton/simplified_newton.cpp.
constexpr double kInner = 0.6;
constexpr double kAmplificationLimit = 1e4;

Index innerStage(const Scheme<double>& scheme) {
  Index inner = 0;
  for (Index i = 0; i < scheme.s; ++i) {
    if (std::abs(scheme.c[i] - kInner) < std::abs(scheme.c[inner] - kInner)) inner = i;
  }
  return inner;
}

// y1 = y0 + (y1 + carry0), where y1 comes in as the increment (core/stages/stage_equations.cpp).
void addCompensated(const Lanes& y0, const Lanes& carry0, Lanes& y1, Lanes& carry1) {
  const Lanes b = y1 + carry0;
  const Lanes sum = y0 + b;
  const Lanes rounded = sum - y0;
  carry1 = (y0 - (sum - rounded)) + (b - rounded);
  y1 = sum;
}

// P_0, P_1, ... at x, orthonormal on [0, 1]: core/base/legendre.h.
[[gnu::always_inline]] inline void legendreLanes(const Lanes& x, Index s, Lanes* p) {
  const Lanes X = 2.0 * x - 1.0;
  Lanes now = 1.0, before = 0.0;
  for (Index k = 0; k < s; ++k) {
    const auto j = static_cast<double>(k);
    if (k > 0) {
      const Lanes next = ((2 * j - 1) / j) * X * now - ((j - 1) / j) * before;
      before = now;
      now = next;
    }
    p[k] = std::sqrt(2 * j + 1) * now;
  }
}

}  // namespace

LaneStages::LaneStages(const Scheme<double>& scheme, const Sizes& sizes, const std::vector<int>& row_powers, double mu)
    : scheme_(scheme),
      sizes_(sizes),
      n_(sizes.n()),
      s_(scheme.s),
      inner_(innerStage(scheme)),
      nu_(count(sizes.nu)),
      nx_(count(sizes.nx)),
      nz_(count(sizes.nz)),
      row_powers_(row_powers),
      mu_(mu),
      start_(EmbeddedEstimate<double>::atStart(scheme)),
      integrals_(scheme.A_transposed * EmbeddedEstimate<double>::atStart(scheme)),
      b_(scheme.b),
      bA_(scheme.bA),
      t_(count(s_)),
      U_(nu_ * t_.size()),
      V_(U_.size()),
      X_(nx_ * t_.size()),
      scaled_(std::any_of(row_powers.begin(), row_powers.end(), [](int power) { return power > 0; })),
      scales_(count(n_), 1.0),
      past_W_(count(n_ * s_)),
      basis_(count(s_ * s_)),
      weights_(basis_.size()),
      dual_(sizes),
      defect_(count(n_)),
      slip_(nu_),
      at_(2 * nu_ + nx_),
      error_(at_.size() + nz_),
      e_(count(n_)),
      most_(count(n_)),
      z_powers_(nz_) {}

void LaneStages::use(const System<Lanes>& system) {
  system_ = &system;
  uses_velocity_ = system.usesVelocity();
  z_powers_ = system.errorPowers().z;
  if (!uses_velocity_) std::fill(V_.begin(), V_.end(), Lanes(std::numeric_limits<double>::quiet_NaN()));
}

void LaneStages::begin(const LaneState& from, const Lanes& h) {
  from_ = &from;
  h_ = h;
  for (Index i = 0; i < s_; ++i) t_[count(i)] = from.t + scheme_.c[i] * h;
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    if (row_powers_[i] > 0) scales_[i] = powerOf(1.0 / h, row_powers_[i]);
  }
}

void LaneStages::scaleRows(Lanes* r) const {
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    if (row_powers_[i] > 0) r[i] *= scales_[i];
  }
}

// As StartValues: the weights of the past stages in stage i are column i.
void LaneStages::predict(const LaneMask& past, std::vector<Lanes>& W) {
  const LaneMask follows = equal(from_->t, past_t_ + past_h_);
  const Lanes offset = select(follows, 1.0, (from_->t - past_t_) / past_h_), ratio = h_ / past_h_;
  const Mat<double>& to_stages = scheme_.legendre_inverse_transposed;
  withSize<5>(s_, [&](auto s) {
    for (Index i = 0; i < s; ++i) {
      Lanes* const basis = basis_.data() + i * s;
      legendreLanes(offset + ratio * scheme_.c[i], s, basis);
      for (Index m = 0; m < s; ++m) {
        Lanes sum = to_stages(m, 0) * basis[0];
        for (Index k = 1; k < s; ++k) sum += to_stages(m, k) * basis[k];
        weights_[count(i * s + m)] = sum;
      }
    }
  });
  Lanes amplification;
  for (std::size_t m = weights_.size() - count(s_); m < weights_.size(); ++m) amplification += abs(weights_[m]);
  const LaneMask too_large = ~lessOrEqual(amplification, kAmplificationLimit) & past;
  if (too_large.any()) shortenPolynomial(too_large, basis_, weights_);
  withSize<5>(s_, [&](auto s) {
    for (Index r = 0; r < n_; ++r) {
      const Lanes start = from_->w[count(r)];
      for (Index i = 0; i < s; ++i) {
        const Lanes* const c = weights_.data() + i * s;
        Lanes sum = c[0] * past_W_[count(r)];
        for (Index m = 1; m < s; ++m) sum += c[m] * past_W_[count(r + m * n_)];
        W[count(r + i * n_)] = select(past, sum, start);
      }
    }
  });
}

// Leaves out the polynomial's highest coefficients, from the first one whose amplification exceeds the limit.
void LaneStages::shortenPolynomial(const LaneMask& where, const std::vector<Lanes>& basis,
                                   std::vector<Lanes>& weights) const {
  const Mat<double>& to_stages = scheme_.legendre_inverse_transposed;
  std::vector<Lanes> sum(weights.size()), next(weights.size());
  LaneMask open = where;
  for (Index k = 0; k < s_ && open.any(); ++k) {
    Lanes amplification;
    for (Index i = 0; i < s_; ++i) {
      for (Index m = 0; m < s_; ++m) {
        const auto at = count(i * s_ + m);
        next[at] = sum[at] + basis[count(i * s_ + k)] * to_stages(m, k);
        if (i == s_ - 1) amplification += abs(next[at]);
      }
    }
    if (k > 0) open = open & lessOrEqual(amplification, kAmplificationLimit);
    assign(open, next.data(), sum.data(), sum.size());
  }
  assign(where, sum.data(), weights.data(), weights.size());
}

void LaneStages::keep(const LaneMask& which, const std::vector<Lanes>& W) {
  assign(which, W.data(), past_W_.data(), W.size());
  past_t_ = select(which, from_->t, past_t_);
  past_h_ = select(which, h_, past_h_);
}

// V = v0 + h A a, U = u0 + h A 1 v0 + h^2 A^2 a, X = x0 + h A k.
void LaneStages::place(const std::vector<Lanes>& W) {
  const Lanes *const u = from_->y.data(), *const v = u + nu_, *const x = v + nu_;
  const auto stages = entriesOf(W.data(), n_);
  if (nu_ > 0) {
    if (uses_velocity_) {
      laneProduct(sizes_.nu, scheme_.A_transposed, stages,
                  [&](Index i, Index j, const Lanes& sum) { V_[count(i) + count(j) * nu_] = h_ * sum + v[i]; });
    }
    const Lanes hh = h_ * h_;
    laneProduct(sizes_.nu, scheme_.A2_transposed, stages, [&](Index i, Index j, const Lanes& sum) {
      U_[count(i) + count(j) * nu_] = hh * sum + (u[i] + h_ * scheme_.A1[j] * v[i]);
    });
  }
  laneProduct(sizes_.nx, scheme_.A_transposed, entriesOf(W.data() + nu_, n_),
              [&](Index i, Index j, const Lanes& sum) { X_[count(i) + count(j) * nx_] = h_ * sum + x[i]; });
}

LaneMask LaneStages::residual(const std::vector<Lanes>& W, std::vector<Lanes>& R) {
  place(W);
  const StagePoints<Lanes> at{sizes_, t_.data(), U_.data(), V_.data(), X_.data(), W.data(), nullptr};
  system_->evaluateStages(at, 0, s_, R.data());
  for (Index j = 0; scaled_ && j < s_; ++j) scaleRows(R.data() + j * n_);
  // One sum per place in a stage: in a single sum each addition would wait for the one before.
  Lanes all;
  for (Index i = 0; i < n_; ++i) {
    Lanes sum;
    for (Index j = 0; j < s_; ++j) sum += R[count(i + j * n_)] * 0.0;
    all += sum;
  }
  return equal(all, 0.0);
}

Index LaneStages::dualEvaluations() const {
  const auto chunk = static_cast<Index>(kChunk);
  return (n_ + 2 * sizes_.nu + sizes_.nx + chunk - 1) / chunk;
}

void LaneStages::differentiate(const std::vector<Lanes>& W, const LaneMask& which, LaneJacobian& jacobian) {
  place(W);
  const auto inner = count(inner_);
  for (std::size_t i = 0; i < nu_; ++i) dual_.u[static_cast<Index>(i)].value = U_[inner * nu_ + i];
  for (std::size_t i = 0; i < nu_; ++i) dual_.v[static_cast<Index>(i)].value = V_[inner * nu_ + i];
  for (std::size_t i = 0; i < nx_; ++i) dual_.x[static_cast<Index>(i)].value = X_[inner * nx_ + i];
  for (Index i = 0; i < n_; ++i) dual_.w[i].value = W[count(i + inner_ * n_)];
  const Index rates = sizes_.nu + sizes_.nx, directions = n_ + rates + sizes_.nu;
  const auto along = [&](Index i) -> Direction {
    if (i < n_) return {0, static_cast<int>(i)};
    return i < n_ + rates ? Direction{1, static_cast<int>(i - n_)} : Direction{2, static_cast<int>(i - n_ - rates)};
  };
  constexpr auto kChunkSize = static_cast<Index>(kChunk);
  for (Index first = 0; first < directions; first += kChunkSize) {
    const Index last = std::min(first + kChunkSize, directions);
    for (Index i = first; i < last; ++i) dual_.component(along(i)).d[count(i - first)] = 1.0;
    system_->evaluate(Level::kFormulated, dual_.at(t_[inner]), dual_.residual());
    for (Index i = first; i < last; ++i) {
      const Direction direction = along(i);
      auto& matrix = direction.matrix == 0 ? jacobian.d0 : direction.matrix == 1 ? jacobian.d1 : jacobian.d2;
      Lanes* const column = matrix.data() + direction.column * n_;
      for (Index r = 0; r < n_; ++r) column[r] = select(which, dual_.r[r].d[count(i - first)], column[r]);
      dual_.component(direction).d[count(i - first)] = 0.0;
    }
  }
}

void LaneStages::lastDigits(const std::vector<Lanes>& W, std::vector<Lanes>& change) const {
  const double eps = kLastDigits * std::numeric_limits<double>::epsilon();
  const Lanes *const u = from_->y.data(), *const v = u + nu_, *const x = v + nu_;
  for (std::size_t j = 0; j < t_.size(); ++j) {
    for (std::size_t i = 0; i < count(n_); ++i) {
      const std::size_t at = j * count(n_) + i;
      Lanes size = abs(W[at]);
      if (i < nu_) size += abs(v[i]) / h_ + abs(u[i]) / (h_ * h_);
      if (i >= nu_ && i < nu_ + nx_) size += abs(x[i - nu_]) / h_;
      change[at] = ((i + j) % 2 == 0 ? eps : -eps) * size;
    }
  }
}

void LaneStages::finish(const std::vector<Lanes>& W, LaneState& to) const {
  const Lanes *const u = from_->y.data(), *const v = u + nu_;
  to.t = from_->t + h_;
  const auto stages = entriesOf(W.data(), n_);
  laneProduct(sizes_.nu, bA_, stages,
              [&](Index i, Index, const Lanes& sum) { to.y[count(i)] = (h_ * h_) * sum + h_ * v[i]; });
  laneProduct(sizes_.nu + sizes_.nx, b_, stages,
              [&](Index i, Index, const Lanes& sum) { to.y[nu_ + count(i)] = h_ * sum; });
  for (std::size_t i = 0; i < to.y.size(); ++i) addCompensated(from_->y[i], from_->carry[i], to.y[i], to.carry[i]);
  std::copy_n(W.end() - n_, n_, to.w.begin());
}

// HW II (IV.8.19-20), see EmbeddedEstimate.
void LaneStages::evaluate(const Lanes& t, Between between) {
  const Point<Lanes> at{t,
                        {at_.data(), sizes_.nu},
                        {at_.data() + nu_, sizes_.nu},
                        {at_.data() + 2 * nu_, sizes_.nx},
                        {defect_.data(), sizes_.nu},
                        {defect_.data() + nu_, sizes_.nx},
                        {defect_.data() + nu_ + nx_, sizes_.nz}};
  system_->evaluate(Level::kFormulated, at, VecView<Lanes>(e_.data(), n_));
  scaleRows(e_.data());
  const int least = between == Between::kStages ? 1 : 2;  // see EmbeddedEstimate::evaluateAt
  for (std::size_t i = 0; i < nz_; ++i) {
    if (z_powers_[i] >= least) e_[nu_ + nx_ + i] = 0.0;
  }
}

void LaneStages::filter(LaneMatrix& matrix) {
  matrix.solveFilter(e_.data());
  const Lanes step = h_ * mu_;
  for (std::size_t i = 0; i < nu_; ++i) {
    error_[nu_ + i] = -(step * e_[i]);
    error_[i] = slip_[i] + step * error_[nu_ + i];
  }
  for (std::size_t i = 0; i < nx_; ++i) error_[2 * nu_ + i] = -(step * e_[nu_ + i]);
  for (std::size_t i = 0; i < nz_; ++i) error_[at_.size() + i] = z_powers_[i] == 2 ? Lanes(0.0) : -e_[nu_ + nx_ + i];
}

Lanes LaneStages::estimate(const std::vector<Lanes>& W, const LaneNorm& norm, LaneMatrix& matrix,
                           const Lanes& again_above, const LaneMask& which, LaneCounters& counters) {
  const auto stages = entriesOf(W.data(), n_);
  laneProduct(n_, start_, stages, [&](Index i, Index, const Lanes& sum) { defect_[count(i)] = sum; });
  const Lanes factor = -mu_ * (h_ * h_);
  laneProduct(sizes_.nu, integrals_, stages, [&](Index i, Index, const Lanes& sum) { slip_[count(i)] = factor * sum; });
  for (std::size_t i = 0; i < at_.size(); ++i) at_[i] = i < nu_ ? from_->y[i] + slip_[i] : from_->y[i];
  evaluate(from_->t, Between::kNone);
  filter(matrix);
  const Lanes error = sizeOfError(norm);
  counters.residuals.add(which);
  counters.solves.add(which);
  const LaneMask again = less(again_above, error) & which;
  if (!again.any()) return error;
  for (std::size_t i = 0; i < nu_; ++i) slip_[i] += (h_ * mu_) * error_[nu_ + i];
  for (std::size_t i = 0; i < at_.size(); ++i) {
    at_[i] = from_->y[i] + error_[i];
    if (i < nu_) at_[i] += slip_[i];
  }
  counters.residuals.add(again);
  counters.solves.add(again);
  evaluate(from_->t, Between::kNone);
  filter(matrix);
  return select(again, sizeOfError(norm), error);
}

}  // namespace irk
