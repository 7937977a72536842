// Peers: integrators from outside the suite, of other libraries or your own, which run the suite's scenes beside its
// methods. A peer gets the scene as a PeerProblem and calls back after each accepted step:
//
//   class MySolver final : public irk::Peer { ... };
//   IRK_REGISTER {
//     irk::registerPeer({.id = "my_solver", .title = "My solver, order 2", .form = irk::PeerForm::kOde,
//                        .make = irk::makePeerOf<MySolver>});
//   }
//
// `irk solve van_der_pol --method my_solver.cpp` compiles and loads such a file. experiments/examples/ros2_solver.cpp
// is complete. In C: peer_c.h.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "irk/outcome.h"
#include "irk/registration.h"
#include "irk/scalar.h"
#include "irk/statistics.h"

namespace irk {

/// The form of the equations that a peer takes.
enum class PeerForm {
  kOde,   ///< y' = f(t, y); y = (u, v, x), where u' = v. Algebraic unknowns are eliminated.
  kMass,  ///< M y' = f(t, y) with a constant matrix M, which may be singular; M = I where no unknown is algebraic
  kDae,   ///< F(t, y, y') = 0; y = (u, v, x, z), and the first rows of F are u' - v
};

enum class PeerUnknown {
  kDifferential,
  kAlgebraic,   ///< y' of it does not appear
  kMultiplier,  ///< algebraic, the force of a position constraint
};

/// The sizes of a problem, and what its components are.
struct PeerLayout {
  Index n = 0;                        ///< components of y, and equations
  Index second_order = 0;             ///< y'[i] = y[i + second_order] for i < second_order
  Index switches = 0;                 ///< switching functions
  std::vector<PeerUnknown> unknowns;  ///< n
  std::vector<int> index;             ///< n: 1 for differential and index-1 unknowns, else 2 or 3
};

/// The pattern of a Jacobian in compressed columns.
struct PeerPattern {
  Index n = 0;
  bool full = true;               ///< all n x n entries, by columns; the two lists are then empty
  std::vector<int> column_start;  ///< n + 1 numbers
  std::vector<int> row;           ///< ascending in each column
  Index lower = 0, upper = 0;     ///< numbers of diagonals below and above the main one that have entries
};

struct PeerJacobian {
  std::shared_ptr<const PeerPattern> pattern;
  Vec<double> values;  ///< in the order of the pattern

  /// Calls f(row, column, value) for each entry.
  template <class F>
  void forEach(F&& f) const {
    const PeerPattern& p = *pattern;
    Index k = 0;
    for (Index j = 0; j < p.n; ++j) {
      const Index count = p.full ? p.n : p.column_start[static_cast<std::size_t>(j) + 1] - k;
      for (const Index first = k; k < first + count; ++k) {
        f(p.full ? k - first : static_cast<Index>(p.row[static_cast<std::size_t>(k)]), j, values[k]);
      }
    }
  }
  /// Writes all n x n entries by columns, `leading` numbers apart.
  void writeFull(double* to, Index leading) const;
};

/// The result of an evaluation.
enum class Evaluated {
  kDone = 0,
  kNotFinite = 1,  ///< a value is not finite: try a smaller step
  kStop = -1,      ///< the run is over (time limit, Ctrl-C): return at once, with any outcome
};

/// The equations that a peer integrates. Pointers point to `layout().n` numbers; y' may be null where the form has
/// none. Valid as long as the peer. Not safe for several threads.
class PeerProblem {
 public:
  virtual ~PeerProblem() = default;

  virtual const PeerLayout& layout() const = 0;
  /// f(t, y) of the forms kOde and kMass.
  virtual Evaluated rates(double t, const double* y, double* f) = 0;
  /// F(t, y, y') of the form kDae.
  virtual Evaluated residual(double t, const double* y, const double* yp, double* r) = 0;
  /// df/dy, or dF/dy + c dF/dy' of the form kDae; exact. `dfdt`, of the form kOde only, gets df/dt unless it is null.
  /// The pattern may grow when the scene switches.
  virtual Evaluated jacobian(double t, const double* y, const double* yp, double c, PeerJacobian& J,
                             double* dfdt = nullptr) = 0;
  /// The pattern of `jacobian` as known at present.
  virtual std::shared_ptr<const PeerPattern> pattern() const = 0;
  /// M of the form kMass, constant during one call of Peer::integrate. Without a pattern: M = I.
  virtual const PeerJacobian& mass() const = 0;
  /// The switching functions (`layout().switches` numbers): one that becomes positive is a switch.
  virtual void switching(double t, const double* y, const double* yp, double* g) = 0;
  /// Whether the run is over: time limit, Ctrl-C. Peers that may compute for long without an evaluation ask.
  virtual bool stopped() = 0;
};

/// What a peer is made for. The problem outlives the peer.
struct PeerSetup {
  PeerProblem& problem;
  double rtol;
  Vec<double> atol;        ///< per component of y: the error of y_i is weighed by rtol |y_i| + atol_i
  double h;                ///< the first step; 0 = the peer's choice
  double h_max;            ///< the largest step
  bool locate;             ///< steps end where a switching function becomes positive
  std::int64_t max_steps;  ///< accepted steps of the whole run
};

/// Where an integration begins. The values of y and y' are consistent.
struct PeerStart {
  double t;
  const double* y;
  const double* yp;  ///< null where the form has none
  bool new_run;      ///< false: a restart after a switch of the same run
};

/// The end of an accepted step.
struct PeerStep {
  double t;
  const double* y;
  const double* yp = nullptr;  ///< of the form kDae
  const int* roots = nullptr;  ///< per switching function: other than 0 where the step ends at its root; or null
};

enum class PeerNext { kContinue, kReturn };
/// To be called after each accepted step; after kReturn `integrate` has to return.
using PeerAccepted = std::function<PeerNext(const PeerStep&)>;

/// One integrator with its own control of step and order. Use one object per thread.
class Peer {
 public:
  virtual ~Peer() = default;

  /// Integrates from `start` to `t_end`, exactly, without steps beyond it, and calls `accepted` after each step.
  /// Discards all history. Returns kSuccess at t_end and after kReturn; else the reason of the failure.
  [[nodiscard]] virtual Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) = 0;
  /// Adds the counts of the last `integrate`, except those of accepted steps and evaluations, which the suite counts.
  /// Counts that are not known stay 0.
  virtual void count(Counters& counters) const { static_cast<void>(counters); }
  /// Why the last `integrate` failed, in one line.
  virtual std::string message() const { return ""; }
};

/// A peer in the catalogue of methods.
struct PeerEntry {
  std::string id;
  std::string title;
  PeerForm form = PeerForm::kOde;
  int max_index = 1;         ///< the largest index that it solves, 1 to 3; without effect for kOde
  bool finds_roots = false;  ///< its steps can end at roots of switching functions
  std::function<std::unique_ptr<Peer>(const PeerSetup&)> make = {};
  /// A hash of the file that it comes from: part of the key of its runs. registerPeer sets it where it is empty and
  /// the program is loading a file.
  std::string source = {};

  bool takesConstraints() const { return form != PeerForm::kOde; }
};

/// For PeerEntry::make: a P made of the setup.
template <class P>
std::unique_ptr<Peer> makePeerOf(const PeerSetup& setup) {
  return std::make_unique<P>(setup);
}

/// Makes a peer known under its id wherever a method's id is allowed. Throws Misuse for an id that is taken, naming
/// both; for an id with other characters than letters, digits, '_', '-' and '.'; and for an entry without `make`. Not
/// while other threads use the catalogue.
void registerPeer(PeerEntry entry);

}  // namespace irk
