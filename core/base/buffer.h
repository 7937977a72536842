// Scratch memory for matrices of changing size.
#pragma once

#include <vector>

#include "irk/scalar.h"

namespace irk {

template <class Real>
using MatView = Eigen::Map<Mat<Real>>;

/// A matrix that allocates only when it becomes larger than ever before. Owns its numbers.
template <class Real>
class Buffer {
 public:
  /// A view of rows x columns numbers, whose values are unspecified. Invalidates earlier views.
  MatView<Real> resize(Index rows, Index columns) {
    const auto size = static_cast<std::size_t>(rows * columns);
    if (values_.size() < size) values_.resize(size);
    rows_ = rows;
    columns_ = columns;
    return view();
  }
  MatView<Real> view() { return {values_.data(), rows_, columns_}; }

 private:
  std::vector<Real> values_;
  Index rows_ = 0, columns_ = 0;
};

}  // namespace irk
