#include "problems/support/row_check.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "irk/misuse.h"

namespace irk {
namespace {

constexpr Index kRoomBehind = 64;
// A number that no residual computes: a NaN with a payload of its own.
constexpr std::uint64_t kUntouched = 0x7ff8'1234'5678'9abc;

bool isUntouched(double x) { return std::bit_cast<std::uint64_t>(x) == kUntouched; }

// The names by which a user may have written the row n + j of all.
std::string namesOfRow(const Sizes& n, Index j) {
  std::string names = fmt::format("r.u[{}], r.x[{}] or r.z[{}]", n.n() + j, n.nx + n.nz + j, n.nz - n.constraints + j);
  if (n.constraints > 0) names += fmt::format(", or g[{}] of constraints", n.nz + j);
  return names;
}

}  // namespace

void requireRowsInside(const System<double>& system, const State<double>& start) {
  const Sizes n = system.sizes();
  const bool fits = start.u.size() == n.nu && start.v.size() == n.nu && start.x.size() == n.nx &&
                    start.w.size() == n.n() && start.d.size() == n.discrete;
  if (!fits) return;
  std::vector<double> rows(static_cast<std::size_t>(n.n() + kRoomBehind), std::bit_cast<double>(kUntouched));
  system.evaluate(Level::kFormulated, pointOf(start), VecView<double>(rows.data(), n.n()));
  for (Index j = 0; j < kRoomBehind; ++j) {
    if (isUntouched(rows[static_cast<std::size_t>(n.n() + j)])) continue;
    throw Misuse(fmt::format(
        "its residual writes behind the last row, to {}; its sizes are nu = {}, nx = {}, nz = {} with {} constraints",
        namesOfRow(n, j), n.nu, n.nx, n.nz, n.constraints));
  }
}

}  // namespace irk
