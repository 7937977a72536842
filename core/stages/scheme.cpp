#include "core/stages/scheme.h"

#include <string>
#include <type_traits>
#include <utility>

#include <Eigen/LU>

#include "core/base/kept.h"
#include "core/base/legendre.h"
#include "core/base/number_text.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk {

namespace {

// Members of A, b or c.
template <class Real, int Columns>
void requireFinite(const Tableau<Real>& tableau, const char* name,
                   const Eigen::Matrix<Real, Eigen::Dynamic, Columns>& numbers) {
  using std::isfinite;  // for double; other scalars are found by their namespace
  if (numbers.allFinite()) return;
  for (Index i = 0; i < numbers.size(); ++i) {
    if (isfinite(numbers.data()[i])) continue;
    const Index row = i % numbers.rows(), column = i / numbers.rows();
    throw Misuse("tableau '" + tableau.id + "': " + name + "[" + std::to_string(row) +
                 (numbers.cols() > 1 ? ", " + std::to_string(column) : "") +
                 "] = " + numberText(static_cast<double>(numbers.data()[i])) + ": a finite number is expected");
  }
}

}  // namespace

template <class Real>
void requireTableau(const Tableau<Real>& tableau) {
  const Index s = tableau.A.rows();
  const auto fail = [&](const std::string& what) { throw Misuse("tableau '" + tableau.id + "': " + what); };
  if (s == 0 || tableau.A.cols() != s) {
    fail("A is " + std::to_string(s) + " x " + std::to_string(tableau.A.cols()) +
         ": a square matrix of at least one row is expected");
  }
  for (const auto& [name, size] : {std::pair("b", tableau.b.size()), std::pair("c", tableau.c.size())}) {
    if (size == s) continue;
    fail(std::string(name) + " has " + std::to_string(size) + " numbers: " + std::to_string(s) +
         " are expected, one for each row of A");
  }
  requireFinite(tableau, "A", tableau.A);
  requireFinite(tableau, "b", tableau.b);
  requireFinite(tableau, "c", tableau.c);
  const auto requireOrder = [&](const char* name, int order, const Range& range) {
    if (!range.contains(order)) requireInRange("tableau '" + tableau.id + "': " + name, order, range);
  };
  requireOrder("order", tableau.order, Range::integers(1, 2 * s));
  requireOrder("stage_order", tableau.stage_order, Range::integers(0, s));
}

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
      std::string key;
      const auto numbers = static_cast<std::size_t>((tableau.stages() + 3) * tableau.stages());
      key.reserve(names.size() + numbers * sizeof(double));
      key = names;
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

template void requireTableau(const Tableau<double>&);
template void requireTableau(const Tableau<BigFloat>&);
template std::shared_ptr<const Structure<double>> structureOf(const Tableau<double>&);
template std::shared_ptr<const Structure<BigFloat>> structureOf(const Tableau<BigFloat>&);
template std::shared_ptr<const Scheme<double>> schemeOf(const Tableau<double>&);
template std::shared_ptr<const Scheme<BigFloat>> schemeOf(const Tableau<BigFloat>&);
template struct Structure<double>;
template struct Structure<BigFloat>;
template struct Scheme<double>;
template struct Scheme<BigFloat>;

}  // namespace irk
