#include "experiments/own/fmu/model.h"

#include <fmt/format.h>
#include <unistd.h>

#include <sstream>

#include "experiments/base/child_process.h"
#include "experiments/own/compiler.h"
#include "experiments/own/fmu/archive.h"
#include "irk/misuse.h"

namespace irk::own {
namespace {

namespace fs = std::filesystem;

// The first line with an error of a compiler's messages.
std::string firstError(const std::string& messages) {
  std::istringstream in(messages);
  for (std::string line; std::getline(in, line);) {
    if (line.find("error:") != line.npos) return line;
  }
  return messages.substr(0, messages.find('\n'));
}

// An FMU with sources holds all that they include, but for the standard's own headers, which the compiler has to find.
fs::path compiledSources(const FmuDescription& fmu, const fs::path& folder) {
  const fs::path object = folder / (fmu.identifier + ".so");
  std::error_code none;
  if (fs::exists(object, none)) return object;
  const fs::path sources = folder / "sources", made = object.string() + fmt::format(".{}", getpid());
  std::vector<std::string> command{"cc", "-O2", "-shared", "-fPIC", "-w", "-I" + sources.string()};
  for (const auto& definition : fmu.definitions) command.push_back("-D" + definition);
  for (const auto& file : fmu.sources) command.push_back((sources / file).string());
  command.insert(command.end(), {"-lm", "-o", made.string()});
  const ChildResult child = runChild(command);
  if (child.status != 0) {
    throw Misuse("its sources do not compile, and it has no library for this platform: " + firstError(child.messages));
  }
  fs::rename(made, object);
  return object;
}

fs::path libraryIn(FmuDescription& fmu, const fs::path& folder) {
  const char* const platform = fmu.version == 2 ? "linux64" : "x86_64-linux";
  const fs::path library = folder / "binaries" / platform / (fmu.identifier + ".so");
  std::error_code none;
  if (fs::exists(library, none)) return library;
  if (fmu.version == 3) readBuildDescription(folder / "sources", fmu);
  if (!fmu.sources.empty() && fs::exists(folder / "sources", none)) return compiledSources(fmu, folder);
  throw Misuse(
      fmt::format("it has no library for this platform, binaries/{}/{}.so, and no sources", platform, fmu.identifier));
}

void setOrder(FmuModel& model) {
  const FmuDescription& fmu = model.fmu.description;
  const std::vector<int> velocity = velocitiesOf(fmu);
  std::vector<bool> second(fmu.states.size(), false);
  std::vector<std::size_t> v;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    if (velocity[i] < 0) continue;
    model.order.push_back(i);
    v.push_back(static_cast<std::size_t>(velocity[i]));
    second[i] = second[v.back()] = true;
  }
  model.nu = v.size();
  model.order.insert(model.order.end(), v.begin(), v.end());
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (!second[i]) model.order.push_back(i);
  }
  model.nx = fmu.states.size() - 2 * model.nu;
}

}  // namespace

std::shared_ptr<const FmuModel> loadFmu(const fs::path& file) {
  const Unpacked unpacked = unpack(file);
  const auto model = std::make_shared<FmuModel>();
  model->hash = unpacked.hash;
  try {
    std::error_code none;
    const fs::path xml = unpacked.folder / "modelDescription.xml";
    if (!fs::exists(xml, none)) throw Misuse("it has no modelDescription.xml");
    FmuDescription& description = model->fmu.description = readDescription(xml);
    model->fmu.library = std::make_shared<const SharedLibrary>(libraryIn(description, unpacked.folder));
    model->fmu.resources = (unpacked.folder / "resources").string();
  } catch (const Misuse& misuse) {
    throw Misuse(file.string() + ": " + misuse.what());
  }
  setOrder(*model);
  if (model->fmu.description.once_per_process) model->only = std::make_shared<FmuSlot>();
  return model;
}

}  // namespace irk::own
