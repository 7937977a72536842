#include "core/sparse_lu.h"

#include <klu.h>

#include <type_traits>

#include "core/misuse.h"
#include "core/multiprecision.h"

namespace irk {
namespace {

// Old pivots serve as long as the smallest of them, relative to the largest, is not this much
// smaller than when they were chosen. (KLU's pivot growth says it sharper, and costs as much as the
// refactorization.)
constexpr double kSmallerPivot = 1e-3;

klu_common defaults() {
  klu_common common;
  klu_defaults(&common);
  return common;
}

// KLU's interface of one scalar. It takes arrays as not const, and changes none of these.
template <class T>
struct Klu;
template <>
struct Klu<double> {
  static constexpr auto factor = klu_factor;
  static constexpr auto refactor = klu_refactor;
  static constexpr auto solve = klu_solve;
  static constexpr auto condition = klu_rcond;
  static constexpr auto release = klu_free_numeric;
};
template <>
struct Klu<std::complex<double>> {
  static constexpr auto factor = klu_z_factor;
  static constexpr auto refactor = klu_z_refactor;
  static constexpr auto solve = klu_z_solve;
  static constexpr auto condition = klu_z_rcond;
  static constexpr auto release = klu_z_free_numeric;
};

template <class T>
constexpr bool kHasKlu = std::is_same_v<T, double> || std::is_same_v<T, std::complex<double>>;

double* numbers(double* x) { return x; }
double* numbers(std::complex<double>* x) { return reinterpret_cast<double*>(x); }
int* indices(const std::vector<int>& x) { return const_cast<int*>(x.data()); }

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
struct SparseLu<T>::Numeric {
  klu_common common = defaults();
  klu_numeric* value = nullptr;
  double chosen_at = 0;  // reciprocal condition when the pivots were chosen
  ~Numeric() { release(); }
  void release() {
    if constexpr (kHasKlu<T>) {
      if (value) Klu<T>::release(&value, &common);
    }
  }
};

template <class T>
SparseLu<T>::SparseLu(std::shared_ptr<const SparseAnalysis> analysis)
    : analysis_(std::move(analysis)),
      values_(static_cast<Index>(analysis_->row.size())),
      numeric_(std::make_unique<Numeric>()) {
  if (!kHasKlu<T>) {
    throw Misuse("illegal combination: sparse systems in multiprecision: KLU is for double");
  }
}
template <class T>
SparseLu<T>::~SparseLu() = default;
template <class T>
SparseLu<T>::SparseLu(SparseLu&&) noexcept = default;

template <class T>
Outcome SparseLu<T>::factorize() {
  if (!values_.allFinite()) return Outcome::kNotFinite;
  return refactorize() || pivot() ? Outcome::kSuccess : Outcome::kSingular;
}

template <class T>
bool SparseLu<T>::refactorize() {
  if constexpr (kHasKlu<T>) {
    if (!numeric_->value) return false;
    int* const columns = indices(analysis_->column_start);
    int* const rows = indices(analysis_->row);
    klu_symbolic* const symbolic = analysis_->symbolic_->value;
    klu_common& common = numeric_->common;
    double* const values = numbers(values_.data());
    if (!Klu<T>::refactor(columns, rows, values, symbolic, numeric_->value, &common)) return false;
    if (common.status != KLU_OK) return false;
    Klu<T>::condition(symbolic, numeric_->value, &common);
    return common.rcond >= kSmallerPivot * numeric_->chosen_at;
  }
  return false;
}

template <class T>
bool SparseLu<T>::pivot() {
  if constexpr (kHasKlu<T>) {
    numeric_->release();
    ++pivotings_;
    numeric_->value = Klu<T>::factor(indices(analysis_->column_start), indices(analysis_->row),
                                     numbers(values_.data()), analysis_->symbolic_->value,
                                     &numeric_->common);
    if (numeric_->value && numeric_->common.status == KLU_OK) {
      numeric_->chosen_at = reciprocalCondition();
      return true;
    }
    numeric_->release();
  }
  return false;
}

template <class T>
void SparseLu<T>::solve(T* x) {
  if constexpr (kHasKlu<T>) {
    Klu<T>::solve(analysis_->symbolic_->value, numeric_->value, static_cast<int>(analysis_->n()), 1,
                  numbers(x), &numeric_->common);
  }
}

template <class T>
double SparseLu<T>::reciprocalCondition() const {
  if constexpr (kHasKlu<T>) {
    if (!numeric_->value) return 0;
    Klu<T>::condition(analysis_->symbolic_->value, numeric_->value, &numeric_->common);
    return numeric_->common.rcond;
  }
  return 0;
}

IRK_INSTANTIATE_CLASS(SparseLu)
template class SparseLu<std::complex<double>>;
template class SparseLu<std::complex<mp50>>;
template class SparseLu<std::complex<mp100>>;

}  // namespace irk
