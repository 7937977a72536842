// A cache folder of one test, instead of the user's own.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "tests/experiments/support.h"

namespace irk {

class WithOwnCache : public testing::Test {
 protected:
  WithOwnCache() { setenv("IRK_CACHE", folder_.path().c_str(), 1); }
  ~WithOwnCache() override { unsetenv("IRK_CACHE"); }

  std::vector<std::filesystem::path> cached() const {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder_.path() / "references")) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "references")) {
      files.push_back(entry.path());
    }
    return files;
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace irk
