// The methods of an integration as schemes, each prepared when it is first used.
#pragma once

#include <memory>
#include <vector>

#include "core/stages/scheme.h"

namespace irk {

/// Variable order may use up to a hundred members of a family but needs few: members that are not used cost almost
/// nothing. Use one object per thread.
template <class Real>
class SchemeList {
 public:
  /// Throws Misuse as requireTableau.
  explicit SchemeList(const Methods<Real>& methods) : tableaus_(methods.shared), made_(tableaus_->size()) {
    for (const auto& tableau : *tableaus_) requireTableau(tableau);
  }

  std::size_t size() const { return tableaus_->size(); }
  const Tableau<Real>& tableau(std::size_t i) const { return (*tableaus_)[i]; }
  /// The scheme of member i, made in the first call; lives as long as the list.
  const Scheme<Real>& operator[](std::size_t i) const {
    if (!made_[i]) made_[i] = schemeOf(tableau(i));
    return *made_[i];
  }

 private:
  std::shared_ptr<const std::vector<Tableau<Real>>> tableaus_;
  mutable std::vector<std::shared_ptr<const Scheme<Real>>> made_;
};

}  // namespace irk
