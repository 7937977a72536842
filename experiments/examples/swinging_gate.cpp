// A gate on a hinge whose axis leans by 20 degrees: it swings as a pendulum. A rigid body in space with a revolute
// joint, seven positions and six constraints, made of the functions in irk/rigid.h.
#include <irk/rigid.h>
#include <irk/scene_file.h>

using namespace irk;

namespace {

template <class Real>
struct SwingingGate {
  using Vector = rigid::Vector<Real>;
  static constexpr rigid::Body kGate{0};
  Real m = 20, width = Real(1.2), g = decimal<Real>("9.81");   // kg, m, m/s^2
  Real lean = decimal<Real>("0.3490658504"), angle = Real(1);  // rad: of the axis, of the gate at the start
  Vector J{3, decimal<Real>("5.4"), decimal<Real>("2.4")};  // kg m^2, about the gate's axes: width, thickness, height

  Sizes sizes() const { return {.nu = 7, .nz = 6, .constraints = 6}; }
  Vector hinge() const { return {-width / 2, Real(0), Real(0)}; }  // in the gate, from its centre
  // The axis in space, and two directions of the gate across its own axis, which is its height.
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& c) const {
    using std::cos;
    using std::sin;
    const Real zero(0), one(1);
    const Vector axis{sin(lean), zero, cos(lean)};
    rigid::revolute(u, c, 0, rigid::kGround, Vector{zero, zero, zero}, kGate, hinge(), axis, Vector{one, zero, zero},
                    Vector{zero, one, zero});
    c[5] = rigid::norm(u, 3);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    rigid::writeInertia(r, p, kGate, m, J);
    r.u[2] -= m * g;
    rigid::addConstraintForces(*this, p, r);
  }

  // The gate is turned about y by `lean`, and then by `angle` about its own axis.
  void start(State<Real>& s) const {
    using std::cos;
    using std::sin;
    const Real c = cos(lean / 2), l = sin(lean / 2), a = cos(angle / 2), b = sin(angle / 2);
    s.u.tail(4) << c * a, l * b, l * a, c * b;
    const auto arm = rigid::turned(s.u, 3, hinge());
    s.u.head(3) << -arm.x, -arm.y, -arm.z;
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 3,
            .u = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"e0"}, {"e1"}, {"e2"}, {"e3"}},
            .z = {{"fx", "N", 100},
                  {"fy", "N", 100},
                  {"fz", "N", 100},
                  {"t1", "N m", 100},
                  {"t2", "N m", 100},
                  {"lambda", "J", 10}}};
  }
  static SceneEntry entry() {
    return {.id = "swinging_gate",
            .title = "gate on a leaning hinge",
            .shows = "a rigid body in space with a revolute joint"};
  }
};

}  // namespace

IRK_SCENE(SwingingGate)
