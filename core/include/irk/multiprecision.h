// The scalars beyond double. Included only where templates are instantiated.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace irk {

/// 50 decimal digits without expression templates, so that `auto` and AutoDiffScalar are safe.
using mp50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

/// 100 digits, for orders from about 20 on: their errors keep to a line only below 1e-40.
using mp100 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                            boost::multiprecision::et_off>;

}  // namespace irk

/// One list of the scalars that core is compiled for.
#define IRK_INSTANTIATE_CLASS(Name) \
  template class Name<double>;      \
  template class Name<::irk::mp50>; \
  template class Name<::irk::mp100>;
