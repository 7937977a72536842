// x' = z, 0 = x - cos t - d, where d jumps at a declared time: x follows it, and z is again -sin t behind the jump.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Index2Jump {
  static constexpr int kAlgebraicIndex = 2;
  Real size, at;

  Sizes sizes() const { return {.nx = 1, .nz = 1, .discrete = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.x[0] = p.z[0] - p.k[0];
    r.z[0] = p.x[0] - cos(p.t) - p.d[0];
  }
  std::vector<Real> times() const { return {at}; }
  template <class T>
  void onTime(Index, const Point<T>&, T* d) const {
    d[0] = T(size);
  }
  static Index2Jump with(const Settings& values) { return {number<Real>(values, "size"), number<Real>(values, "at")}; }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    s.d[0] = t > at ? size : Real(0);
    s.x[0] = cos(t) + s.d[0];
    s.w << -sin(t), -sin(t);
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 1, .time_unit = "", .x = {{"x"}}, .z = {{"z"}}}; }
  static SceneEntry entry() {
    return {.id = "index2_jump",
            .title = "index 2 with a constraint that jumps at a declared time",
            .shows = "a constraint that the state must follow after a restart",
            .collections = {"foreign"},
            .kind = SceneKind::kIndex2,
            .parameters = {numberParameter("size", "", "of the jump", "0.3", 0.01, 2),
                           numberParameter("at", "", "time of the jump", "0.5", 0.1, 0.9)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(Index2Jump)
