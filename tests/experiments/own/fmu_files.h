// FMUs of tests/fmus, and damaged copies of them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "experiments/own/files.h"
#include "tests/experiments/own/own_files.h"

namespace irk {

inline std::string fmu(const std::string& name, int version) {
  return IRK_FMUS "/fmu_" + name + "_" + std::to_string(version) + ".fmu";
}

inline Solution<double> ofFmu(const std::string& file, double tolerance = 1e-8) {
  return integrated(makeSetup<double>(radauSpec(own::loadFile(file), tolerance)));
}

/// FMUs that are not as they should be.
class DamagedFmu : public OwnFiles {
 protected:
  // An archive `name` of the files of an FMU with one text of the description replaced.
  void pack(const std::string& name, int version, const std::string& from, const std::string& to,
            const std::string& model = "pendulum") {
    const std::filesystem::path made = IRK_FMUS "/fmu_" + model + "_" + std::to_string(version),
                                here = folder_.path() / name;
    std::filesystem::copy(made, here, std::filesystem::copy_options::recursive);
    write(name + "/modelDescription.xml", replaced(name + "/modelDescription.xml", from, to));
    zip(name);
  }
  void zip(const std::string& name) {
    const std::string archive = (folder_.path() / (name + ".fmu")).string();
    const std::string command =
        "cd " + (folder_.path() / name).string() + " && " IRK_CMAKE " -E tar cf " + archive + " --format=zip *";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
};

}  // namespace irk
