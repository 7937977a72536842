// The program `irk`.
#include <cstdlib>  // defines __GLIBC__
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "experiments/commands/cli.h"

namespace {

// From now on the process keeps freed memory for its next allocations, and holds as much as its largest run needed
// until it ends. Otherwise each run of a large system asks the operating system for all its pages again, which is a
// fifth of the time of a run with 20 000 unknowns. Blocks above 32 MB are returned as before. Other libraries'
// integrators gain as ours do. Does nothing where the C library is not glibc.
void keepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kLargestThreshold = 32 << 20;  // the most that glibc takes on machines with 64 bits
  mallopt(M_MMAP_THRESHOLD, kLargestThreshold);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keepFreedMemory();
  return irk::runProgram({argv + 1, argv + argc}, {std::cout, std::cerr});
}
