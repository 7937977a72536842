#include "experiments/runs/peers/loaded/adapters.h"

#include <fmt/format.h>

#include <mutex>
#include <vector>

#include "irk/peer_c.h"

namespace irk {
namespace {

struct Functions {
  std::shared_ptr<const SharedLibrary> library;
  decltype(irk_peer_solve)* solve;
  std::shared_ptr<std::mutex> one_at_a_time;  // null if several threads may solve at the same time
};

Outcome outcomeOf(int returned) {
  switch (returned) {
    case IRK_PEER_SUCCESS:
      return Outcome::kSuccess;
    case IRK_PEER_NEWTON_FAILED:
      return Outcome::kNewtonFailed;
    case IRK_PEER_MAX_STEPS:
      return Outcome::kMaxSteps;
    case IRK_PEER_NO_FINITE_VALUES:
      return Outcome::kNotFinite;
    case IRK_PEER_SINGULAR:
      return Outcome::kSingular;
    default:
      return Outcome::kStepTooSmall;
  }
}

class CPeer final : public Peer {
 public:
  CPeer(Functions functions, const PeerSetup& setup)
      : functions_(std::move(functions)), problem_(setup.problem), atol_(setup.atol) {
    const PeerLayout& layout = problem_.layout();
    mass_.resize(layout.n * layout.n);
    table_.self = this;
    table_.n = static_cast<int>(layout.n);
    table_.second_order = static_cast<int>(layout.second_order);
    table_.switches = static_cast<int>(layout.switches);
    table_.index = layout.index.data();
    table_.rtol = setup.rtol;
    table_.atol = atol_.data();
    table_.h = setup.h;
    table_.h_max = setup.h_max;
    table_.locate = setup.locate ? 1 : 0;
    table_.max_steps = setup.max_steps;
    setCallbacks();
  }

  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    const Index n = problem_.layout().n;
    y_ = ConstVec<double>(start.y, n);
    if (start.yp) yp_ = ConstVec<double>(start.yp, n);
    if (problem_.mass().pattern) {
      problem_.mass().writeFull(mass_.data(), n);
      table_.mass = mass_.data();
    }
    accepted_ = &accepted;
    counts_ = {};
    message_ = "";
    std::unique_lock<std::mutex> lock;
    if (functions_.one_at_a_time) lock = std::unique_lock(*functions_.one_at_a_time);
    const int returned =
        functions_.solve(&table_, start.t, t_end, y_.data(), start.yp ? yp_.data() : nullptr, &counts_);
    if (returned < IRK_PEER_SUCCESS || returned > IRK_PEER_SINGULAR) {
      message_ = fmt::format("irk_peer_solve returned {}, 0 to {} is allowed:", returned, +IRK_PEER_SINGULAR);
    } else if (returned != IRK_PEER_SUCCESS && message_.empty()) {
      message_ = fmt::format("irk_peer_solve returned {}", returned);
    }
    return outcomeOf(returned);
  }

  void count(Counters& counters) const override {
    counters.factorizations += counts_.factorizations;
    counters.solves += counts_.solves;
    counters.newton_iterations += counts_.newton_iterations;
    counters.steps_rejected_error += counts_.rejected_by_error;
    counters.steps_rejected_newton += counts_.rejected_by_newton;
  }
  std::string message() const override { return message_; }

 private:
  static CPeer& of(void* self) { return *static_cast<CPeer*>(self); }

  void setCallbacks() {
    table_.rates = [](void* self, double t, const double* y, double* f) {
      return static_cast<int>(of(self).problem_.rates(t, y, f));
    };
    table_.residual = [](void* self, double t, const double* y, const double* yp, double* r) {
      return static_cast<int>(of(self).problem_.residual(t, y, yp, r));
    };
    table_.jacobian = [](void* self, double t, const double* y, const double* yp, double c, double* J) {
      CPeer& peer = of(self);
      const Evaluated evaluated = peer.problem_.jacobian(t, y, yp, c, peer.J_);
      peer.J_.writeFull(J, peer.problem_.layout().n);
      return static_cast<int>(evaluated);
    };
    table_.pattern = [](void* self, const int** column_start, const int** row) {
      CPeer& peer = of(self);
      peer.pattern_ = peer.problem_.pattern();
      *column_start = peer.pattern_->column_start.data();
      *row = peer.pattern_->row.data();
      return static_cast<int>(peer.pattern_->row.size());
    };
    table_.sparse_jacobian = [](void* self, double t, const double* y, const double* yp, double c,
                                const double** values) {
      CPeer& peer = of(self);
      const Evaluated evaluated = peer.problem_.jacobian(t, y, yp, c, peer.J_);
      *values = peer.J_.values.data();
      return static_cast<int>(evaluated);
    };
    table_.switching = [](void* self, double t, const double* y, const double* yp, double* g) {
      of(self).problem_.switching(t, y, yp, g);
    };
    table_.accepted = [](void* self, double t, const double* y, const double* yp, const int* roots) {
      return (*of(self).accepted_)({t, y, yp, roots}) == PeerNext::kReturn ? 1 : 0;
    };
    table_.stopped = [](void* self) { return of(self).problem_.stopped() ? 1 : 0; };
    table_.explain = [](void* self, const char* text) {
      std::string& message = of(self).message_ = text ? text : "";
      for (char& c : message) c = c == '\n' ? ' ' : c;
    };
  }

  Functions functions_;
  PeerProblem& problem_;
  Vec<double> atol_, mass_, y_, yp_;
  irk_peer_problem table_{};
  irk_peer_counts counts_{};
  PeerJacobian J_;
  std::shared_ptr<const PeerPattern> pattern_;
  const PeerAccepted* accepted_ = nullptr;
  std::string message_;
};

PeerForm formOf(const SharedLibrary& library, int form) {
  switch (form) {
    case IRK_PEER_ODE:
      return PeerForm::kOde;
    case IRK_PEER_MASS:
      return PeerForm::kMass;
    case IRK_PEER_DAE:
      return PeerForm::kDae;
    default:
      library.refuse(fmt::format("irk_peer_describe()->form = {}: 0, 1 or 2 is allowed", form));
  }
}

}  // namespace

PeerEntry cPeer(const std::shared_ptr<const SharedLibrary>& library, const std::string& id) {
  const int version = library->get<decltype(irk_peer_version)>("irk_peer_version")();
  if (version != IRK_PEER_VERSION) {
    library->refuse(
        fmt::format("irk_peer_version() = {}: this program has version {} of irk/peer_c.h", version, IRK_PEER_VERSION));
  }
  const auto* description = library->get<decltype(irk_peer_describe)>("irk_peer_describe")();
  if (!description) library->refuse("irk_peer_describe() = NULL");
  const bool has_index = description->form != IRK_PEER_ODE;
  if (has_index && (description->max_index < 1 || description->max_index > 3)) {
    library->refuse(fmt::format("irk_peer_describe()->max_index = {}: 1, 2 or 3 is allowed", description->max_index));
  }
  const auto mutex = description->concurrent ? nullptr : std::make_shared<std::mutex>();
  const Functions functions{library, library->get<decltype(irk_peer_solve)>("irk_peer_solve"), mutex};
  return {.id = id,
          .title = description->title ? description->title : "",
          .form = formOf(*library, description->form),
          .max_index = has_index ? description->max_index : 1,
          .finds_roots = description->finds_roots != 0,
          .make = [functions](const PeerSetup& setup) { return std::make_unique<CPeer>(functions, setup); }};
}

}  // namespace irk
