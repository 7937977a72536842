// Dahlquist's equation y' = lambda y with complex lambda, written as two real equations.
#include <cmath>

#include "irk/scene_file.h"

namespace irk {
namespace {

template <class Real>
struct Dahlquist {
  Real re, im;  // lambda, 1/s

  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = re * p.x[0] - im * p.x[1] - p.k[0];
    r.x[1] = im * p.x[0] + re * p.x[1] - p.k[1];
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::exp;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    s.x << exp(re * t) * cos(im * t), exp(re * t) * sin(im * t);
    s.w << re * s.x[0] - im * s.x[1], im * s.x[0] + re * s.x[1];
    return s;
  }
};

template <class Real>
Scene<Real> make(const Settings& settings) {
  const Dahlquist<Real> problem{number<Real>(settings, "lambda_re"), number<Real>(settings, "lambda_im")};
  Scene<Real> scene;
  setProblem(scene, problem);
  scene.t_end = 1;
  setComponents(scene, {}, {{"y1"}, {"y2"}});
  scene.exact = [problem](const Real& t) { return problem.exact(t); };
  scene.start = problem.exact(Real(0));
  return scene;
}

}  // namespace

SceneEntry dahlquistEntry() {
  return {.id = "dahlquist",
          .title = "Dahlquist's equation y' = lambda y, lambda complex",
          .shows = "the stability function R(h lambda) itself",
          .parameters = {numberParameter("lambda_re", "1/s", "real part of lambda", "-1", -1e15, 1e15),
                         numberParameter("lambda_im", "1/s", "imaginary part of lambda", "1", -1e15, 1e15)},
          .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
