// Dahlquist's equation y' = lambda y with complex lambda, written as two real equations.
#include "irk/scene_file.h"

using namespace irk;

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
  static Dahlquist with(const Settings& values) {
    return {number<Real>(values, "lambda_re"), number<Real>(values, "lambda_im")};
  }
  SceneFrame<Real> frame() const { return {.t_end = 1}; }
  static SceneEntry entry() {
    return {.id = "dahlquist",
            .title = "Dahlquist's equation y' = lambda y, lambda complex",
            .shows = "the stability function R(h lambda) itself",
            .collections = {"probes"},
            .literature = "HW II (IV.3)",
            .parameters = {numberParameter("lambda_re", "1/s", "real part of lambda", "-1", -1e15, 1e15),
                           numberParameter("lambda_im", "1/s", "imaginary part of lambda", "1", -1e15, 1e15)},
            .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Dahlquist)
