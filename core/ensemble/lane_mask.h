// Comparisons and decisions of eight lanes. Lanes themselves have no comparisons, so that only this room can branch on
// them.
#pragma once

#include <cstdint>
#include <limits>

#include "irk/lanes.h"

#ifdef __AVX512DQ__
#include <immintrin.h>
#endif

namespace irk {

/// A truth value per lane: all bits or none.
struct LaneMask {
  using Vector = decltype(Lanes::Vector{} < Lanes::Vector{});
  Vector v{};

  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return {a.v & b.v}; }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return {a.v | b.v}; }
  friend LaneMask operator~(const LaneMask& a) { return {~a.v}; }
  bool operator[](std::size_t i) const { return v[i] != 0; }
  void set(std::size_t i, bool on) { v[i] = on ? -1 : 0; }

  /// Bit i: lane i.
  unsigned bits() const {
#ifdef __AVX512DQ__
    return _mm512_movepi64_mask(reinterpret_cast<const __m512i&>(v));
#else
    unsigned bits = 0;
    for (std::size_t i = 0; i < kLanes; ++i) bits |= static_cast<unsigned>(v[i] & 1) << i;
    return bits;
#endif
  }
  bool any() const { return bits() != 0; }
};

inline LaneMask less(const Lanes& a, const Lanes& b) { return {a.v < b.v}; }
inline LaneMask lessOrEqual(const Lanes& a, const Lanes& b) { return {a.v <= b.v}; }
inline LaneMask equal(const Lanes& a, const Lanes& b) { return {a.v == b.v}; }
/// Neither infinite nor NaN.
inline LaneMask finite(const Lanes& a) { return {a.v * 0.0 == Lanes::Vector{}}; }

inline Lanes select(const LaneMask& mask, const Lanes& yes, const Lanes& no) { return Lanes(mask.v ? yes.v : no.v); }
inline Lanes abs(const Lanes& a) {
  constexpr std::int64_t kAllButSign = std::numeric_limits<std::int64_t>::max();
  return Lanes(reinterpret_cast<Lanes::Vector>(reinterpret_cast<LaneMask::Vector>(a.v) & kAllButSign));
}
inline Lanes largest(const Lanes& a, const Lanes& b) { return Lanes(a.v < b.v ? b.v : a.v); }
inline Lanes smallest(const Lanes& a, const Lanes& b) { return Lanes(b.v < a.v ? b.v : a.v); }

/// to := from in the lanes of `mask`, n numbers each.
inline void assign(const LaneMask& mask, const Lanes* from, Lanes* to, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) to[i] = select(mask, from[i], to[i]);
}

/// Calls f(i) for each lane of the mask.
template <class F>
void forEachLane(const LaneMask& mask, F&& f) {
  const unsigned bits = mask.bits();
  for (std::size_t i = 0; i < kLanes; ++i) {
    if ((bits >> i & 1U) != 0) f(i);
  }
}

}  // namespace irk
