// A drive: a measured torque of a CSV file turns a motor, which turns a load through an elastic shaft.
//
//   irk solve measured_torque.cpp --tol 1e-8 --reference
//
// At t = 1 a blow on the load changes its speed: a jump at a declared time.
#include <irk/scene_file.h>
#include <irk/table.h>

using namespace irk;

namespace {

template <class Real>
struct MeasuredTorque {
  Real motor, load, stiffness, damping, blow;
  // Columns t and M of torque.csv beside this file. Its kinks are declared times by themselves.
  TimeTable<Real> torque{"torque.csv", "t", "M"};

  Sizes sizes() const { return {.nu = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T shaft = stiffness * (p.u[0] - p.u[1]) + damping * (p.v[0] - p.v[1]);
    r.u[0] = motor * p.a[0] + shaft - torque(p.t);
    r.u[1] = load * p.a[1] - shaft + 0.02 * p.v[1];
  }
  std::vector<Real> times() const { return {Real(1)}; }
  template <class T>
  void jumpAtTime(Index, const Point<T>&, T*, T* v, T*) const {
    v[1] -= blow / load;
  }

  static MeasuredTorque with(const Settings& values) {
    return {.motor = number<Real>(values, "motor"),
            .load = number<Real>(values, "load"),
            .stiffness = number<Real>(values, "stiffness"),
            .damping = number<Real>(values, "damping"),
            .blow = number<Real>(values, "blow")};
  }
  SceneFrame<Real> frame() const { return {.t_end = 2, .u = {{"motor", "rad", 100, 100}, {"load", "rad", 100, 100}}}; }
  static SceneEntry entry() {
    return {.id = "measured_torque",
            .title = "drive with a measured torque and a blow",
            .shows = "a table of measured data, and a jump at a declared time",
            .parameters = {positiveParameter("motor", "kg m^2", "moment of inertia", "0.2"),
                           positiveParameter("load", "kg m^2", "moment of inertia", "0.8"),
                           positiveParameter("stiffness", "N m/rad", "of the shaft", "2000"),
                           positiveParameter("damping", "N m s/rad", "of the shaft", "1"),
                           numberParameter("blow", "N m s", "impulse at t = 1", "5", -1e6, 1e6)}};
  }
};

}  // namespace

IRK_SCENE(MeasuredTorque)
