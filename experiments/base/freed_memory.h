// What happens to memory that the program has freed.
#pragma once

namespace irk {

/// From now on the process keeps freed memory for its next allocations, where the C library is glibc; elsewhere this
/// does nothing. Otherwise each run of a large system asks the operating system for its pages anew, which takes a fifth
/// of the time of 20 000 unknowns, and which a program that makes one run after the other need not pay. Blocks above
/// 32 MB are returned as before. Holds for all methods, the own ones and those of other libraries.
void keepFreedMemory();

}  // namespace irk
