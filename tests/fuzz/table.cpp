// libFuzzer target: any bytes as a table of results. Throwing Misuse is correct; anything else aborts.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "experiments/tables/table.h"
#include "irk/misuse.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string file = "/tmp/irk_fuzz_" + std::to_string(getpid()) + ".csv";
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    irk::readTable(file);
  } catch (const irk::Misuse&) {
  }
  return 0;
}
