// A nonlinear DAE of index 3 after Jay (Appl. Numer. Math. 17, 1995, section 7). Its solution is
// y = z = (exp 2t, exp -t), w = exp t. z enters y' nonlinearly: y and z are not positions and velocities.
#include <array>

#include "problems/smooth/exponential_dae.h"

namespace irk {
namespace {

struct Index3Nonlinear {
  static constexpr int kAlgebraicIndex = 3;
  static constexpr std::array kDifferentialIndices = {1, 1, 2, 2};
  static constexpr std::array kRates = {2, -1, 2, -1};
  static constexpr std::array kNames = {"y1", "y2", "z1", "z2"};
  static constexpr int kAlgebraicRate = 1;
  static constexpr const char* kAlgebraicName = "w";

  static ReferenceCase referenceCase() { return {.times = "0.25 0.5", .step = 0.1}; }
  Sizes sizes() const { return {.nu = 0, .nx = 4, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y2 = p.x[1], &z1 = p.x[2], &z2 = p.x[3], &w = p.z[0];
    const T square = z2 * z2;
    r.x[0] = 2 * (y1 * y2 * z1 * z2) - p.k[0];
    r.x[1] = -(y1 * y2 * square) - p.k[1];
    r.x[2] = (y1 * y2 + z1 * z2) * w - p.k[2];
    r.x[3] = -(y1 * y2 * y2 * square * w) - p.k[3];
    r.z[0] = y1 * y2 * y2 - 1;
  }
};

}  // namespace

SceneEntry index3NonlinearEntry() { return ExponentialDae<Index3Nonlinear>::entry(); }

}  // namespace irk
