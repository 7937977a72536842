// Collections: named sets of scenes, for lists and studies. Each scene's entry says which ones it is in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irk {

/// The names of all collections, sorted: `ivp`, the problems of the IVP test set; `multibody`, mechanisms; `switching`,
/// scenes whose equations switch; `probes`, small problems that show one property of a method; `foreign`, systems after
/// questions and bug reports of other programs' users; and those of the scenes that were registered.
std::vector<std::string> collections();

/// The ids of a collection's scenes, in the order of the catalogue. Throws Misuse for an unknown collection, naming the
/// nearest one.
std::vector<std::string> scenesOf(std::string_view collection);

/// The collections of a scene; none for an id that is not in the catalogue, such as one in an older table.
std::vector<std::string> collectionsOf(std::string_view scene);

}  // namespace irk
