#include "core/sparse_lu.h"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/dense_lu.h"
#include "core/misuse.h"
#include "core/multiprecision.h"

namespace irk {
namespace {

// Old pivots serve as long as the smallest of them, relative to the largest, is not this much
// smaller than when they were chosen.
constexpr double kSmallerPivot = 1e-3;

klu_common defaults() {
  klu_common common;
  klu_defaults(&common);
  common.btf = 0;  // one block: nothing beside L and U
  return common;
}

template <class T>
constexpr bool kHasKlu = std::is_same_v<T, double> || std::is_same_v<T, std::complex<double>>;

// KLU takes arrays as not const, and changes none of these.
int* indices(const std::vector<int>& x) { return const_cast<int*>(x.data()); }

// Pivots beside the diagonal fill more than the analysis foresees; there is room for this many times
// as much.
constexpr std::size_t kRoom = 2;

template <class Entry>
void fit(std::vector<Entry>& x, int size) {
  const auto entries = static_cast<std::size_t>(size);
  if (x.capacity() < entries) x.reserve(kRoom * entries);
  x.resize(entries);
}

// What KLU allocates for one factorization.
template <class T>
struct Pivoting {
  klu_common common = defaults();
  klu_numeric* value = nullptr;

  Pivoting(const SparseAnalysis& analysis, klu_symbolic* symbolic, Vec<T>& values) {
    int* const columns = indices(analysis.column_start);
    int* const rows = indices(analysis.row);
    if constexpr (std::is_same_v<T, double>) {
      value = klu_factor(columns, rows, values.data(), symbolic, &common);
    } else {
      value = klu_z_factor(columns, rows, reinterpret_cast<double*>(values.data()), symbolic, &common);
    }
  }
  ~Pivoting() {
    if (!value) return;
    if constexpr (std::is_same_v<T, double>) {
      klu_free_numeric(&value, &common);
    } else {
      klu_z_free_numeric(&value, &common);
    }
  }
  Pivoting(const Pivoting&) = delete;
  Pivoting& operator=(const Pivoting&) = delete;
  bool good() const { return value && common.status == KLU_OK; }

  /// Columns of L and U with their diagonals, rows ascending. Without values KLU extracts no pattern.
  template <class Factors>
  void extract(klu_symbolic* symbolic, Factors& f) {
    fit(f.l_row, value->lnz);
    fit(f.u_row, value->unz);
    const int most = std::max(value->lnz, value->unz);
    fit(f.re, most);
    if constexpr (std::is_same_v<T, double>) {
      klu_sort(symbolic, value, &common);
      klu_extract(value, symbolic, f.l_start.data(), f.l_row.data(), f.re.data(), f.u_start.data(),
                  f.u_row.data(), f.re.data(), nullptr, nullptr, nullptr, f.p.data(), f.q.data(),
                  f.klu_scale.data(), nullptr, &common);
    } else {
      fit(f.im, most);
      klu_z_sort(symbolic, value, &common);
      klu_z_extract(value, symbolic, f.l_start.data(), f.l_row.data(), f.re.data(), f.im.data(),
                    f.u_start.data(), f.u_row.data(), f.re.data(), f.im.data(), nullptr, nullptr,
                    nullptr, nullptr, f.p.data(), f.q.data(), f.klu_scale.data(), nullptr, &common);
    }
  }
};

}  // namespace

struct SparseAnalysis::Symbolic {
  klu_symbolic* value = nullptr;
};

SparseAnalysis::SparseAnalysis(std::vector<int> starts, std::vector<int> rows)
    : column_start(std::move(starts)),
      row(std::move(rows)),
      symbolic_(std::make_unique<Symbolic>()) {
  klu_common common = defaults();
  symbolic_->value =
      klu_analyze(static_cast<int>(n()), indices(column_start), indices(row), &common);
  if (!symbolic_->value) throw Misuse("a pattern that KLU cannot analyse");
}

SparseAnalysis::~SparseAnalysis() {
  klu_common common = defaults();
  klu_free_symbolic(&symbolic_->value, &common);
}

template <class T>
SparseLu<T>::SparseLu(std::shared_ptr<const SparseAnalysis> analysis)
    : analysis_(std::move(analysis)),
      values_(static_cast<Index>(analysis_->row.size())),
      work_(static_cast<std::size_t>(analysis_->n())) {
  if (!kHasKlu<T>) {
    throw Misuse("illegal combination: sparse systems in multiprecision: KLU is for double");
  }
  const auto n = static_cast<std::size_t>(analysis_->n());
  const std::size_t entries = analysis_->row.size();
  for (auto* starts : {&f_.l_start, &f_.u_start, &f_.source_start}) starts->resize(n + 1);
  for (auto* each : {&f_.p, &f_.q, &f_.row_of}) each->resize(n);
  for (auto* each : {&f_.source, &f_.target}) each->resize(entries);
  f_.scale.resize(n);
  f_.klu_scale.resize(n);
  const klu_symbolic& symbolic = *analysis_->symbolic_->value;
  const auto l = static_cast<std::size_t>(std::max(symbolic.lnz, 0.0));
  const auto u = static_cast<std::size_t>(std::max(symbolic.unz, 0.0));
  f_.l_row.reserve(kRoom * l);
  f_.l.reserve(kRoom * l);
  f_.u_row.reserve(kRoom * u);
  f_.u.reserve(kRoom * u);
  f_.re.reserve(kRoom * std::max(l, u));
  if (!std::is_same_v<T, double>) f_.im.reserve(kRoom * std::max(l, u));
  f_.inverse_pivot.resize(n);
}

template <class T>
Outcome SparseLu<T>::factorize() {
  if (!values_.allFinite()) return Outcome::kNotFinite;
  return refactorize() || pivot() ? Outcome::kSuccess : Outcome::kSingular;
}

// Left-looking, column by column, with the pattern and the pivots that are there.
template <class T>
bool SparseLu<T>::refactorize() {
  if (!pivoted_) return false;
  const auto n = static_cast<int>(analysis_->n());
  T* const x = work_.data();
  Size least(0), most(0);
  for (int k = 0; k < n; ++k) {
    const auto c = static_cast<std::size_t>(k);
    const int u_end = f_.u_start[c + 1], l_end = f_.l_start[c + 1];
    for (int e = f_.u_start[c]; e < u_end; ++e) x[f_.u_row[static_cast<std::size_t>(e)]] = T(0);
    for (int e = f_.l_start[c]; e < l_end; ++e) x[f_.l_row[static_cast<std::size_t>(e)]] = T(0);
    x[k] = T(0);
    for (int e = f_.source_start[c]; e < f_.source_start[c + 1]; ++e) {
      const auto at = static_cast<std::size_t>(e);
      const int row = f_.target[at];
      x[row] = values_[f_.source[at]] * f_.scale[static_cast<std::size_t>(row)];
    }
    for (int e = f_.u_start[c]; e < u_end; ++e) {
      const auto at = static_cast<std::size_t>(e);
      const auto j = static_cast<std::size_t>(f_.u_row[at]);
      const T u = x[j];
      f_.u[at] = u;
      for (int i = f_.l_start[j]; i < f_.l_start[j + 1]; ++i) {
        const auto below = static_cast<std::size_t>(i);
        x[f_.l_row[below]] -= detail::product(f_.l[below], u);
      }
    }
    const Size pivot = detail::magnitude(x[k]);
    if (!(pivot > Size(0)) || !std::isfinite(static_cast<double>(pivot))) return false;
    least = k == 0 ? pivot : std::min(least, pivot);
    most = std::max(most, pivot);
    const T inverse = detail::inverse(x[k]);
    f_.inverse_pivot[c] = inverse;
    for (int e = f_.l_start[c]; e < l_end; ++e) {
      const auto at = static_cast<std::size_t>(e);
      f_.l[at] = detail::product(x[f_.l_row[at]], inverse);
    }
  }
  condition_ = static_cast<double>(Size(least / most));
  return condition_ >= kSmallerPivot * chosen_at_;
}

// New pivots of KLU's, and the factors with them.
template <class T>
bool SparseLu<T>::pivot() {
  if constexpr (kHasKlu<T>) {
    pivoted_ = false;
    condition_ = chosen_at_ = 0;
    ++pivotings_;
    klu_symbolic* const symbolic = analysis_->symbolic_->value;
    Pivoting<T> klu(*analysis_, symbolic, values_);
    if (!klu.good()) return false;
    klu.extract(symbolic, f_);
    std::transform(f_.klu_scale.begin(), f_.klu_scale.end(), f_.scale.begin(),
                   [](double s) { return 1 / s; });
    // The diagonals, first in a column of L and last in one of U, are kept elsewhere.
    const std::size_t n = f_.p.size();
    std::size_t l = 0, u = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const auto l_first = static_cast<std::size_t>(f_.l_start[k]) + 1;
      const auto l_end = static_cast<std::size_t>(f_.l_start[k + 1]);
      const auto u_first = static_cast<std::size_t>(f_.u_start[k]);
      const auto u_end = static_cast<std::size_t>(f_.u_start[k + 1]) - 1;
      f_.l_start[k] = static_cast<int>(l);
      f_.u_start[k] = static_cast<int>(u);
      for (std::size_t e = l_first; e < l_end; ++e) f_.l_row[l++] = f_.l_row[e];
      for (std::size_t e = u_first; e < u_end; ++e) f_.u_row[u++] = f_.u_row[e];
    }
    f_.l_start[n] = static_cast<int>(l);
    f_.u_start[n] = static_cast<int>(u);
    fit(f_.l, f_.l_start[n]);
    fit(f_.u, f_.u_start[n]);
    for (std::size_t k = 0; k < n; ++k) {
      f_.row_of[static_cast<std::size_t>(f_.p[k])] = static_cast<int>(k);
    }
    int at = 0;
    for (std::size_t k = 0; k < n; ++k) {
      f_.source_start[k] = at;
      const auto column = static_cast<std::size_t>(f_.q[k]);
      for (int e = analysis_->column_start[column]; e < analysis_->column_start[column + 1]; ++e) {
        f_.source[static_cast<std::size_t>(at)] = e;
        f_.target[static_cast<std::size_t>(at++)] =
            f_.row_of[static_cast<std::size_t>(analysis_->row[static_cast<std::size_t>(e)])];
      }
    }
    f_.source_start[n] = at;
    pivoted_ = true;
    pivoted_ = refactorize();
    chosen_at_ = condition_;
    return pivoted_;
  }
  return false;
}

template <class T>
void SparseLu<T>::solve(T* b) {
  const std::size_t n = work_.size();
  T* const x = work_.data();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[f_.p[k]] * f_.scale[k];
  for (std::size_t k = 0; k < n; ++k) {
    const T here = x[k];
    for (int i = f_.l_start[k]; i < f_.l_start[k + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      x[f_.l_row[at]] -= detail::product(f_.l[at], here);
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    const T here = detail::product(x[k], f_.inverse_pivot[k]);
    for (int i = f_.u_start[k]; i < f_.u_start[k + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      x[f_.u_row[at]] -= detail::product(f_.u[at], here);
    }
    b[f_.q[k]] = here;
  }
}

IRK_INSTANTIATE_CLASS(SparseLu)
template class SparseLu<std::complex<double>>;
template class SparseLu<std::complex<mp50>>;
template class SparseLu<std::complex<mp100>>;

}  // namespace irk
