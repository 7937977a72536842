// What measured a time: times of different classes are not joined or compared.
#pragma once

#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace irk {

/// The library in which the integrators of this method are, as environments.csv names it: `SUNDIALS` or `GSL`; empty
/// for those of the program.
std::string_view libraryOfMethod(std::string_view method);

/// `PROCESSOR; COMPILER; FLAGS; LIBRARIES` of a row of environments.csv: of the libraries, with their versions, those
/// that an integrator of the program uses, and `library`.
std::string timingClass(const std::vector<std::string>& columns, const TableRow& environment, std::string_view library);

}  // namespace irk
