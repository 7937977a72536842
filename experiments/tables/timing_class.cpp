#include "experiments/tables/timing_class.h"

#include <algorithm>
#include <vector>

namespace irk {
namespace {

std::string cellOf(const std::vector<std::string>& columns, const TableRow& row, std::string_view column) {
  const auto at = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
  return at < row.size() ? row[at] : "unknown";
}

// `NAME VERSION` from a list `...; NAME VERSION; ...`; empty if it does not have the name.
std::string versionIn(std::string_view libraries, std::string_view name) {
  while (!libraries.empty()) {
    const auto item = libraries.substr(0, libraries.find("; "));
    if (item.starts_with(name) && item.substr(name.size()).starts_with(' ')) return std::string(item);
    libraries.remove_prefix(std::min(item.size() + 2, libraries.size()));
  }
  return {};
}

}  // namespace

std::string_view libraryOfMethod(std::string_view method) {
  for (const std::string_view begin : {"arkode_", "cvode_", "ida_"}) {
    if (method.starts_with(begin)) return "SUNDIALS";
  }
  return method.starts_with("gsl_") ? "GSL" : "";
}

std::string timingClass(const std::vector<std::string>& columns, const TableRow& environment,
                        std::string_view library) {
  std::string text;
  for (const auto* column : {"cpu", "compiler", "flags"}) {
    text += (text.empty() ? "" : "; ") + cellOf(columns, environment, column);
  }
  const auto libraries = cellOf(columns, environment, "libraries");
  for (const std::string_view name :
       {std::string_view("glibc"), std::string_view("Eigen"), std::string_view("KLU"), library}) {
    const auto version = name.empty() ? "" : versionIn(libraries, name);
    if (!version.empty()) text += "; " + version;
  }
  return text;
}

}  // namespace irk
