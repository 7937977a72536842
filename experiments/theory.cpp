#include "experiments/theory.h"

#include <algorithm>

namespace irk {
namespace {

using Order = std::optional<double>;

struct MechanicalOrders {
  Order u, v, z;

  Order of(char component) const {
    switch (component) {
      case 'u':
        return u;
      case 'v':
        return v;
      case 'z':
        return z;
      default:
        return {};
    }
  }
};

Order asOrder(Index p) { return static_cast<double>(p); }

Index evenBelow(Index s) { return s - s % 2; }  // 2, 2, 4, 4 for s = 2..5

Order odeOrder(std::string_view family, Index s) {
  if (family == "gauss") return asOrder(2 * s);
  if (family.starts_with("radau")) return asOrder(2 * s - 1);
  if (family.starts_with("lobatto")) return asOrder(2 * s - 2);
  return {};
}

// Gauss: 2,2,4,4,6 = s + 1 (odd), s (even); every differentiation costs two orders.
Index gaussBase(Index s) { return s + s % 2; }

MechanicalOrders index2(std::string_view family, Index s) {
  if (family == "gauss") return {asOrder(2 * s), asOrder(gaussBase(s)), asOrder(gaussBase(s) - 2)};
  if (family == "radau_ia")
    return {asOrder(2 * s - 1), asOrder(s), asOrder(std::max<Index>(1, s - 1))};
  if (family == "radau_iia") return {asOrder(2 * s - 1), asOrder(2 * s - 1), asOrder(s)};
  if (family == "lobatto_iiia")
    return {asOrder(2 * s - 2), asOrder(2 * s - 2), asOrder(evenBelow(s))};
  if (family == "lobatto_iiic") return {asOrder(2 * s - 2), asOrder(2 * s - 2), asOrder(s - 1)};
  return {};
}

MechanicalOrders index3(std::string_view family, Index s) {
  if (family == "gauss") {
    return {asOrder(gaussBase(s)), asOrder(gaussBase(s) - 2), asOrder(gaussBase(s) - 4)};
  }
  if (family == "radau_ia") {
    return {asOrder(s), asOrder(std::max<Index>(1, s - 1)), asOrder(s == 1 ? 1 : s - 2)};
  }
  if (family == "radau_iia") {
    return {asOrder(2 * s - 1), asOrder(s), asOrder(std::max<Index>(1, s - 1))};
  }
  if (family == "lobatto_iiia" && s <= 5) {
    return {asOrder(s <= 3 ? 2 : 6), asOrder(evenBelow(s)), asOrder(evenBelow(s) - 2)};
  }
  if (family == "lobatto_iiic") return {asOrder(2 * s - 2), asOrder(s - 1), asOrder(s - 2)};
  return {};
}

}  // namespace

std::optional<double> theoreticalOrder(std::string_view family, Index s, SystemKind kind,
                                       char component) {
  switch (kind) {
    case SystemKind::kOde:
      return component == 'z' ? Order() : odeOrder(family, s);
    case SystemKind::kIndex2:
      return index2(family, s).of(component);
    case SystemKind::kIndex3:
      return index3(family, s).of(component);
  }
  return {};
}

}  // namespace irk
