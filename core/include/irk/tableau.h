// The Butcher tableau of an implicit Runge-Kutta method.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "irk/scalar.h"

namespace irk {

/// The largest number of stages that ids, files and options accept.
inline constexpr Index kMaxStages = 100;

/// The coefficients A (s x s), b and c (s each), and b_hat (s) if there are embedded weights, with the orders that the
/// family or the file declares. Integrators refuse (Misuse) other sizes, coefficients that are not finite, and orders
/// that no method of s stages has. Whether the method has its orders is checked for files only.
template <class Real>
struct Tableau {
  std::string id;        ///< e.g. `radau_iia_5`, or the file it came from
  std::string family;    ///< e.g. `radau_iia`; `user` for a file that names no family
  Mat<Real> A;           ///< s x s
  Vec<Real> b, c;        ///< s each
  int order = 0;         ///< classical order p, 1 to 2 s
  int stage_order = 0;   ///< q of C(q), 0 to s
  Vec<Real> b_hat = {};  ///< s, the embedded weights of the same stages; empty: the method has none
  int order_hat = 0;     ///< classical order of A, b_hat, c; 0 without embedded weights

  Index stages() const { return b.size(); }

  /// The same tableau over another scalar; every coefficient is rounded once, in multiprecision to the WorkingDigits.
  template <class To>
  Tableau<To> cast() const {
    const auto round = [](const Real& x) {
      if constexpr (requires(const To& to) { to.rounded(); }) {
        return To(x).rounded();
      } else {
        return static_cast<To>(x);
      }
    };
    return {id,    family,      A.unaryExpr(round),     b.unaryExpr(round), c.unaryExpr(round),
            order, stage_order, b_hat.unaryExpr(round), order_hat};
  }
};

/// The methods of an integration: one method or, for variable order, members of one family by ascending number of
/// stages. Integrator checks them. Copies share the tableaus.
template <class Real>
struct Methods {
  std::shared_ptr<const std::vector<Tableau<Real>>> shared;  ///< the tableaus; not null
  std::size_t start = 0;                                     ///< index of the member that takes the first step

  Methods(Tableau<Real> one)  // NOLINT: one method is a method
      : Methods(alone(std::move(one)), 0) {}
  Methods(std::vector<Tableau<Real>> all, std::size_t first)
      : shared(std::make_shared<const std::vector<Tableau<Real>>>(std::move(all))), start(first) {}

  const std::vector<Tableau<Real>>& members() const { return *shared; }

 private:
  static std::vector<Tableau<Real>> alone(Tableau<Real> one) {
    std::vector<Tableau<Real>> all;
    all.push_back(std::move(one));  // a list in braces would copy it
    return all;
  }
};

}  // namespace irk
