// Dual numbers, and the aliases for vectors and matrices that all rooms use.
#pragma once

#include <Eigen/Core>

#include "irk/dual.h"

namespace irk {

using Index = Eigen::Index;

template <class T>
using Vec = Eigen::Matrix<T, Eigen::Dynamic, 1>;
template <class T>
using Mat = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using VecView = Eigen::Map<Vec<T>>;
template <class T>
using ConstVec = Eigen::Map<const Vec<T>>;

}  // namespace irk
