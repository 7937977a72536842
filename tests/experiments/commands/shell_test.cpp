// Shell completion, the manual page and the examples of the help.
#include <gtest/gtest.h>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/program.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// Of a command of the shell, which finds `irk` in its PATH.
std::string outputOf(const std::string& command) {
  const std::string folder = std::filesystem::path(IRK_PROGRAM).parent_path();
  std::string text;
  FILE* const pipe = popen(("export PATH=" + folder + ":$PATH; " + command).c_str(), "r");
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
  EXPECT_TRUE(containsAll(offered({"irk", ""}), {" solve ", " run ", " tableau ", " completion "}));
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
  EXPECT_EQ(offered({IRK_PROGRAM, "tableau", "show", "--d"}), " --digits \n") << "a program that is not in PATH";
}

// What a script asks: a word a line, its description behind a tab; status 0 where a file may stand as well.
TEST_F(Completion, AsksTheProgram) {
  const Ended verbs = program({"complete"}), same = program({"complete", ""});
  EXPECT_TRUE(containsAll(verbs.out, {"solve\tone integration\n", "query\t"})) << verbs.out;
  EXPECT_EQ(verbs.out, same.out);
  EXPECT_EQ(verbs.status, 1);
  EXPECT_EQ(program({"complete", "new", ""}).out, "scene\t\nstudy\t\n");
  const Ended method = program({"complete", "solve", "kepler", "--method", ""});
  EXPECT_TRUE(containsAll(method.out, {"\nradau_iia_5\t\n", "\ncvode_bdf\t\n"})) << method.out;
  EXPECT_EQ(method.status, 0) << "a tableau file";
  const Ended options = program({"complete", "tableau", "show", "-"});
  EXPECT_TRUE(containsAll(options.out, {"--digits\t"})) << options.out;
  const Ended number = program({"complete", "solve", "kepler", "--tol", ""});
  EXPECT_EQ(number.out, "");
  EXPECT_EQ(number.status, 1);
}

bool isInstalled(const std::string& shell) { return std::system(("command -v " + shell + " >/dev/null").c_str()) == 0; }

// What fish offers, one word a line; the descriptions behind a tab are cut off.
TEST_F(Completion, InFish) {
  if (!isInstalled("fish")) GTEST_SKIP() << "fish is not installed";
  const std::string script = folder_.path() / "irk.fish";
  std::ofstream(script) << program({"completion", "fish"}).out;
  std::ofstream(folder_.path() / "my.txt") << "";
  const auto words = [&](const std::string& line) {
    return '\n' + outputOf("cd " + folder_.path().string() +
                           " && HOME=$PWD XDG_CONFIG_HOME=$PWD fish --no-config -c \"source " + script +
                           "; complete -C '" + line + "' | string replace -r '\\t.*' ''; true\"");
  };
  EXPECT_TRUE(containsAll(words("irk "), {"\nsolve\n", "\nrun\n", "\ntableau\n"}));
  EXPECT_EQ(words("irk sol"), "\nsolve\n");
  EXPECT_TRUE(containsAll(words("irk solve sli"), {"\nslider_crank\n"}));
  EXPECT_TRUE(containsAll(words("irk solve kepler --newton "), {"\nsimplified\n", "\nfull\n"}));
  EXPECT_EQ(words("irk solve kepler --newton si"), "\nsimplified\n");
  EXPECT_TRUE(containsAll(words("irk solve kepler --method "), {"\nradau_iia_5\n", "\ncvode_bdf\n", "\nmy.txt\n"}));
  EXPECT_EQ(words("irk solve kepler --tol "), "\n") << "a number";
  EXPECT_TRUE(containsAll(words("irk solve kepler --po"), {"\n--points\n"}));
  EXPECT_TRUE(containsAll(words("irk run or"), {"\norder\n"}));
  EXPECT_EQ(words("irk run order --stale "), "\nkeep\nremake\n");
  EXPECT_TRUE(containsAll(words("irk tableau "), {"\nshow\n", "\ncheck\n"}));
  EXPECT_EQ(words("irk tableau show gauss_3 --d"), "\n--digits\n");
  EXPECT_EQ(words("irk completion "), "\nbash\nfish\nzsh\n") << "no files";
  EXPECT_TRUE(containsAll(words("irk new "), {"\nscene\n"}));
}

// Types each line into an interactive zsh and asks for the list of completions; ends when the list has `wanted`.
constexpr const char* kAskZsh = R"(zmodload zsh/zpty || exit 3
zpty -b z zsh -f -i
zpty -w z 'autoload -Uz compinit; compinit -u -D; source ./irk.zsh; LISTMAX=0; PS1=; echo "READ""Y"'
zpty -r z seen '*READY*' || exit 3
zpty -w -n z "$1"$'\C-d'
all= tries=0
while (( tries++ < 200 )) && [[ $all != *"$2"* ]]; do
  sleep 0.05
  while zpty -r -t z seen; do all+=$seen; done
done
zpty -d z
[[ $all == *"$2"* ]] && print found || print -r -- "no '$2' in: $all"
)";

TEST_F(Completion, InZsh) {
  if (!isInstalled("zsh")) GTEST_SKIP() << "zsh is not installed";
  std::ofstream(folder_.path() / "irk.zsh") << program({"completion", "zsh"}).out;
  std::ofstream(folder_.path() / "ask.zsh") << kAskZsh;
  const std::string begin = "cd " + folder_.path().string() + " && HOME=$PWD zsh -f ";
  EXPECT_EQ(outputOf(begin + "-n irk.zsh 2>&1"), "");
  const auto ask = [&](const std::string& line, const std::string& wanted) {
    return outputOf(begin + "ask.zsh '" + line + "' '" + wanted + "' 2>&1");
  };
  EXPECT_EQ(ask("irk ", "tableau"), "found\n");
  EXPECT_EQ(ask("irk solve slid", "slider_crank_flexible"), "found\n");
  EXPECT_EQ(ask("irk solve kepler --newton ", "modified_only"), "found\n");
  EXPECT_EQ(ask("irk solve kepler --method radau_iia_", "radau_iia_7"), "found\n");
  EXPECT_EQ(ask("irk tableau ", "export"), "found\n");
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
