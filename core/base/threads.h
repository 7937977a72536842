// Loops on several threads, whose results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/parallel_loop.h"
#include "core/base/small_size.h"
#include "irk/scalar.h"

namespace irk {

/// With fewer unknowns a step is hardly longer than the loops that would divide it, and one thread is used. Measured on
/// `beam_chain`, 100 unknowns, 9 stages, sparse: 0.051 ms a step on one thread, 0.055 ms on two.
inline constexpr Index kThreadsFrom = 100;

namespace detail {

/// Calls turn(context, i) for i = 0 ... n - 1 on the calling thread and on threads - 1 helpers of its own, which live
/// until it ends or asks for another number. `turn` throws nothing.
void onTeam(int threads, std::size_t n, void (*turn)(void* context, std::size_t i), void* context);

}  // namespace detail

/// Calls f(i) for i = 0 ... n - 1 on up to `threads` threads, in any order; f writes to places of its own i only. An
/// exception leaves the loop as it would leave a loop of one thread. Inside another such loop, and inside a parallel
/// region of OpenMP, one thread is used.
template <class F>
void onThreads(int threads, std::size_t n, F&& f) {
  if (threads <= 1 || n <= 1) {
    for (std::size_t i = 0; i < n; ++i) f(i);
    return;
  }
  ParallelLoop loop;
  auto turn = [&loop, &f](std::size_t i) { loop.turn(i, [&f, i] { f(i); }); };
  const auto call = [](void* context, std::size_t i) { (*static_cast<decltype(turn)*>(context))(i); };
  detail::onTeam(threads, n, call, &turn);
  loop.rethrow();
}

namespace detail {

/// A part of fewer rows takes less time than a loop on threads, which begins and ends in a few microseconds.
inline constexpr Index kLeastPart = 1024;
/// Parts begin at multiples of so many rows, as the blocks do in which rows are computed.
inline constexpr Index kPartBlock = 8;

}  // namespace detail

/// Calls f(first, last) for parts that together are the rows 0 ... n - 1: one part for each thread or, where it has few
/// rows, one for all of them. f computes each row by itself.
template <class F>
void inParts(int threads, Index n, F&& f) {
  const Index parts = std::min<Index>(threads, n / detail::kLeastPart);
  if (parts <= 1) return f(Index{0}, n);
  const Index blocks = (n + detail::kPartBlock - 1) / detail::kPartBlock;
  const auto begin = [=](Index part) { return std::min(n, blocks * part / parts * detail::kPartBlock); };
  onThreads(threads, static_cast<std::size_t>(parts), [&](std::size_t i) {
    const auto part = static_cast<Index>(i);
    f(begin(part), begin(part + 1));
  });
}

/// The sum of f(0), f(1), ... f(n - 1), always added in this order. Each f(i) is itself a sum, of `length` numbers.
template <class Real, class F>
Real sumOnThreads(int threads, Index n, Index length, const F& f) {
  Real sum(0);
  if (threads <= 1 || n * length < 2 * detail::kLeastPart) {
    for (Index i = 0; i < n; ++i) sum += f(i);
    return sum;
  }
  constexpr Index kAtATime = 32;
  std::array<Real, kAtATime> parts{};
  for (Index first = 0; first < n; first += kAtATime) {
    const auto count = static_cast<std::size_t>(std::min(kAtATime, n - first));
    onThreads(threads, count, [&](std::size_t i) { parts[i] = f(first + static_cast<Index>(i)); });
    for (std::size_t i = 0; i < count; ++i) sum += parts[i];
  }
  return sum;
}

/// Copies n numbers on up to `threads` threads.
template <class Real>
[[gnu::always_inline]] inline void copyOnThreads(int threads, const Real* from, Index n, Real* to) {
  if (threads <= 1) return copyFew(from, n, to);
  inParts(threads, n, [=](Index first, Index last) { std::copy_n(from + first, last - first, to + first); });
}

}  // namespace irk
