#include "experiments/runs/peers/loaded/adapters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <vector>

#include "irk/misuse.h"

namespace irk {
namespace {

// The codes pass RPAR to all callbacks unchanged; here it is the address of the peer.
extern "C" {
using DasslRes = void(double* t, double* y, double* yp, double* delta, int* ires, double* rpar, int* ipar);
using DaspkRes = void(double* t, double* y, double* yp, double* cj, double* delta, int* ires, double* rpar, int* ipar);
using DaeJac = void(double* t, double* y, double* yp, double* pd, double* cj, double* rpar, int* ipar);
using Dassl = void(DasslRes*, int* neq, double* t, double* y, double* yp, double* tout, int* info, double* rtol,
                   double* atol, int* idid, double* rwork, int* lrw, int* iwork, int* liw, double* rpar, int* ipar,
                   DaeJac*);
using Daspk = void(DaspkRes*, int* neq, double* t, double* y, double* yp, double* tout, int* info, double* rtol,
                   double* atol, int* idid, double* rwork, int* lrw, int* iwork, int* liw, double* rpar, int* ipar,
                   DaeJac*, void (*psol)());
}

struct LoadedDassl {
  std::shared_ptr<const SharedLibrary> library;
  std::string id;
  Dassl* dassl;
  Daspk* daspk;  // one of the two
};

class DasslPeer final : public Peer {
 public:
  DasslPeer(LoadedDassl loaded, const PeerSetup& setup)
      : loaded_(std::move(loaded)), setup_(setup), problem_(setup.problem), n_(problem_.layout().n) {}

  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    y_ = ConstVec<double>(start.y, n_);
    yp_ = ConstVec<double>(start.yp, n_);
    double t = start.t;
    counts_ = {};
    const std::unique_lock lock(loaded_.library->oneAtATime());
    begin(t_end);
    while (t < t_end) {
      call(t, t_end);
      if (idid_ < 0 && outgrown_) {
        collectCounts();
        begin(t_end);
        continue;
      }
      if (idid_ == -1) {  // 500 steps since the last return
        info_[0] = 1;
        continue;
      }
      if (idid_ < 0) break;
      if (accepted({t, y_.data(), yp_.data()}) == PeerNext::kReturn) break;
    }
    collectCounts();
    return outcome();
  }

  void count(Counters& counters) const override {
    counters.factorizations += counts_.factorizations;
    counters.steps_rejected_error += counts_.steps_rejected_error;
    counters.steps_rejected_newton += counts_.steps_rejected_newton;
  }
  std::string message() const override { return fmt::format("{} returned IDID = {}", loaded_.id, idid_); }

 private:
  // Sets INFO: a tolerance per component, a return after each step, no step beyond the end, the Jacobian from `jac`,
  // banded if that takes less than half of the full work, the largest and the first step.
  void begin(double t_end) {
    const auto pattern = problem_.pattern();
    outgrown_ = false;
    lower_ = pattern->lower;
    upper_ = pattern->upper;
    banded_ = !pattern->full && 2 * (2 * lower_ + upper_ + 1) <= n_;
    info_ = {};
    info_[1] = info_[2] = info_[3] = info_[4] = 1;
    leading_ = banded_ ? 2 * lower_ + upper_ + 1 : n_;
    const Index numbers = n_ * (leading_ + 20) + 200;
    if (numbers > std::numeric_limits<int>::max()) {
      throw Misuse(fmt::format("{}: {} unknowns need {} numbers of work space, more than its integers can count",
                               loaded_.id, n_, numbers));
    }
    rwork_.assign(static_cast<std::size_t>(numbers), 0);
    iwork_.assign(static_cast<std::size_t>(4 * n_ + 200), 0);
    rwork_[0] = t_end;
    if (banded_) {
      info_[5] = 1;
      iwork_[0] = static_cast<int>(lower_);
      iwork_[1] = static_cast<int>(upper_);
    }
    if (setup_.h_max < 1e299) {
      info_[6] = 1;
      rwork_[1] = setup_.h_max;
    }
    if (setup_.h > 0) {
      info_[7] = 1;
      rwork_[2] = setup_.h;
    }
    rtol_.setConstant(n_, setup_.rtol);
    atol_ = setup_.atol;
  }

  // TOUT lies beyond the next step. It must not be too large, because the codes take no step below round-off of TOUT.
  void call(double& t, double t_end) {
    constexpr double kSteps = 1e6;
    double tout = info_[0] == 0 ? t_end : std::min(t_end, t + kSteps * rwork_[2]);
    if (tout <= t) tout = t_end;
    int neq = static_cast<int>(n_), lrw = static_cast<int>(rwork_.size()), liw = static_cast<int>(iwork_.size());
    int ipar = 0;
    double* const self = reinterpret_cast<double*>(this);
    if (loaded_.dassl) {
      loaded_.dassl(dasslRes, &neq, &t, y_.data(), yp_.data(), &tout, info_.data(), rtol_.data(), atol_.data(), &idid_,
                    rwork_.data(), &lrw, iwork_.data(), &liw, self, &ipar, jac);
    } else {
      loaded_.daspk(daspkRes, &neq, &t, y_.data(), yp_.data(), &tout, info_.data(), rtol_.data(), atol_.data(), &idid_,
                    rwork_.data(), &lrw, iwork_.data(), &liw, self, &ipar, jac, [] {});
    }
  }

  void collectCounts() {
    counts_.factorizations += iwork_[12];
    counts_.steps_rejected_error += iwork_[13];
    counts_.steps_rejected_newton += iwork_[14];
  }

  Outcome outcome() const {
    switch (idid_) {
      case -7:
      case -9:
        return Outcome::kNewtonFailed;
      case -8:
        return Outcome::kSingular;
      case -10:
      case -11:
        return Outcome::kNotFinite;
      default:
        return idid_ < 0 ? Outcome::kStepTooSmall : Outcome::kSuccess;
    }
  }

  static DasslPeer& of(double* rpar) { return *reinterpret_cast<DasslPeer*>(rpar); }

  // IRES = -1: try a smaller step; -2: return.
  void residual(double t, const double* y, const double* yp, double* delta, int* ires) {
    const Evaluated evaluated = problem_.residual(t, y, yp, delta);
    if (evaluated != Evaluated::kDone) *ires = evaluated == Evaluated::kStop || outgrown_ ? -2 : -1;
    if (outgrown_) *ires = -2;
  }
  static void dasslRes(double* t, double* y, double* yp, double* delta, int* ires, double* rpar, int*) {
    of(rpar).residual(*t, y, yp, delta, ires);
  }
  static void daspkRes(double* t, double* y, double* yp, double*, double* delta, int* ires, double* rpar, int*) {
    of(rpar).residual(*t, y, yp, delta, ires);
  }
  // The first `lower` rows of a band are left free for the pivots.
  static void jac(double* t, double* y, double* yp, double* pd, double* cj, double* rpar, int*) {
    DasslPeer& self = of(rpar);
    std::fill_n(pd, self.leading_ * self.n_, 0);
    static_cast<void>(self.problem_.jacobian(*t, y, yp, *cj, self.J_));
    self.J_.forEach([&](Index i, Index j, double value) {
      const Index row = self.banded_ ? i - j + self.lower_ + self.upper_ : i;
      const bool fits = !self.banded_ || (i - j <= self.lower_ && j - i <= self.upper_);
      if (fits) pd[row + j * self.leading_] = value;
      if (!fits) self.outgrown_ = true;
    });
  }

  LoadedDassl loaded_;
  PeerSetup setup_;
  PeerProblem& problem_;
  Index n_, lower_ = 0, upper_ = 0, leading_ = 0;
  bool banded_ = false, outgrown_ = false;
  Vec<double> y_, yp_, rtol_, atol_;
  std::array<int, 40> info_{};
  std::vector<double> rwork_;
  std::vector<int> iwork_;
  int idid_ = 0;
  PeerJacobian J_;
  Counters counts_;
};

}  // namespace

PeerEntry dasslPeer(const std::shared_ptr<const SharedLibrary>& library, std::string_view code) {
  LoadedDassl loaded{library, std::string(code), nullptr, nullptr};
  if (code == "ddassl") {
    loaded.dassl = library->get<Dassl>("ddassl_");
  } else if (code == "ddaspk") {
    loaded.daspk = library->get<Daspk>("ddaspk_");
  } else {
    return {};
  }
  return {.id = std::string(code),
          .title = code == "ddassl" ? "Petzold's DASSL, BDF of orders 1 to 5 for DAEs of index 1"
                                    : "Petzold's DASPK, BDF of orders 1 to 5 for DAEs of index 1, direct solver",
          .form = PeerForm::kDae,
          .max_index = 1,
          .make = [loaded](const PeerSetup& setup) { return std::make_unique<DasslPeer>(loaded, setup); }};
}

}  // namespace irk
