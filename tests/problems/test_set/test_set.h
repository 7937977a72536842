// The scenes of problems/test_set, each with a tolerance at which a run takes less than a second.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "irk/scene.h"

namespace irk::test {

struct TestSetCase {
  const char* id;
  double tolerance = 1e-11;
  const char* setting = "";
  const char* value = "";

  Settings settings() const { return *setting == '\0' ? Settings{} : Settings{{setting, value}}; }
};

inline constexpr TestSetCase kTestSet[] = {{.id = "andrews"},
                                           {.id = "beam", .tolerance = 1e-10},
                                           {.id = "caraxis"},
                                           {.id = "chemakzo"},
                                           {.id = "e5"},
                                           {.id = "medakzo"},
                                           {.id = "nand"},
                                           {.id = "nand", .setting = "beta_back", .value = "1.748e-3"},
                                           {.id = "orego"},
                                           {.id = "pollution"},
                                           {.id = "pump", .tolerance = 1e-10},
                                           {.id = "ringmod", .tolerance = 1e-9},
                                           {.id = "ringmod", .tolerance = 1e-9, .setting = "Cs", .value = "0"},
                                           {.id = "transamp"}};

inline bool isOfTheTestSet(std::string_view scene) {
  return std::any_of(std::begin(kTestSet), std::end(kTestSet), [&](const auto& c) { return c.id == scene; });
}

}  // namespace irk::test
