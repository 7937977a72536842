// Lanes: eight numbers side by side in a vector register, as the scalar of a problem.
//
// A problem over Lanes is eight problems with eight sets of parameters; one instruction evaluates all of them
// (irk/ensemble.h). Lanes have no comparisons, because a branch on eight values at once has no meaning: the compiler
// refuses a residual that branches. Functions other than arithmetic and sqrt are those of the C library for eight
// numbers where it has them, and are else computed lane by lane.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "irk/dual.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

// IRK_VECTOR_MATH: the C library has functions of eight numbers at once (glibc's libmvec, errors below 4 units in the
// last place). Their names are those of the x86 vector function ABI.
#if defined(__AVX512F__) && defined(IRK_VECTOR_MATH)
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" {
#define IRK_VECTOR_FUNCTION(f) __m512d _ZGVeN8v_##f(__m512d);
IRK_VECTOR_FUNCTION(cbrt)
IRK_VECTOR_FUNCTION(exp)
IRK_VECTOR_FUNCTION(expm1)
IRK_VECTOR_FUNCTION(log)
IRK_VECTOR_FUNCTION(log1p)
IRK_VECTOR_FUNCTION(sin)
IRK_VECTOR_FUNCTION(cos)
IRK_VECTOR_FUNCTION(tan)
IRK_VECTOR_FUNCTION(asin)
IRK_VECTOR_FUNCTION(acos)
IRK_VECTOR_FUNCTION(atan)
IRK_VECTOR_FUNCTION(sinh)
IRK_VECTOR_FUNCTION(cosh)
IRK_VECTOR_FUNCTION(tanh)
#undef IRK_VECTOR_FUNCTION
__m512d _ZGVeN8vv_pow(__m512d, __m512d);
__m512d _ZGVeN8vv_atan2(__m512d, __m512d);
__m512d _ZGVeN8vv_hypot(__m512d, __m512d);
}
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)
#define IRK_LANES_APPLY(f, a) Lanes(Vector(_ZGVeN8v_##f((a).v)))
#define IRK_LANES_APPLY_TWO(f, a, b) Lanes(Vector(_ZGVeN8vv_##f((a).v, (b).v)))
#else
#define IRK_LANES_APPLY(f, a) each([&a](std::size_t i) { return std::f(a.v[i]); })
#define IRK_LANES_APPLY_TWO(f, a, b) each([&](std::size_t i) { return std::f(a.v[i], b.v[i]); })
#endif

namespace irk {

inline constexpr std::size_t kLanes = 8;

// NOLINTBEGIN(google-explicit-constructor): a number is eight equal lanes.
struct Lanes {
  using Vector = double __attribute__((vector_size(kLanes * sizeof(double))));
  Vector v;

  Lanes() : v{} {}
  template <class S>
  requires std::is_arithmetic_v<S> Lanes(S x) : v(static_cast<double>(x) - Vector{}) {}
  explicit Lanes(const Vector& lanes) : v(lanes) {}

  double operator[](std::size_t i) const { return v[i]; }
  void set(std::size_t i, double x) { v[i] = x; }

  Lanes& operator+=(const Lanes& b) { return v += b.v, *this; }
  Lanes& operator-=(const Lanes& b) { return v -= b.v, *this; }
  Lanes& operator*=(const Lanes& b) { return v *= b.v, *this; }
  Lanes& operator/=(const Lanes& b) { return v /= b.v, *this; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
  friend Lanes operator-(const Lanes& a) { return Lanes(-a.v); }

  /// The numbers f(i) of the lanes i.
  template <class F>
  static Lanes each(F&& f) {
    Lanes r;
    for (std::size_t i = 0; i < kLanes; ++i) r.v[i] = f(i);
    return r;
  }
  friend Lanes sqrt(const Lanes& a) {
#ifdef __AVX512F__
    return Lanes(_mm512_maskz_sqrt_pd(0xff, a.v));
#else
    return each([&a](std::size_t i) { return std::sqrt(a.v[i]); });
#endif
  }
#define IRK_LANES_FUNCTION(f) \
  friend Lanes f(const Lanes& a) { return IRK_LANES_APPLY(f, a); }
  IRK_LANES_FUNCTION(cbrt)
  IRK_LANES_FUNCTION(exp)
  IRK_LANES_FUNCTION(expm1)
  IRK_LANES_FUNCTION(log)
  IRK_LANES_FUNCTION(log1p)
  IRK_LANES_FUNCTION(sin)
  IRK_LANES_FUNCTION(cos)
  IRK_LANES_FUNCTION(tan)
  IRK_LANES_FUNCTION(asin)
  IRK_LANES_FUNCTION(acos)
  IRK_LANES_FUNCTION(atan)
  IRK_LANES_FUNCTION(sinh)
  IRK_LANES_FUNCTION(cosh)
  IRK_LANES_FUNCTION(tanh)
#undef IRK_LANES_FUNCTION
  friend Lanes pow(const Lanes& a, const Lanes& b) { return IRK_LANES_APPLY_TWO(pow, a, b); }
  friend Lanes atan2(const Lanes& y, const Lanes& x) { return IRK_LANES_APPLY_TWO(atan2, y, x); }
  friend Lanes hypot(const Lanes& a, const Lanes& b) { return IRK_LANES_APPLY_TWO(hypot, a, b); }
#undef IRK_LANES_APPLY
#undef IRK_LANES_APPLY_TWO
};
// NOLINTEND(google-explicit-constructor)

/// Whether all lanes are 0 (irk/vanishes.h): a residual may then leave out terms that are multiplied by x.
inline bool vanishes(const Lanes& x) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (!(x.v[i] == 0)) return false;
  }
  return true;
}

}  // namespace irk

namespace Eigen {
template <>
struct NumTraits<irk::Lanes> : GenericNumTraits<irk::Lanes> {
  // NOLINTNEXTLINE(readability-identifier-naming): the names are Eigen's.
  enum { RequireInitialization = 1, ReadCost = 1, AddCost = 1, MulCost = 1 };
};
}  // namespace Eigen
