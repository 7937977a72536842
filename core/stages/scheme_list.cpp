#include "core/stages/scheme_list.h"

#include <cstdint>
#include <string>
#include <type_traits>

#include "core/base/kept.h"
#include "irk/multiprecision.h"

namespace irk {

template <class Real>
std::shared_ptr<const CheckedMembers<Real>> checkedMembers(const Methods<Real>& methods) {
  const auto check = [&methods] {
    CheckedMembers<Real> checked{methods.shared, {}};
    for (const auto& tableau : *methods.shared) requireTableau(tableau);
    if (methods.shared->size() > 1) {
      for (const auto& tableau : *methods.shared) checked.structures.push_back(structureOf(tableau));
    }
    return checked;
  };
  if constexpr (std::is_same_v<Real, double>) {
    if (methods.shared->size() > 1 && methods.shared->back().stages() <= kMostKeptStages) {
      static Kept<CheckedMembers<double>> all;  // an address that it keeps is not used again
      const auto address = reinterpret_cast<std::uintptr_t>(methods.shared.get());
      return all.of(std::string(reinterpret_cast<const char*>(&address), sizeof address), check);
    }
  }
  return std::make_shared<const CheckedMembers<Real>>(check());
}

template std::shared_ptr<const CheckedMembers<double>> checkedMembers(const Methods<double>&);
template std::shared_ptr<const CheckedMembers<BigFloat>> checkedMembers(const Methods<BigFloat>&);

}  // namespace irk
