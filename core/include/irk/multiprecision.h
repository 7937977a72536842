// Multiprecision scalars. Include this header only where templates are instantiated.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace irk {

/// 50 decimal digits, without expression templates, so that `auto` is safe.
using mp50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// 100 decimal digits, for measuring orders from about 20 on: only errors below 1e-40 show them as a straight line.
using mp100 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

}  // namespace irk

/// Instantiates the class template Name for every scalar that core is compiled for.
#define IRK_INSTANTIATE_CLASS(Name) \
  template class Name<double>;      \
  template class Name<::irk::mp50>; \
  template class Name<::irk::mp100>;
