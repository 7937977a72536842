#include "experiments/analyses/orders/theory.h"

#include <algorithm>

namespace irk {
namespace {

using Order = std::optional<TheoreticalOrder>;

constexpr Index kMeasuredStages = 5;

Order theorem(Index p) { return TheoreticalOrder{static_cast<double>(p), "theorem"}; }

Order pattern(Index p, Index s) {
  return TheoreticalOrder{static_cast<double>(p), s <= kMeasuredStages ? "measured" : "extrapolated"};
}

Index evenBelow(Index s) { return s - s % 2; }  // 2, 2, 4, 4 for s = 2..5
Index evenAbove(Index s) { return s + s % 2; }  // 2, 2, 4, 4, 6 for s = 1..5

Order odeOrder(std::string_view family, Index s) {
  if (family == "gauss") return theorem(2 * s);
  if (family.starts_with("radau")) return theorem(2 * s - 1);
  if (family.starts_with("lobatto")) return theorem(2 * s - 2);
  return {};
}

// Stiffly accurate methods keep their order. The others have order s, or s + 1 if R(infinity) = -1, where errors of
// successive steps cancel. HW II (VI.1).
Order index1(std::string_view family, Index s, char component) {
  if (component == 'x') return family == "lobatto_iiib" ? Order() : odeOrder(family, s);
  if (component != 'z') return {};
  if (family == "gauss") return theorem(evenAbove(s));
  if (family == "radau_ia") return theorem(s);
  if (family == "radau_iia") return theorem(2 * s - 1);
  if (family == "lobatto_iiia" || family == "lobatto_iiic") return theorem(2 * s - 2);
  if (family == "lobatto_iiid") return pattern(evenAbove(s), s);
  return {};
}

// HLR, table 4.1.
Order index2(std::string_view family, Index s, char component) {
  if (component != 'x' && component != 'z') return {};
  const bool z = component == 'z';
  if (family == "gauss") return theorem(z ? evenAbove(s) - 2 : evenAbove(s));
  if (family == "radau_ia") return theorem(z ? std::max<Index>(1, s - 1) : s);
  if (family == "radau_iia") return theorem(z ? s : 2 * s - 1);
  if (family == "lobatto_iiia") return theorem(z ? evenBelow(s) : 2 * s - 2);
  if (family == "lobatto_iiic") return theorem(z ? s - 1 : 2 * s - 2);
  if (family == "lobatto_iiid") return pattern(z ? evenAbove(s) - 2 : evenAbove(s), s);
  return {};
}

Order ofMechanical(const Order& u, const Order& v, const Order& z, char component) {
  return component == 'u' ? u : component == 'v' ? v : component == 'z' ? z : Order();
}

// The system is linear in lambda. The only difference to general index 2 is that q gains order from the quadrature.
Order mechanical2(std::string_view family, Index s, char component) {
  const Order v = index2(family, s, 'x'), z = index2(family, s, 'z');
  if (family == "gauss") return ofMechanical(pattern(2 * s, s), v, z, component);
  if (family == "radau_ia") return ofMechanical(pattern(2 * s - 1, s), v, z, component);
  if (family == "lobatto_iiid") return {};
  return ofMechanical(v, v, z, component);
}

Order projected(std::string_view family, Index s, char component) {
  const bool healed = family == "gauss" || family == "radau_ia";
  if (healed && component == 'z') return {};
  return mechanical2(family, s, component == 'v' && healed ? 'u' : component);
}

// Another index-2 system: q' = v - G^T mu is not linear in the multiplier mu that GGL adds.
Order ggl(std::string_view family, Index s, char component) {
  const bool harmed = family == "gauss" || family == "radau_ia";
  return mechanical2(family, s, component == 'u' && harmed ? 'v' : component);
}

Order mechanical3(std::string_view family, Index s, char component) {
  if (family == "gauss") {
    const Index q = evenAbove(s);
    return ofMechanical(pattern(q, s), pattern(q - 2, s), pattern(q - 4, s), component);
  }
  if (family == "radau_ia") {
    return ofMechanical(pattern(s, s), pattern(std::max<Index>(1, s - 1), s), pattern(s == 1 ? 1 : s - 2, s),
                        component);
  }
  if (family == "radau_iia") {
    return ofMechanical(theorem(2 * s - 1), theorem(s), theorem(std::max<Index>(1, s - 1)), component);
  }
  if (family == "lobatto_iiia") {
    const Index even = evenBelow(s);
    return ofMechanical(pattern(2 * even - 2, s), pattern(even, s), pattern(even - 2, s), component);
  }
  if (family == "lobatto_iiic") {
    return ofMechanical(theorem(2 * s - 2), theorem(s - 1), theorem(s - 2), component);
  }
  return {};
}

// Since errors of y and w are reported together, the order is that of w.
Order index3(std::string_view family, Index s, char component) {
  return component == 'u' || component == 'v' ? Order() : mechanical3(family, s, component == 'x' ? 'v' : 'z');
}

struct StiffOrder {
  Index h, z;  // error = C h^h |z|^z
};

// HW II (IV.15) and measurements: error of y' = lambda (y - phi) + phi' for z = h lambda -> -infinity.
std::optional<StiffOrder> stiffOrder(std::string_view family, Index s) {
  if (family == "gauss") return StiffOrder{evenAbove(s), 0};
  if (family == "radau_ia") return StiffOrder{s, 0};
  if (family == "radau_iia") return StiffOrder{s + 1, -1};
  if (family == "lobatto_iiia") return StiffOrder{evenBelow(s) + 1, -1};
  if (family == "lobatto_iiib") return StiffOrder{evenBelow(s) - 1, 1};
  if (family == "lobatto_iiic") return StiffOrder{s, -1};
  if (family == "lobatto_iiid") return StiffOrder{evenAbove(s) - 1, -1};
  return {};
}

Order stiff(std::string_view family, Index s, SystemKind kind) {
  const auto power = stiffOrder(family, s);
  if (!power) return {};
  if (kind == SystemKind::kStiffFixedZ) return pattern(power->h, s);
  if (kind == SystemKind::kStiffPowerOfZ) return pattern(power->z, s);
  return pattern(power->h + power->z, s);
}

}  // namespace

std::optional<TheoreticalOrder> theoreticalOrder(std::string_view family, Index s, SystemKind kind, char component) {
  switch (kind) {
    case SystemKind::kOde:
      return component == 'z' ? Order() : odeOrder(family, s);
    case SystemKind::kIndex1:
      return index1(family, s, component);
    case SystemKind::kIndex2:
      return index2(family, s, component);
    case SystemKind::kIndex3:
      return index3(family, s, component);
    case SystemKind::kMechanical3:
      return mechanical3(family, s, component);
    case SystemKind::kMechanical2:
      return mechanical2(family, s, component);
    case SystemKind::kProjected:
      return projected(family, s, component);
    case SystemKind::kGgl:
      return ggl(family, s, component);
    case SystemKind::kStiffFixedZ:
    case SystemKind::kStiffPowerOfZ:
    case SystemKind::kStiffFixedLambda:
      return component == 'x' ? stiff(family, s, kind) : Order();
  }
  return {};
}

bool isSymmetric(std::string_view family) {
  return family == "gauss" || family == "lobatto_iiia" || family == "lobatto_iiib" || family == "lobatto_iiid";
}

}  // namespace irk
