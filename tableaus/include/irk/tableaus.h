// Families of implicit Runge-Kutta schemes, any number of stages, in any precision.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "irk/tableau.h"

namespace irk {

/// One family: `id` + "_" + s names its s-stage member.
struct FamilyEntry {
  std::string id;     ///< gauss, radau_ia, radau_iia, lobatto_iiia, ...
  std::string title;  ///< "Radau IIA"
  Index min_stages;   ///< 1 or 2
  std::string order;  ///< "2s-1", for lists
};

/// All families, sorted as theory.md lists them.
const std::vector<FamilyEntry>& familyCatalogue();

/// `radau_iia_5` or the path of a tableau file. Constructed in multiprecision, rounded once to Real
/// (double, mp50, mp100). Throws Misuse: unknown family (names the nearest), s out of range, bad file,
/// a file with fewer digits than Real, any file for mp100.
template <class Real>
Tableau<Real> makeTableau(std::string_view id_or_file);

/// Whether it is the id of a family, without a number of stages.
bool isFamily(std::string_view id);

/// For variable order: the members of a family of stage order 1 at least, up to `max_stages`. Of an id as
/// `radau_iia_5` that member is
/// the first used, and in any case there; of a family's id that with the number of stages next to
/// `first`. Throws Misuse as makeTableau, and for a tableau file.
template <class Real>
Methods<Real> makeMethods(std::string_view id, Index max_stages, Index first);

/// Classical order p and stage order q of a family's s-stage member.
int classicalOrder(std::string_view family, Index s);
int stageOrder(std::string_view family, Index s);

}  // namespace irk
