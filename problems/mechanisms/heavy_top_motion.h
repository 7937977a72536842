// Lagrange's top, started with a horizontal axis that neither rises nor falls: its motion by elliptic functions.
// Internal to heavy_top.cpp.
//
// The axis of symmetry is the body's y-axis, c = cos(theta) its component along the vertical z-axis. With
// Jt = J1 + m l^2, a = J3 spin / Jt, b = 2 m g l / Jt and the precession p at the start, the energy gives
//   c'^2 = b (c - c1)(c - c2)(c - c3),   c1 <= c <= c2,   c = c1 + (c2 - c1) sn^2(w t + start),
// where c = 0 is one of the roots: Whittaker, Analytical Dynamics, 71-73. The angles phi of precession and psi about
// the axis appear in the Euler parameters as their sum and difference, of which each has one pole only:
//   (phi + psi)' = spin - a + (p + a) / (1 + c),   (phi - psi)' = a - spin + (p - a) / (1 - c).
#pragma once

#include "problems/support/boost_math.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <cmath>

#include "problems/support/elliptic.h"

namespace irk::heavy_top {

template <class Real>
struct Data {
  Real m, l, J1, J3, g;   // kg, m, kg m^2 (about the centre of mass), m/s^2
  Real spin, precession;  // rad/s, at the start

  Real transverseInertia() const { return J1 + m * l * l; }
};

/// Of the axis: sin and cos of theta / 2, and c'; and (phi + psi) / 2, (phi - psi) / 2.
template <class Real>
struct Attitude {
  Real half_sine, half_cosine, rate, half_sum, half_difference;
};

template <class Real>
class Motion {
 public:
  explicit Motion(const Data<Real>& d)
      : a_(d.J3 * d.spin / d.transverseInertia()), b_(2 * d.m * d.g * d.l / d.transverseInertia()), d_(d) {
    using std::sqrt;
    const Real p = d.precession, square = p * p + a_ * a_, product = 2 * a_ * p - b_;
    c3_ = (square + sqrt(square * square - 4 * b_ * product)) / (2 * b_);
    const Real other = product / (b_ * c3_);
    const bool falls = other < 0;
    c1_ = falls ? other : Real(0);
    c2_ = falls ? Real(0) : other;
    // 1 + c1 and 1 - c2 without cancellation: the values of the cubic at -1 and 1 are squares.
    above_ = (p + a_) * (p + a_) / (b_ * (1 + c2_) * (1 + c3_));
    below_ = (p - a_) * (p - a_) / (b_ * (1 - c1_) * (c3_ - 1));
    w_ = sqrt(b_ * (c3_ - c1_)) / 2;
    k2_ = (c2_ - c1_) / (c3_ - c1_);
    if (!regular() || !falls) return;
    start_ = boost::math::ellint_1(Real(sqrt(k2_)));
    const Real upper = jacobiFunctions<Real>(start_, k2_).am;  // pi / 2
    sum_ = integral(-(c2_ - c1_) / above_, upper);
    difference_ = integral((c2_ - c1_) / (1 - c1_), upper);
  }

  /// False where the axis passes through the vertical or approaches it for ever: other formulas hold there.
  bool regular() const { return above_ > 0 && below_ > 0 && c3_ > 1 && c2_ < 1 && k2_ < 1; }

  Attitude<Real> at(const Real& t) const {
    using std::sqrt;
    const auto [sn, cn, dn, am] = jacobiFunctions<Real>(w_ * t + start_, k2_);
    const Real span = c2_ - c1_, p = d_.precession;
    const Real sum = ((d_.spin - a_) * t + (p + a_) * (integral(-span / above_, am) - sum_) / (w_ * above_));
    const Real difference =
        (a_ - d_.spin) * t + (p - a_) * (integral(span / (1 - c1_), am) - difference_) / (w_ * (1 - c1_));
    return {.half_sine = sqrt((below_ + span * cn * cn) / 2),
            .half_cosine = sqrt((above_ + span * sn * sn) / 2),
            .rate = 2 * span * w_ * sn * cn * dn,
            .half_sum = sum / 2,
            .half_difference = difference / 2};
  }
  /// phi' sin^2(theta).
  Real precession(const Real& c) const { return d_.precession - a_ * c; }

 private:
  // The integral of 1 / (1 - n sn^2) over w t.
  Real integral(const Real& n, const Real& am) const {
    using std::sqrt;
    return boost::math::ellint_3(Real(sqrt(k2_)), n, am);
  }

  Real a_, b_, c1_, c2_, c3_, above_, below_, w_, k2_;
  Real start_ = Real(0), sum_ = Real(0), difference_ = Real(0);  // of w t, and of the integrals
  Data<Real> d_;
};

}  // namespace irk::heavy_top
