// libFuzzer target: any bytes as a study file. Throwing Misuse is correct; anything else aborts.
#include <cstddef>
#include <cstdint>
#include <string>

#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"
#include "irk/misuse.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    irk::parseStudy(text, "fuzz.toml", irk::StudyVariant::kFull);
  } catch (const irk::Misuse&) {
  }
  return 0;
}
