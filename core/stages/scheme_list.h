// The methods of an integration as schemes, each prepared when it is first used.
#pragma once

#include <memory>
#include <vector>

#include "core/stages/scheme.h"

namespace irk {

/// The methods of an integration, checked.
template <class Real>
struct CheckedMembers {
  std::shared_ptr<const std::vector<Tableau<Real>>> tableaus;
  std::vector<std::shared_ptr<const Structure<Real>>> structures;  ///< none for one method, whose scheme has it
};
/// Throws Misuse as requireTableau. In double the members of a family of up to kMostKeptStages stages are checked once
/// in a process, as long as its tableaus are the same object.
template <class Real>
std::shared_ptr<const CheckedMembers<Real>> checkedMembers(const Methods<Real>& methods);

/// Variable order may use up to a hundred members of a family but needs few: members that are not used cost almost
/// nothing. Use one object per thread.
template <class Real>
class SchemeList {
 public:
  /// Throws Misuse as requireTableau.
  explicit SchemeList(const Methods<Real>& methods) : members_(checkedMembers(methods)), made_(size()) {}

  std::size_t size() const { return members_->tableaus->size(); }
  const Tableau<Real>& tableau(std::size_t i) const { return (*members_->tableaus)[i]; }
  const Structure<Real>& structure(std::size_t i) const {
    return members_->structures.empty() ? (*this)[i] : *members_->structures[i];
  }
  /// The scheme of member i, made in the first call; lives as long as the list.
  const Scheme<Real>& operator[](std::size_t i) const {
    if (!made_[i]) made_[i] = schemeOf(tableau(i));
    return *made_[i];
  }

 private:
  std::shared_ptr<const CheckedMembers<Real>> members_;
  mutable std::vector<std::shared_ptr<const Scheme<Real>>> made_;
};

}  // namespace irk
