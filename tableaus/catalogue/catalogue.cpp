#include "irk/tableaus.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>
#include <type_traits>

#include "core/base/kept.h"
#include "core/base/text.h"
#include "irk/misuse.h"
#include "tableaus/catalogue/constants.h"
#include "tableaus/catalogue/source.h"
#include "tableaus/families/families.h"
#include "tableaus/files/file.h"

namespace irk {
namespace {

struct MemberId {
  std::string_view family, stages;  ///< `radau_iia`, `5`
};

std::optional<MemberId> splitId(std::string_view id) {
  const std::size_t underscore = id.rfind('_');
  if (underscore == std::string_view::npos) return std::nullopt;
  return MemberId{id.substr(0, underscore), id.substr(underscore + 1)};
}

bool isWholeNumber(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

[[noreturn]] void refuseId(std::string_view id) {
  if (const Family* family = findFamily(id)) {
    throw Misuse(fmt::format("tableau '{0}' lacks its number of stages: {0}_{1} to {0}_{2}", id, family->minStages(),
                             kMaxStages));
  }
  const auto member = splitId(id);
  const bool numbered = member && isWholeNumber(member->stages);
  std::vector<std::string> known;
  for (const Family& family : families()) {
    known.push_back(fmt::format("{}_{}", family.id, numbered ? member->stages : "S"));
  }
  throw Misuse(unknownName("tableau", id, known));
}

bool looksLikeFile(std::string_view text) { return text.find('/') != std::string_view::npos || text.ends_with(".txt"); }

/// The member of a family; nullopt for files and unknown ids.
std::optional<MemberId> memberOf(std::string_view id_or_file) {
  const auto member = splitId(id_or_file);
  const bool known = member && !looksLikeFile(id_or_file) && findFamily(member->family);
  return known ? member : std::nullopt;
}

Index stagesOf(std::string_view id, const MemberId& member) {
  const Family& family = familyOf(member.family);
  int s = 0;
  const char* const end = member.stages.data() + member.stages.size();
  const auto [stop, error] = std::from_chars(member.stages.data(), end, s);
  const bool canonical = error == std::errc() && stop == end && std::to_string(s) == member.stages;
  if (!canonical || s < family.minStages() || s > kMaxStages) {
    throw Misuse(fmt::format("tableau '{}': '{}' stages, but {} has {} to {}", id, member.stages, family.id,
                             family.minStages(), kMaxStages));
  }
  return s;
}

TableauFile locate(std::string_view id_or_file, TableauFile (*read)(const std::string&)) {
  const std::string path(id_or_file);
  if (looksLikeFile(id_or_file)) return read(path);
  if (const auto member = memberOf(id_or_file)) {
    return constructedFile(member->family, stagesOf(id_or_file, *member));
  }
  if (std::filesystem::is_regular_file(path)) return read(path);
  refuseId(id_or_file);
}

}  // namespace

const std::vector<FamilyEntry>& familyCatalogue() {
  static const std::vector<FamilyEntry> catalogue = [] {
    std::vector<FamilyEntry> entries;
    for (const Family& family : families()) {
      const std::string order = family.p_gap == 0 ? "2s" : fmt::format("2s-{}", family.p_gap);
      entries.push_back({family.id, family.title, family.minStages(), order});
    }
    return entries;
  }();
  return catalogue;
}

TableauFile findTableau(std::string_view id_or_file) { return locate(id_or_file, readTableau); }

TableauFile findUncheckedTableau(std::string_view id_or_file) { return locate(id_or_file, openTableau); }

template <class Real>
Tableau<Real> makeTableau(std::string_view id_or_file) {
  if (const auto member = memberOf(id_or_file)) {
    const Family& family = familyOf(member->family);
    const Index s = stagesOf(id_or_file, *member);
    if constexpr (std::is_same_v<Real, double>) return familyInDouble(family, s);
    return constructFamily(family, s).template cast<Real>();
  }
  const TableauFile file = findTableau(id_or_file);
  const int wanted = std::is_same_v<Real, double> ? std::numeric_limits<double>::digits10 : WorkingDigits::now();
  if (wanted > kFileDigits) {
    throw Misuse(
        fmt::format("{}: tableau files have too few digits for this scalar of {} digits; use "
                    "one of the families",
                    id_or_file, wanted));
  }
  if (file.digits < wanted) {
    throw Misuse(
        fmt::format("{}: accurate to {} digits, this scalar needs {}; if its coefficients are, add 'digits: {}'",
                    id_or_file, file.digits, wanted, wanted));
  }
  return file.tableau.cast<Real>();
}

bool isFamily(std::string_view id) { return findFamily(id) != nullptr; }

std::string_view familyOfId(std::string_view id) {
  if (isFamily(id)) return id;
  const auto member = memberOf(id);
  return member && isWholeNumber(member->stages) ? member->family : std::string_view();
}

template <class Real>
Methods<Real> makeMethods(std::string_view id, Index max_stages, Index first) {
  const auto member = memberOf(id);
  if (!member && !isFamily(id)) {
    static_cast<void>(makeTableau<Real>(id));  // throws with the reason for an invalid id or file
    throw Misuse(
        fmt::format("illegal combination: order 'variable' with the tableau file '{}': "
                    "a file is one method; use one of the families",
                    id));
  }
  if (max_stages < 1 || max_stages > kMaxStages) {
    throw Misuse(fmt::format("max_stages = {}: 1 to {} is expected", max_stages, kMaxStages));
  }
  const Family& family = familyOf(member ? member->family : id);
  // Members of stage order 0 are left out: their error estimate misses forces that depend on time only; see
  // EmbeddedEstimate.
  Index least = family.minStages();
  while (family.orders(least).q < 1) ++least;
  const Index given = member ? stagesOf(id, *member) : least;
  least = std::min(least, given);
  const Index most = std::max(max_stages, given);
  const Index start = member ? given : std::clamp(first, least, most);
  const auto all = [&] {
    std::vector<Tableau<Real>> members;
    for (Index s = least; s <= most; ++s) {
      members.push_back(makeTableau<Real>(fmt::format("{}_{}", family.id, s)));
    }
    return Methods<Real>(std::move(members), 0);
  };
  Methods<Real> methods = [&] {
    if constexpr (std::is_same_v<Real, double>) {
      static Kept<Methods<double>> kept;  // integrators of variable order ask for the same ones again and again
      return Methods<double>(*kept.of(fmt::format("{} {} {}", family.id, least, most), all));
    } else {
      return all();
    }
  }();
  methods.start = static_cast<std::size_t>(start - least);
  return methods;
}

namespace {

SimplifyingOrders ordersOf(std::string_view id, Index s) {
  const Family& family = familyOf(id);
  requireStages(family, s);
  return family.orders(s);
}

}  // namespace

int classicalOrder(std::string_view family, Index s) { return ordersOf(family, s).p; }

int stageOrder(std::string_view family, Index s) { return ordersOf(family, s).q; }

template Tableau<double> makeTableau(std::string_view);
template Tableau<BigFloat> makeTableau(std::string_view);
template Methods<double> makeMethods(std::string_view, Index, Index);
template Methods<BigFloat> makeMethods(std::string_view, Index, Index);

}  // namespace irk
