// An FMU that is unpacked and loaded, and the order of its states in a scene.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "experiments/own/fmu/instance.h"

namespace irk::own {

class FmuRun;

/// An instance, the run that it serves, and the epoch of the run in which it is (FmuRun).
struct FmuSlot {
  std::mutex mutex;
  std::unique_ptr<FmuInstance> instance;
  const FmuRun* owner = nullptr;
  std::size_t epoch = 0;
};

struct FmuModel {
  FmuLibrary fmu;
  std::string hash;                ///< of the file
  std::size_t nu = 0, nx = 0;      ///< second-order and first-order unknowns
  std::vector<std::size_t> order;  ///< for y = (u, v, x) the numbers of the states
  std::shared_ptr<FmuSlot> only;   ///< that of an FMU which can be instantiated only once; else null

  std::unique_ptr<FmuInstance> instance() const { return fmu.description.version == 2 ? makeFmi2(fmu) : makeFmi3(fmu); }
};

/// Unpacks and loads an FMU; compiles its sources where it has no library for this platform. Throws Misuse, beginning
/// with the name of the file, for what cannot be used.
std::shared_ptr<const FmuModel> loadFmu(const std::filesystem::path& file);

}  // namespace irk::own
