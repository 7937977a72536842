// What modelDescription.xml of an FMU says, as far as Model Exchange needs it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace irk::own {

/// The types of variables that can be set.
enum class FmuType { kReal, kInteger, kBoolean };

/// A number, or one element of an array, as x[2] or A[1.2]. Elements follow each other row by row, as in the FMU; all
/// have the array's value reference.
struct FmuVariable {
  std::string name, unit, meaning;
  unsigned reference = 0;
  std::size_t element = 0, count = 1;  ///< the number of this element, and that of all elements of its array
  FmuType type = FmuType::kReal;
  std::string start;   ///< as in the file; empty: none
  bool input = false;  ///< it may change at any time; of numbers of the type kReal only
  double min = -1e300, max = 1e300;
  double nominal = 1;
};

struct FmuDescription {
  int version = 2;                       ///< 2 or 3
  std::string name, token;               ///< token: the guid of version 2
  std::string identifier;                ///< of the model: the name of its library
  std::vector<std::string> sources;      ///< C files
  std::vector<std::string> definitions;  ///< for their compiler: NAME or NAME=VALUE
  bool once_per_process = false, directional_derivatives = false, states_kept = false, steps_completed = false;
  std::size_t indicators = 0;
  double start = 0, stop = 1;
  std::vector<FmuVariable> states;    ///< in the order of the standard's vector of states
  std::vector<unsigned> derivatives;  ///< the references of their derivatives, in the same order
  std::vector<FmuVariable> settable;  ///< parameters, inputs and start values of states, of numbers
  std::vector<FmuVariable> outputs;   ///< real ones
};

/// Reads a modelDescription.xml. Throws Misuse, without the name of a file, for one that cannot be read, for another
/// version of the standard, for co-simulation only, for sizes of arrays out of range, and for start values that are no
/// numbers or not as many as the array has. Structural parameters keep their start values.
FmuDescription readDescription(const std::filesystem::path& xml);

/// Reads sources/buildDescription.xml of version 3, if it is there: C files and definitions of a model.
void readBuildDescription(const std::filesystem::path& sources, FmuDescription& fmu);

/// For each state the number of the state that is its derivative, as u has v, or -1: the derivative of the one has the
/// value reference of the other. No state is in two pairs.
std::vector<int> velocitiesOf(const FmuDescription& fmu);

}  // namespace irk::own
