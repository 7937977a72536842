#include "core/linear/sparse_lu.h"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/linear/dense_lu.h"
#include "irk/misuse.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

klu_common defaults() {
  klu_common common;
  klu_defaults(&common);
  common.btf = 0;  // no block triangular form: the factors are L and U only
  return common;
}

template <class T>
constexpr bool kHasKlu = std::is_same_v<T, double> || std::is_same_v<T, std::complex<double>>;

// KLU's functions take non-const arrays but do not change these.
int* indices(const std::vector<int>& x) { return const_cast<int*>(x.data()); }

// Brings KLU's arrays into the form of SparsePivots: removes the diagonals (the first entry in a column of L, the
// last in a column of U), inverts the scales, and lists where the entries of A go.
void finish(const SparseAnalysis& analysis, SparsePivots& f, std::vector<int>& row_of) {
  const std::size_t n = f.p.size();
  row_of.resize(n);
  std::size_t l = 0, u = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto l_first = static_cast<std::size_t>(f.l_start[k]) + 1;
    const auto l_end = static_cast<std::size_t>(f.l_start[k + 1]);
    const auto u_first = static_cast<std::size_t>(f.u_start[k]);
    const auto u_end = static_cast<std::size_t>(f.u_start[k + 1]) - 1;
    f.l_start[k] = static_cast<int>(l);
    f.u_start[k] = static_cast<int>(u);
    for (std::size_t e = l_first; e < l_end; ++e) f.l_row[l++] = f.l_row[e];
    for (std::size_t e = u_first; e < u_end; ++e) f.u_row[u++] = f.u_row[e];
    row_of[static_cast<std::size_t>(f.p[k])] = static_cast<int>(k);
    f.scale[k] = 1 / f.scale[k];
  }
  f.l_start[n] = static_cast<int>(l);
  f.u_start[n] = static_cast<int>(u);
  f.l_row.resize(l);
  f.u_row.resize(u);
  f.source_start.clear();
  f.source.clear();
  f.target.clear();
  for (std::size_t k = 0; k < n; ++k) {
    f.source_start.push_back(static_cast<int>(f.source.size()));
    const auto column = static_cast<std::size_t>(f.q[k]);
    for (int e = analysis.column_start[column]; e < analysis.column_start[column + 1]; ++e) {
      f.source.push_back(e);
      f.target.push_back(row_of[static_cast<std::size_t>(analysis.row[static_cast<std::size_t>(e)])]);
    }
  }
  f.source_start.push_back(static_cast<int>(f.source.size()));
}

// Owns KLU's numeric object for one factorization.
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

  /// Columns of L and U with their diagonals, rows ascending. KLU extracts a pattern only together with its values,
  /// which go to the scratch re and im.
  void extract(klu_symbolic* symbolic, SparsePivots& f, std::vector<double>& re, std::vector<double>& im) {
    const auto n = static_cast<std::size_t>(symbolic->n);
    for (auto* starts : {&f.l_start, &f.u_start}) starts->resize(n + 1);
    for (auto* each : {&f.p, &f.q}) each->resize(n);
    f.scale.resize(n);
    detail::fit(f.l_row, static_cast<std::size_t>(value->lnz));
    detail::fit(f.u_row, static_cast<std::size_t>(value->unz));
    detail::fit(re, std::max(f.l_row.size(), f.u_row.size()));
    if constexpr (std::is_same_v<T, double>) {
      klu_sort(symbolic, value, &common);
      klu_extract(value, symbolic, f.l_start.data(), f.l_row.data(), re.data(), f.u_start.data(), f.u_row.data(),
                  re.data(), nullptr, nullptr, nullptr, f.p.data(), f.q.data(), f.scale.data(), nullptr, &common);
    } else {
      detail::fit(im, re.size());
      klu_z_sort(symbolic, value, &common);
      klu_z_extract(value, symbolic, f.l_start.data(), f.l_row.data(), re.data(), im.data(), f.u_start.data(),
                    f.u_row.data(), re.data(), im.data(), nullptr, nullptr, nullptr, nullptr, f.p.data(), f.q.data(),
                    f.scale.data(), nullptr, &common);
    }
  }
};

}  // namespace

struct SparseAnalysis::Symbolic {
  klu_symbolic* value = nullptr;
};

SparseAnalysis::SparseAnalysis(std::vector<int> starts, std::vector<int> rows)
    : column_start(std::move(starts)), row(std::move(rows)), symbolic_(std::make_unique<Symbolic>()) {
  klu_common common = defaults();
  symbolic_->value = klu_analyze(static_cast<int>(n()), indices(column_start), indices(row), &common);
  if (!symbolic_->value) throw Misuse("a pattern that KLU cannot analyse");
}

SparseAnalysis::~SparseAnalysis() {
  klu_common common = defaults();
  klu_free_symbolic(&symbolic_->value, &common);
}

// KLU returns -1 if it does not know the number.
std::size_t SparseAnalysis::lowerEntries() const {
  return static_cast<std::size_t>(std::max(symbolic_->value->lnz, 0.0));
}

std::size_t SparseAnalysis::upperEntries() const {
  return static_cast<std::size_t>(std::max(symbolic_->value->unz, 0.0));
}

void SparseAnalysis::reserve(SparsePivots& f) const {
  const auto size = static_cast<std::size_t>(n());
  f.l_row.reserve(2 * lowerEntries());
  f.u_row.reserve(2 * upperEntries());
  for (auto* starts : {&f.l_start, &f.u_start, &f.source_start}) starts->reserve(size + 1);
  for (auto* each : {&f.p, &f.q}) each->reserve(size);
  for (auto* each : {&f.source, &f.target}) each->reserve(row.size());
  f.scale.reserve(size);
}

template <class T>
PivotChoice<T>::PivotChoice(std::shared_ptr<const SparseAnalysis> analysis)
    : analysis_(std::move(analysis)), values_(static_cast<Index>(analysis_->row.size())) {
  if (!kHasKlu<T>) {
    throw Misuse("illegal combination: sparse systems in multiprecision: KLU is for double");
  }
  const std::size_t most = 2 * std::max(analysis_->lowerEntries(), analysis_->upperEntries());
  re_.reserve(most);
  if (!std::is_same_v<T, double>) im_.reserve(most);
  row_of_.reserve(static_cast<std::size_t>(analysis_->n()));
}

template <class T>
bool PivotChoice<T>::choose(SparsePivots& pivots) {
  if constexpr (kHasKlu<T>) {
    klu_symbolic* const symbolic = analysis_->symbolic_->value;
    Pivoting<T> klu(*analysis_, symbolic, values_);
    if (!klu.good()) return false;
    klu.extract(symbolic, pivots, re_, im_);
    finish(*analysis_, pivots, row_of_);
    return true;
  }
  return false;
}

template <class T>
SparseLu<T>::SparseLu(std::shared_ptr<const SparseAnalysis> analysis)
    : analysis_(std::move(analysis)), choice_(analysis_), work_(static_cast<std::size_t>(analysis_->n())) {
  l_.reserve(2 * analysis_->lowerEntries());
  u_.reserve(2 * analysis_->upperEntries());
  analysis_->reserve(pivots_);
  inverse_diagonal_.resize(static_cast<std::size_t>(analysis_->n()));
}

template <class T>
Outcome SparseLu<T>::factorize(const SparsePivots* others, bool rather) {
  if (!choice_.entries().allFinite()) return Outcome::kNotFinite;
  if (others && rather && adopt(*others)) return Outcome::kSuccess;
  if (pivoted_ && refactorize() && condition_ >= kSmallerPivot * chosen_at_) return Outcome::kSuccess;
  if (others && adopt(*others)) return Outcome::kSuccess;
  return pivot() ? Outcome::kSuccess : Outcome::kSingular;
}

// Takes the pivots of another matrix if KLU might have chosen them itself.
template <class T>
bool SparseLu<T>::adopt(const SparsePivots& pivots) {
  if (pivoted_ && pivots == pivots_) return false;
  pivots_ = pivots;
  detail::fit(l_, pivots_.l_row.size());
  detail::fit(u_, pivots_.u_row.size());
  pivoted_ = refactorize() && std::all_of(l_.begin(), l_.end(), [](const T& l) {
               return static_cast<double>(detail::magnitude(l)) <= kMostMultiplier;
             });
  ++version_;
  chosen_at_ = condition_;
  return pivoted_;
}

// Left-looking LU, column by column, with the present pattern and pivots.
template <class T>
bool SparseLu<T>::refactorize() {
  const SparsePivots& f = pivots_;
  const auto n = static_cast<int>(analysis_->n());
  std::fill(work_.begin(), work_.end(), T(0));
  T* const x = work_.data();  // zero again after each column
  Real least(0), most(0);
  for (int k = 0; k < n; ++k) {
    const auto c = static_cast<std::size_t>(k);
    const int u_end = f.u_start[c + 1], l_end = f.l_start[c + 1];
    for (int e = f.source_start[c]; e < f.source_start[c + 1]; ++e) {
      const auto at = static_cast<std::size_t>(e);
      const int row = f.target[at];
      x[row] = choice_.entries()[f.source[at]] * Real(f.scale[static_cast<std::size_t>(row)]);
    }
    for (int e = f.u_start[c]; e < u_end; ++e) {
      const auto at = static_cast<std::size_t>(e);
      const auto j = static_cast<std::size_t>(f.u_row[at]);
      const T u = x[j];
      u_[at] = u;
      x[j] = T(0);
      for (int i = f.l_start[j]; i < f.l_start[j + 1]; ++i) {
        const auto below = static_cast<std::size_t>(i);
        x[f.l_row[below]] -= detail::product(l_[below], u);
      }
    }
    const Real pivot = detail::magnitude(x[k]);
    if (!(pivot > Real(0)) || !std::isfinite(static_cast<double>(pivot))) return false;
    least = k == 0 ? pivot : std::min(least, pivot);
    most = std::max(most, pivot);
    const T inverse = detail::inverse(x[k]);
    inverse_diagonal_[c] = inverse;
    x[k] = T(0);
    for (int e = f.l_start[c]; e < l_end; ++e) {
      const auto at = static_cast<std::size_t>(e);
      T& below = x[f.l_row[at]];
      l_[at] = detail::product(below, inverse);
      below = T(0);
    }
  }
  condition_ = static_cast<double>(Real(least / most));
  return true;
}

// Lets KLU choose new pivots, then factorizes with them.
template <class T>
bool SparseLu<T>::pivot() {
  pivoted_ = false;
  condition_ = chosen_at_ = 0;
  ++pivotings_;
  ++version_;
  if (!choice_.choose(pivots_)) return false;
  detail::fit(l_, pivots_.l_row.size());
  detail::fit(u_, pivots_.u_row.size());
  pivoted_ = refactorize();
  chosen_at_ = condition_;
  return pivoted_;
}

template <class T>
void SparseLu<T>::solve(T* b) {
  const SparsePivots& f = pivots_;
  const std::size_t n = work_.size();
  T* const x = work_.data();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[f.p[k]] * Real(f.scale[k]);
  for (std::size_t k = 0; k < n; ++k) {
    const T here = x[k];
    for (int i = f.l_start[k]; i < f.l_start[k + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      x[f.l_row[at]] -= detail::product(l_[at], here);
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    const T here = detail::product(x[k], inverse_diagonal_[k]);
    for (int i = f.u_start[k]; i < f.u_start[k + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      x[f.u_row[at]] -= detail::product(u_[at], here);
    }
    b[f.q[k]] = here;
  }
}

IRK_INSTANTIATE_CLASS(PivotChoice)
template class PivotChoice<std::complex<double>>;
template class PivotChoice<std::complex<BigFloat>>;
IRK_INSTANTIATE_CLASS(SparseLu)
template class SparseLu<std::complex<double>>;
template class SparseLu<std::complex<BigFloat>>;

}  // namespace irk
