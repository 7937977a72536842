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
/// The line of column names with a last cell `checksum:` and 16 digits. It tells a part with checksums from a former
/// one.
std::string sealedNames(std::string_view line);

/// What a line says of itself.
enum class Seal {
  kNone,   ///< no cell of a checksum
  kWrong,  ///< the line has changed since it was written
  kRight,
};
/// Removes the checksum from `line` if it is right.
Seal checkRow(std::string_view& line);
Seal checkNames(std::string_view& line);

}  // namespace irk::store
