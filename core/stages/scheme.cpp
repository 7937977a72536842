#include "core/stages/scheme.h"

#include <string>
#include <type_traits>

#include <Eigen/LU>

#include "core/base/kept.h"
#include "core/base/legendre.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
Structure<Real>::Structure(const Tableau<Real>& tableau) {
  const Index s = tableau.stages();
  // The round-off of a sum of s coefficients of magnitude <= 1.
  const Real tiny = Real(10.0 * static_cast<double>(s)) * Eigen::NumTraits<Real>::epsilon();
  const auto small = [&](const auto& x) { return x.cwiseAbs().maxCoeff() <= tiny; };
  stiffly_accurate = small(tableau.A.row(s - 1).transpose() - tableau.b);
  first = s > 1 && stiffly_accurate && small(tableau.A.row(0)) ? 1 : 0;
  const Mat<Real> implicit = tableau.A.bottomRightCorner(s - first, s - first);
  regular = Eigen::FullPivLU<Mat<Real>>(implicit).isInvertible();
}

template <class Real>
Scheme<Real>::Scheme(Tableau<Real> t)
    : Structure<Real>(t), tableau(std::move(t)), s(tableau.stages()), A(tableau.A), b(tableau.b), c(tableau.c) {
  A2.noalias() = A * A;
  bA.noalias() = A.transpose() * b;
  A_transposed = A.transpose();
  A1 = A.rowwise().sum();
  A2_transposed = A2.transpose();
  if (regular && first == 0) d = Mat<Real>(A.transpose()).fullPivLu().solve(b);

  Mat<Real> V(s, s);  // transposed: column i belongs to stage i
  for (Index i = 0; i < s; ++i) legendre<Real>(c[i], V.col(i));
  legendre_inverse = V.transpose().fullPivLu().inverse();
  legendre_inverse_transposed = legendre_inverse.transpose();
  Vec<Real> at(s);
  legendre<Real>(Real(1), at);
  end = legendre_inverse.transpose() * at;
  legendre<Real>(Real(0), at);
  start = legendre_inverse.transpose() * at;

  inside.resize(s, kParts - 1);
  inside_once.resize(s, kParts - 1);
  inside_twice.resize(s, kParts - 1);
  Vec<Real> p(s + 2), once(s + 1), twice(s);
  for (Index j = 1; j < kParts; ++j) {
    legendre<Real>(Real(j) / Real(kParts), p);
    integrateLegendre(p, once, twice);
    inside.col(j - 1) = legendre_inverse_transposed * p.head(s);
    inside_once.col(j - 1) = legendre_inverse_transposed * once.head(s);
    inside_twice.col(j - 1) = legendre_inverse_transposed * twice;
  }
}

namespace {

template <class Value, class Real>
std::shared_ptr<const Value> kept(const Tableau<Real>& tableau, const std::string& names) {
  if constexpr (std::is_same_v<Real, double>) {
    if (tableau.stages() <= kMostKeptStages) {
      static Kept<Value> all;
      std::string key = names;
      appendKey(tableau.A, key);
      appendKey(tableau.b, key);
      appendKey(tableau.c, key);
      appendKey(tableau.b_hat, key);
      return all.of(key, [&] { return Value(tableau); });
    }
  }
  return std::make_shared<const Value>(tableau);
}

}  // namespace

template <class Real>
std::shared_ptr<const Structure<Real>> structureOf(const Tableau<Real>& tableau) {
  return kept<Structure<Real>>(tableau, {});
}

template <class Real>
std::shared_ptr<const Scheme<Real>> schemeOf(const Tableau<Real>& tableau) {
  const auto orders = {tableau.order, tableau.stage_order, tableau.order_hat};
  std::string names = std::to_string(tableau.id.size()) + ' ' + tableau.id + tableau.family + '\n';
  for (const int order : orders) names += std::to_string(order) + '\n';
  return kept<Scheme<Real>>(tableau, names);
}

template std::shared_ptr<const Structure<double>> structureOf(const Tableau<double>&);
template std::shared_ptr<const Structure<BigFloat>> structureOf(const Tableau<BigFloat>&);
template std::shared_ptr<const Scheme<double>> schemeOf(const Tableau<double>&);
template std::shared_ptr<const Scheme<BigFloat>> schemeOf(const Tableau<BigFloat>&);
template struct Structure<double>;
template struct Structure<BigFloat>;
template struct Scheme<double>;
template struct Scheme<BigFloat>;

}  // namespace irk
