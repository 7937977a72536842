// Shell completion, the manual page and the examples of the help.
#include <gtest/gtest.h>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

std::string outputOf(const std::string& command) {
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

class Completion : public testing::Test {
 protected:
  // What bash offers for the last word.
  std::string offered(const std::vector<std::string>& words) const {
    const std::string script = folder_.path() / "irk.bash", call = folder_.path() / "call.bash";
    std::ofstream(script) << program({"completion", "bash"}).out;
    std::ofstream file(call);
    file << "source " << script << "\nCOMP_WORDS=(";
    for (const auto& word : words) file << " '" << word << "'";
    file << ")\nCOMP_CWORD=" << words.size() - 1 << "\n_irk\necho \" ${COMPREPLY[*]} \"\n";
    file.close();
    return outputOf("bash " + call);
  }
  TemporaryFolder folder_;
};

TEST_F(Completion, OffersVerbsOptionsAndValues) {
  EXPECT_TRUE(containsAll(offered({"irk", ""}), {" solve ", " run ", " tableau ", " completion ", " man "}));
  EXPECT_EQ(offered({"irk", "sol"}), " solve \n");
  EXPECT_TRUE(containsAll(offered({"irk", "solve", "sli"}), {" slider_crank "}));
  EXPECT_TRUE(containsAll(offered({"irk", "solve", "kepler", "--method", "rad"}), {" radau_iia_5 ", " radau_ia_2 "}));
  EXPECT_TRUE(containsAll(offered({"irk", "solve", "kepler", "--method", "c"}), {" cvode_bdf "}));
  EXPECT_TRUE(containsAll(offered({"irk", "solve", "kepler", "--newton", ""}), {" simplified ", " full "}));
  EXPECT_TRUE(containsAll(offered({"irk", "solve", "kepler", "--"}), {" --tol ", " --points ", " --newton "}));
  EXPECT_TRUE(containsAll(offered({"irk", "run", "or"}), {" order "}));
  EXPECT_EQ(offered({"irk", "run", "order", "--stale", ""}), " keep remake \n");
  EXPECT_TRUE(containsAll(offered({"irk", "tableau", ""}), {" show ", " check "}));
  EXPECT_TRUE(containsAll(offered({"irk", "tableau", "show", "gauss_3"}), {" gauss_3 "}));
  EXPECT_EQ(offered({"irk", "tableau", "show", "--d"}), " --digits \n");
}

TEST_F(Completion, ForOtherShells) {
  const Ended fish = program({"completion", "fish"});
  EXPECT_EQ(fish.status, 0) << fish.err;
  EXPECT_TRUE(containsAll(fish.out, {"-a solve", "-l newton", "slider_crank", "radau_iia_5"}));
  EXPECT_TRUE(containsAll(program({"completion", "zsh"}).out, {"bashcompinit", "complete "}));
  const Ended none = program({"completion", "fsh"});
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(containsAll(none.err, {"shell", "fsh", "bash, zsh, fish"})) << none.err;
}

TEST(Manual, HasEveryVerbOptionAndExample) {
  const Ended manual = program({"man"});
  ASSERT_EQ(manual.status, 0) << manual.err;
  EXPECT_TRUE(containsAll(manual.out, {".TH IRK 1", ".SH NAME", ".SS irk solve scene", ".SS irk tableau show method",
                                       "\\-\\-points", "\\-\\-newton", "irk solve slider_crank", ".SH EXIT STATUS"}));
  // Of roff: each line is text or a known request.
  std::istringstream lines(manual.out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('.') && !line.starts_with('\'')) continue;
    const std::string request = line.substr(0, line.find(' '));
    EXPECT_TRUE(request == ".TH" || request == ".SH" || request == ".SS" || request == ".TP" || request == ".PP" ||
                request == ".nf" || request == ".fi")
        << line;
  }
}

// The examples of `solve` that write no file.
TEST(Help, ExamplesRun) {
  std::istringstream lines(program({"solve", "--help"}).out);
  int run = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find("irk solve ");
    if (!line.starts_with("  irk solve ") || line.find("--plot") < line.size() || line.find("--out") < line.size()) {
      continue;
    }
    std::istringstream words(line.substr(begin + 4, line.find("     ", begin) - begin - 4));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    const Ended ended = program(arguments);
    EXPECT_EQ(ended.status, 0) << line << ended.err << ended.out;
    ++run;
  }
  EXPECT_EQ(run, 2);
}

}  // namespace
}  // namespace irk
