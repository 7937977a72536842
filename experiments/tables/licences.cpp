#include "experiments/tables/licences.h"

#include <fmt/format.h>

#include "experiments/tables/build_info.h"

namespace irk {

std::string versionText() {
  std::string text = fmt::format(
      "{} {}\n"
      "The sources are under the BSD licence of 3 clauses. The program contains parts of, or is linked with:\n"
      "  Eigen (MPL 2.0), Boost (BSL 1.0), MPFR (LGPL 3 or later), SuiteSparse's KLU (LGPL 2.1 or later), SUNDIALS "
      "(BSD, 3 clauses), fmt "
      "(MIT),\n"
      "  Google Benchmark (Apache 2.0), CLI11 (BSD, 3 clauses), toml++ (MIT), nlohmann/json (MIT), SQLite (public "
      "domain); where it reads FMUs, libzip (BSD,\n  3 clauses) and pugixml (MIT); the explorer's page: d3 (BSD, 3 "
      "clauses)",
      buildInfo().version, buildInfo().commit);
#ifdef IRK_HAS_GSL
  text +=
      "\n  GSL (GPL 3 or later), for three integrators that others are compared with. With it the program as a whole "
      "may be "
      "passed\n  on under the GPL only; built with IRK_GSL=OFF it has no such part.";
#endif
  return text;
}

}  // namespace irk
