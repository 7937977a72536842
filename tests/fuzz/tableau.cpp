// libFuzzer target: any bytes as a tableau file. Throwing Misuse is correct; anything else aborts.
#include <cstddef>
#include <cstdint>
#include <string>

#include "irk/misuse.h"
#include "tableaus/files/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    irk::parseTableau(text, "fuzz.txt");
  } catch (const irk::Misuse&) {
  }
  return 0;
}
