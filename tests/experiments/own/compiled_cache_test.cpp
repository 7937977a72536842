// The cache of compiled files: whose files are taken, what happens to damaged ones, and who compiles.
#include "experiments/own/compiled_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "experiments/own/compiler.h"
#include "experiments/own/shared_library.h"
#include "tests/experiments/reference/own_cache.h"
#include "tests/experiments/stored_runs.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

class CompiledCache : public WithOwnCache {
 protected:
  CompiledCache() { std::ofstream(source_) << "extern \"C\" int answer() { return 42; }\n"; }
  // What it says.
  std::string compile() {
    std::ostringstream log;
    object_ = own::compile(source_, 16, log).object;
    return log.str();
  }
  // Compiles in several processes at once; returns what each has said, and its refusal.
  std::vector<std::string> compileInProcesses(int count) const {
    const auto said = [this](int i) { return folder() / ("said_" + std::to_string(i)); };
    std::vector<pid_t> children;
    for (int i = 0; i < count; ++i) {
      children.push_back(startProcess([&] {
        std::ofstream log(said(i));
        try {
          own::compile(source_, 16, log);
        } catch (const Misuse& misuse) {
          log << misuse.what() << '\n';
        }
        return 0;
      }));
    }
    std::vector<std::string> all;
    for (int i = 0; i < count; ++i) {
      EXPECT_EQ(exitStatusOf(children[static_cast<std::size_t>(i)]), 0);
      all.push_back(readInputFile(said(i)));
    }
    return all;
  }
  static std::ptrdiff_t countOf(const std::vector<std::string>& said, const std::string& text) {
    return std::count_if(said.begin(), said.end(), [&](const auto& one) { return one.find(text) != one.npos; });
  }

  std::filesystem::path source_ = folder() / "mine.cpp", object_;
};

int answerOf(const std::filesystem::path& object) { return SharedLibrary(object).get<int()>("answer")(); }

TEST_F(CompiledCache, ADamagedObjectIsCompiledAnewOnce) {
  EXPECT_TRUE(containsAll(compile(), {"compiling"}));
  EXPECT_EQ(compile(), "");
  const std::string bytes = readInputFile(object_);
  for (const std::string& damaged : {bytes.substr(0, bytes.size() / 2), bytes + " ", std::string()}) {
    std::ofstream(object_, std::ios::binary) << damaged;
    EXPECT_TRUE(containsAll(compile(), {"compiling", "damaged"}));
    EXPECT_EQ(compile(), "");
  }
  EXPECT_EQ(answerOf(object_), 42);
}

TEST_F(CompiledCache, AnObjectThatOthersCanWriteIsNotTaken) {
  compile();
  ASSERT_EQ(chmod(object_.c_str(), 0777), 0);
  EXPECT_TRUE(containsAll(compile(), {"compiling", "others can write"}));
  EXPECT_EQ(compile(), "");
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
  ASSERT_EQ(chown(object_.c_str(), 65534, 65534), 0);
  EXPECT_TRUE(containsAll(compile(), {"compiling"}));
}

TEST_F(CompiledCache, AFolderOfOthersIsRefused) {
  compile();
  const auto cache = folder() / "compiled";
  ASSERT_EQ(chmod(cache.c_str(), 0777), 0);
  EXPECT_TRUE(containsAll(misuseOf([&] { compile(); }), {cache, "can be written by others", "IRK_CACHE"}));
  ASSERT_EQ(chmod(cache.c_str(), 0755), 0);
  EXPECT_EQ(compile(), "");
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder to another user";
  ASSERT_EQ(chown(cache.c_str(), 65534, 65534), 0);
  EXPECT_TRUE(containsAll(misuseOf([&] { compile(); }), {cache, "belongs to user 65534", "IRK_CACHE"}));
}

TEST_F(CompiledCache, OneProcessCompiles) {
  std::ofstream(source_) << "#include <regex>\nextern \"C\" int answer() { return std::regex(\"a\").mark_count(); }\n";
  const auto said = compileInProcesses(4);
  EXPECT_EQ(countOf(said, "irk: compiling"), 1);
  EXPECT_EQ(countOf(said, "waiting for another process that compiles"), 3);
}

// The processes that have waited take the failure; a later one tries again, as a library may have been installed.
TEST_F(CompiledCache, OneProcessFails) {
  std::ofstream(source_) << "#include <regex>\nstatic_assert(sizeof(int) == 1, \"no\");\n";
  const auto said = compileInProcesses(4);
  EXPECT_EQ(countOf(said, "irk: compiling"), 1);
  EXPECT_EQ(countOf(said, "mine.cpp:2: it does not compile"), 4);
  EXPECT_EQ(countOf(compileInProcesses(1), "irk: compiling"), 1);
}

TEST_F(CompiledCache, ALibraryThatIsCutShortIsTold) {
  compile();
  const std::string bytes = readInputFile(object_);
  const auto cut = folder() / "cut.so";
  for (const std::size_t left : {std::size_t{20}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    std::ofstream(cut, std::ios::binary) << bytes.substr(0, left);
    EXPECT_TRUE(containsAll(misuseOf([&] { answerOf(cut); }), {"cut.so", "cut short", std::to_string(left)}));
  }
}

}  // namespace
}  // namespace irk
