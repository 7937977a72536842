#include "experiments/runs/peers/loaded/adapters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "irk/misuse.h"

namespace irk {
namespace {

// The codes pass RPAR to all callbacks unchanged; here it is the address of the peer.
extern "C" {
using Fcn = void(int* n, double* x, double* y, double* f, double* rpar, int* ipar);
using Jac = void(int* n, double* x, double* y, double* dfy, int* ldfy, double* rpar, int* ipar);
using Mas = void(int* n, double* am, int* lmas, double* rpar, int* ipar);
using Dfx = void(int* n, double* x, double* y, double* fx, double* rpar, int* ipar);
using Solout = void(int* nr, double* xold, double* x, double* y, double* cont, int* lrc, int* n, double* rpar,
                    int* ipar, int* irtrn);
using SeulexSolout = void(int* nr, double* xold, double* x, double* y, double* rc, int* lrc, int* ic, int* lic, int* n,
                          double* rpar, int* ipar, int* irtrn);
// RADAU and RADAU5.
using RadauCode = void(int* n, Fcn*, double* x, double* y, double* xend, double* h, double* rtol, double* atol,
                       int* itol, Jac*, int* ijac, int* mljac, int* mujac, Mas*, int* imas, int* mlmas, int* mumas,
                       Solout*, int* iout, double* work, int* lwork, int* iwork, int* liwork, double* rpar, int* ipar,
                       int* idid);
using RodasCode = void(int* n, Fcn*, int* ifcn, double* x, double* y, double* xend, double* h, double* rtol,
                       double* atol, int* itol, Jac*, int* ijac, int* mljac, int* mujac, Dfx*, int* idfx, Mas*,
                       int* imas, int* mlmas, int* mumas, Solout*, int* iout, double* work, int* lwork, int* iwork,
                       int* liwork, double* rpar, int* ipar, int* idid);
using SeulexCode = void(int* n, Fcn*, int* ifcn, double* x, double* y, double* xend, double* h, double* rtol,
                        double* atol, int* itol, Jac*, int* ijac, int* mljac, int* mujac, Mas*, int* imas, int* mlmas,
                        int* mumas, SeulexSolout*, int* iout, double* work, int* lwork, int* iwork, int* liwork,
                        double* rpar, int* ipar, int* idid);
}

enum class Sequence { kRadau, kRodas, kSeulex };

struct Code {
  std::string_view id, symbol, title;
  Sequence sequence;
  int max_index;
  std::size_t h_max, max_steps;  // their places in WORK and IWORK, from 0
};
constexpr Code kCodes[] = {
    {"radau", "radau_", "Hairer and Wanner's RADAU, Radau IIA of orders 5, 9, 13", Sequence::kRadau, 3, 6, 1},
    {"radau5", "radau5_", "Hairer and Wanner's RADAU5, Radau IIA of order 5", Sequence::kRadau, 3, 6, 1},
    {"rodas", "rodas_", "Hairer and Wanner's RODAS, Rosenbrock of order 4", Sequence::kRodas, 1, 1, 0},
    {"seulex", "seulex_", "Hairer and Wanner's SEULEX, extrapolated linearly implicit Euler", Sequence::kSeulex, 1, 1,
     1}};

struct LoadedHairer {
  std::shared_ptr<const SharedLibrary> library;
  const Code* code;
  void (*function)();
};

// The part of a matrix that a code wants: all of it, or with M1 > 0 the rows from M1 on; full or by diagonals.
struct Shape {
  Index m1 = 0;
  bool banded = false;
  Index lower = 0, upper = 0;

  // Calls f(row, column) with the entry's place in the code's array; returns false if the array has no place for it.
  template <class F>
  bool place(Index i, Index j, bool square, F&& f) const {
    if (i < m1) return true;  // the code knows these rows
    const Index row = i - m1, column = square ? j - m1 : j, relative = j < m1 ? j : j - m1;
    if (column < 0) return true;
    if (!banded) {
      f(row, column);
      return true;
    }
    if (row - relative > lower || relative - row > upper) return false;
    f(row - relative + upper, column);
    return true;
  }
};

class Hairer final : public Peer {
 public:
  Hairer(LoadedHairer loaded, const PeerSetup& setup)
      : loaded_(std::move(loaded)), setup_(setup), problem_(setup.problem) {}

  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    accepted_ = &accepted;
    t_end_ = t_end;
    t_ = start.t;
    h_ = setup_.h;
    y_ = ConstVec<double>(start.y, problem_.layout().n);
    counts_ = {};
    returned_ = false;
    const std::unique_lock lock(loaded_.library->oneAtATime());
    do {
      outgrown_ = false;
      choose();
      call();
    } while (outgrown_ && !returned_ && idid_ == 2 && t_ < t_end_);
    return outcome();
  }

  void count(Counters& counters) const override {
    counters.factorizations += counts_.factorizations;
    counters.solves += counts_.solves;
    counters.newton_iterations += counts_.newton_iterations;
    counters.steps_rejected_error += counts_.steps_rejected_error;
  }
  std::string message() const override {
    return fmt::format("{} returned IDID = {} ({})", loaded_.code->id, idid_, meaning());
  }

 private:
  // Chooses M1, and bands if they take less than half of the full work.
  void choose() {
    const PeerLayout& layout = problem_.layout();
    shape_ = {.m1 = layout.second_order};
    const auto pattern = problem_.pattern();
    const Index n = layout.n - shape_.m1;
    if (pattern->full) return;
    const auto widen = [this](Index i, Index j) {
      if (i < shape_.m1) return;
      const Index row = i - shape_.m1, relative = j < shape_.m1 ? j : j - shape_.m1;
      shape_.lower = std::max(shape_.lower, row - relative);
      shape_.upper = std::max(shape_.upper, relative - row);
    };
    PeerJacobian entries{pattern, Vec<double>::Zero(static_cast<Index>(pattern->row.size()))};
    entries.forEach([&](Index i, Index j, double) { widen(i, j); });
    if (problem_.mass().pattern) {
      problem_.mass().forEach([&](Index i, Index j, double value) {
        if (value != 0 && j >= shape_.m1) widen(i, j);
      });
    }
    shape_.banded = 2 * (2 * shape_.lower + shape_.upper + 1) <= n;
  }

  void call() {
    const PeerLayout& layout = problem_.layout();
    int n = static_cast<int>(layout.n), itol = 1, ijac = 1, iout = 1, ifcn = 1, idfx = 0, ipar = 0;
    const int reduced = n - static_cast<int>(shape_.m1);
    int mljac = shape_.banded ? static_cast<int>(shape_.lower) : reduced, mujac = static_cast<int>(shape_.upper);
    int mlmas = mljac, mumas = mujac, imas = problem_.mass().pattern ? 1 : 0;
    const int rows = shape_.banded ? 2 * mljac + mujac + 1 : reduced;
    // Enough for all four: RADAU has up to 7 stages, SEULEX up to 12 columns.
    const double numbers = n * (9.0 * rows + 40) + 200;
    if (numbers > std::numeric_limits<int>::max()) {
      throw Misuse(fmt::format("{}: {} unknowns need {:.2g} numbers of work space, more than its integers can count",
                               loaded_.code->id, n, numbers));
    }
    int lwork = static_cast<int>(numbers), liwork = 5 * n + 60;
    work_.assign(static_cast<std::size_t>(lwork), 0);
    iwork_.assign(static_cast<std::size_t>(liwork), 0);
    if (setup_.h_max < t_end_ - t_) work_[loaded_.code->h_max] = setup_.h_max;
    iwork_[loaded_.code->max_steps] = static_cast<int>(
        std::min<std::int64_t>(std::max<std::int64_t>(2 * setup_.max_steps, 100), std::numeric_limits<int>::max()));
    iwork_[8] = iwork_[9] = static_cast<int>(shape_.m1);
    if (loaded_.code->sequence == Sequence::kRadau) setIndices(layout);
    rtol_.setConstant(n, setup_.rtol);
    atol_ = setup_.atol;
    double* const self = reinterpret_cast<double*>(this);
    double x = t_, xend = t_end_;
    idid_ = 0;
    switch (loaded_.code->sequence) {
      case Sequence::kRadau:
        reinterpret_cast<RadauCode*>(loaded_.function)(
            &n, fcn, &x, y_.data(), &xend, &h_, rtol_.data(), atol_.data(), &itol, jac, &ijac, &mljac, &mujac, mas,
            &imas, &mlmas, &mumas, solout, &iout, work_.data(), &lwork, iwork_.data(), &liwork, self, &ipar, &idid_);
        break;
      case Sequence::kRodas:
        reinterpret_cast<RodasCode*>(loaded_.function)(&n, fcn, &ifcn, &x, y_.data(), &xend, &h_, rtol_.data(),
                                                       atol_.data(), &itol, jac, &ijac, &mljac, &mujac, dfx, &idfx, mas,
                                                       &imas, &mlmas, &mumas, solout, &iout, work_.data(), &lwork,
                                                       iwork_.data(), &liwork, self, &ipar, &idid_);
        break;
      case Sequence::kSeulex:
        reinterpret_cast<SeulexCode*>(loaded_.function)(&n, fcn, &ifcn, &x, y_.data(), &xend, &h_, rtol_.data(),
                                                        atol_.data(), &itol, jac, &ijac, &mljac, &mujac, mas, &imas,
                                                        &mlmas, &mumas, seulexSolout, &iout, work_.data(), &lwork,
                                                        iwork_.data(), &liwork, self, &ipar, &idid_);
        break;
    }
    counts_.steps_rejected_error += iwork_[17];
    counts_.factorizations += iwork_[18];
    counts_.solves += iwork_[19];
    if (loaded_.code->sequence == Sequence::kRadau) counts_.newton_iterations += iwork_[19];
  }

  // The codes expect unknowns sorted by their index. An unknown behind others of a higher index is given that index.
  void setIndices(const PeerLayout& layout) {
    std::size_t highest = 1;
    for (const int index : layout.index) {
      highest = std::max(highest, static_cast<std::size_t>(index));
      ++iwork_[3 + highest];
    }
  }

  Outcome outcome() const {
    switch (idid_) {
      case 1:
      case 2:
        return Outcome::kSuccess;
      case -2:
        return Outcome::kMaxSteps;
      case -4:
        return Outcome::kSingular;
      default:
        return Outcome::kStepTooSmall;
    }
  }
  const char* meaning() const {
    if (loaded_.code->sequence == Sequence::kSeulex) return "unsuccessful";
    switch (idid_) {
      case -1:
        return "inconsistent input";
      case -2:
        return "more steps needed";
      case -3:
        return "step size becomes too small";
      case -4:
        return "matrix repeatedly singular";
      default:
        return "unknown";
    }
  }

  static Hairer& of(double* rpar) { return *reinterpret_cast<Hairer*>(rpar); }

  static void fcn(int*, double* x, double* y, double* f, double* rpar, int*) {
    Hairer& self = of(rpar);
    const Evaluated evaluated = self.problem_.rates(*x, y, f);
    if (evaluated == Evaluated::kDone) return;
    // This callback can neither end the run nor refuse an evaluation. With f = 0 the code soon accepts a step and calls
    // `solout`, which ends the run. A value that is not finite would be accepted (RADAU's error is MAX(NaN, 1e-10) =
    // 1e-10); a very large rate is a step that fails, which the code repeats with a shorter one.
    constexpr double kVeryLarge = 1e140;
    std::fill_n(f, self.y_.size(), evaluated == Evaluated::kStop ? 0 : kVeryLarge);
  }

  static void jac(int* n, double* x, double* y, double* dfy, int* ldfy, double* rpar, int*) {
    Hairer& self = of(rpar);
    static_cast<void>(self.problem_.jacobian(*x, y, nullptr, 0, self.J_));
    if (self.J_.pattern->full && self.shape_.m1 == 0) return self.J_.writeFull(dfy, *ldfy);
    std::fill_n(dfy, static_cast<std::ptrdiff_t>(*ldfy) * *n, 0);
    self.J_.forEach([&](Index i, Index j, double value) {
      const bool placed =
          self.shape_.place(i, j, false, [&](Index row, Index column) { dfy[row + column * *ldfy] = value; });
      if (!placed) self.outgrown_ = true;
    });
  }

  static void mas(int* n, double* am, int* lmas, double* rpar, int*) {
    Hairer& self = of(rpar);
    std::fill_n(am, static_cast<std::ptrdiff_t>(*lmas) * *n, 0);
    self.problem_.mass().forEach([&](Index i, Index j, double value) {
      if (value == 0) return;
      self.shape_.place(i, j, true, [&](Index row, Index column) { am[row + column * *lmas] = value; });
    });
  }

  static void dfx(int*, double*, double*, double*, double*, int*) {}

  static void solout(int* nr, double*, double* x, double* y, double*, int*, int*, double* rpar, int*, int* irtrn) {
    of(rpar).solved(*nr, *x, y, irtrn);
  }
  static void seulexSolout(int* nr, double*, double* x, double* y, double*, int*, int*, int*, int*, double* rpar, int*,
                           int* irtrn) {
    of(rpar).solved(*nr, *x, y, irtrn);
  }

  // The first call is for the start.
  void solved(int nr, double x, const double* y, int* irtrn) {
    if (nr == 1) return;
    const double round_off = 1e-13 * std::max(std::abs(t_end_), t_end_ - t_);
    t_ = t_end_ - x < round_off ? t_end_ : x;
    returned_ = (*accepted_)({t_, y}) == PeerNext::kReturn;
    if (returned_ || outgrown_) *irtrn = -1;
  }

  LoadedHairer loaded_;
  PeerSetup setup_;
  PeerProblem& problem_;
  Shape shape_;
  const PeerAccepted* accepted_ = nullptr;
  Vec<double> y_, rtol_, atol_;
  PeerJacobian J_;
  std::vector<double> work_;
  std::vector<int> iwork_;
  double t_ = 0, t_end_ = 0, h_ = 0;
  int idid_ = 0;
  bool returned_ = false, outgrown_ = false;
  Counters counts_;
};

}  // namespace

PeerEntry hairerPeer(const std::shared_ptr<const SharedLibrary>& library, std::string_view code) {
  const auto at = std::find_if(std::begin(kCodes), std::end(kCodes), [code](const Code& c) { return c.id == code; });
  if (at == std::end(kCodes)) return {};
  const LoadedHairer loaded{library, at, library->get<void()>(at->symbol.data())};
  return {.id = std::string(code),
          .title = std::string(at->title),
          .form = PeerForm::kMass,
          .max_index = at->max_index,
          .make = [loaded](const PeerSetup& setup) { return std::make_unique<Hairer>(loaded, setup); }};
}

}  // namespace irk
