// A nonlinear DAE of index 2 after Hairer, Lubich & Roche (LNM 1409, 1989). Its solution is y = (exp t, exp -2t),
// z = exp 2t. z enters nonlinearly: it is no multiplier of a position constraint.
#include <array>

#include "problems/smooth/exponential_dae.h"

namespace irk {
namespace {

struct Index2Nonlinear {
  static constexpr int kAlgebraicIndex = 2;
  static constexpr std::array kRates = {1, -2};
  static constexpr std::array kNames = {"y1", "y2"};
  static constexpr int kAlgebraicRate = 2;
  static constexpr const char* kAlgebraicName = "z";

  static ReferenceCase referenceCase() { return {.times = "0.25 0.5", .tolerance = kManyDigits}; }
  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y2 = p.x[1], &z = p.z[0];
    const T square = y2 * y2;
    r.x[0] = y1 * square * z * z - p.k[0];
    r.x[1] = y1 * y1 * square - 3 * (square * z) - p.k[1];
    r.z[0] = y1 * y1 * y2 - 1;
  }
};

}  // namespace

SceneEntry index2NonlinearEntry() {
  SceneEntry entry = ExponentialDae<Index2Nonlinear>::entry();
  entry.literature = "E. Hairer, Ch. Lubich, M. Roche, LNM 1409, Springer 1989";
  return entry;
}

}  // namespace irk
