// A checksum at the end of each line of a part file: fnv1a, which differs for any two texts of one length that differ
// in one byte, and for all but one in 2e19 other pairs.
#pragma once

#include <string>
#include <string_view>

namespace irk::store {

/// The line of a row, without a line end, with a last cell of 16 hexadecimal digits: the checksum of what stands before
/// its comma.
std::string sealedRow(std::string_view line);
/// The line of column names with a last cell `checksum:` and 16 digits.
std::string sealedNames(std::string_view line);

/// Whether the line ends with its checksum, as sealedRow or sealedNames has written it; if so, removes it.
bool checkRow(std::string_view& line);
bool checkNames(std::string_view& line);

}  // namespace irk::store
