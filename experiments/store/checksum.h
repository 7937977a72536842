// A checksum at the end of each line of a part file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace irk::store {

/// A hash of 64 bits that differs for any two texts of one length that differ within eight bytes at a multiple of
/// eight, and for all but one in 2e19 other pairs. It is the same on every machine, and takes a tenth of the time of
/// fnv1a.
std::uint64_t checksum(std::string_view bytes);

/// The line of a row, without a line end, with a last cell of 16 hexadecimal digits: the checksum of what stands before
/// its comma.
std::string sealedRow(std::string_view line);
/// The line of column names with a last cell `checksum:` and 16 digits.
std::string sealedNames(std::string_view line);

/// Whether the line ends with its checksum, as sealedRow or sealedNames has written it; if so, removes it.
bool checkRow(std::string_view& line);
bool checkNames(std::string_view& line);

}  // namespace irk::store
