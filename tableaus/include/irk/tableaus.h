// Families of implicit Runge-Kutta schemes, any number of stages, in any precision.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "irk/tableau.h"

namespace irk {

/// A family; `id` + "_" + s is the id of its s-stage member.
struct FamilyEntry {
  std::string id;     ///< gauss, radau_ia, radau_iia, lobatto_iiia, ...
  std::string title;  ///< "Radau IIA"
  Index min_stages;   ///< 1 or 2
  std::string order;  ///< "2s-1", for lists
};

/// All families, in the order of tableaus/README.md.
const std::vector<FamilyEntry>& familyCatalogue();

/// The tableau `radau_iia_5`, or that of a file given by path; constructed in multiprecision and rounded once to Real
/// (double, BigFloat with the WorkingDigits of the thread). Throws Misuse for an unknown family (naming the nearest), s
/// out of range, a bad file, and a file with fewer digits than Real.
template <class Real>
Tableau<Real> makeTableau(std::string_view id_or_file);

/// Whether `id` is the id of a family, without a number of stages.
bool isFamily(std::string_view id);
/// The family of an id, `gauss` of `gauss_3` and of `gauss`; empty for a file and for what is no id.
std::string_view familyOfId(std::string_view id);

/// The methods for variable order: the members of a family with stage order >= 1 and up to `max_stages` stages. For
/// an id such as `radau_iia_5` that member is used first, and is always included; for a family's id the member whose
/// number of stages is nearest to `first`. Throws Misuse as makeTableau, for a tableau file, and for `max_stages` other
/// than 1 to kMaxStages.
template <class Real>
Methods<Real> makeMethods(std::string_view id, Index max_stages, Index first);

/// Classical order p and stage order q of a family's s-stage member. Throws Misuse as makeTableau.
int classicalOrder(std::string_view family, Index s);
int stageOrder(std::string_view family, Index s);

}  // namespace irk
