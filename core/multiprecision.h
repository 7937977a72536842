// The suite's second scalar: 50 decimal digits. Included only where templates are instantiated.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace irk {

/// 50 decimal digits without expression templates, so that `auto` and AutoDiffScalar are safe.
using mp50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

}  // namespace irk

/// One list of the scalars that core and scenes are compiled for.
#define IRK_INSTANTIATE_CLASS(Name)  \
  template class Name<double>;       \
  template class Name<::irk::mp50>;
