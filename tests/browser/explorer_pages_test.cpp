// The explorer in a browser, with made-up runs whose marks can be counted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/report/explorer/explorer.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "tests/browser/browser.h"

namespace irk {
namespace {

using Json = nlohmann::json;

struct Solver {
  const char *method, *family, *integrator;
  double cost;  // at the loosest tolerance
};
constexpr Solver kSolvers[] = {{"radau_iia_3", "radau_iia", "default:radau_iia_3", 2e-3},
                               {"radau_iia_5", "radau_iia", "default:radau_iia_5", 1e-3},
                               {"gauss_3", "gauss", "default:gauss_3", 3e-3},
                               {"cvode_bdf", "cvode_bdf", "cvode_bdf", 5e-3}};
constexpr const char* kScenes[] = {"van_der_pol", "robertson"};
constexpr int kTolerances = 4;

// Each solver on each scene with 4 tolerances; the error is a tenth of the tolerance, the cost grows by 2. On
// robertson, gauss_3 fails at the last tolerance and is wrong at the first, and cvode_bdf counts no Jacobians.
Table madeUpRuns() {
  Table runs{{{"study", "work_precision"}}, runColumns(), {}};
  const RunSpec usual;
  for (const auto* scene : kScenes) {
    for (const auto& solver : kSolvers) {
      for (int k = 0; k < kTolerances; ++k) {
        const double tol = std::pow(10, -3 - 2 * k);
        const bool robertson = std::string(scene) == "robertson", gauss = std::string(solver.family) == "gauss";
        const bool fails = robertson && gauss && k + 1 == kTolerances, wrong = robertson && gauss && k == 0;
        const double error = wrong ? 5 : tol / 10;
        TableRow row(runs.columns.size(), "nan");
        for (const auto& field : specFields()) row[runs.column(field.name)] = field.get(usual);
        const auto put = [&](const char* column, const std::string& text) { row[runs.column(column)] = text; };
        put("scene", scene);
        put("settings", "");
        put("files", "");
        put("method", solver.method);
        put("family", solver.family);
        put("integrator", solver.integrator);
        put("stages", solver.method == std::string("radau_iia_5") ? "5" : "3");
        for (const auto* column : {"rtol", "atol"}) put(column, fmt::format("{}", tol));
        put("outcome", fails ? "newton_failed" : "success");
        for (const auto* column : {"error", "error_u"}) put(column, fails ? "nan" : fmt::format("{}", error));
        put("cpu_s", fmt::format("{}", solver.cost * std::pow(2, k)));
        const bool counts = !robertson || solver.family != std::string("cvode_bdf");
        put("jacobians", counts ? std::to_string(10 + k) : "0");
        put("steps_accepted", std::to_string(100 << k));
        put("detail", "");
        runs.rows.push_back(row);
      }
    }
  }
  return runs;
}
constexpr int kRuns = 2 * 4 * kTolerances;

class ExplorerInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    IRK_NEEDS_CHROMIUM();
    if (!std::filesystem::exists(d3File())) GTEST_SKIP() << "no " << d3File() << ": apt-get install node-d3";
    write(madeUpRuns());
  }
  void write(const Table& runs) {
    const auto results = folder_.path() / "results";
    std::filesystem::create_directories(results / "work_precision");
    writeTable(results / "work_precision" / "runs.csv", runs);
    std::ostringstream err;
    const auto path = writeExplorer({results, IRK_SOURCE_DIR}, err);
    ASSERT_TRUE(path) << err.str();
    page_ = *path;
  }
  Json driven(const std::string& hash, const std::string& body) const { return drive(page_, hash, body); }

  TemporaryFolder folder_;
  std::filesystem::path page_;
};

TEST_F(ExplorerInBrowser, RedrawsWhenAChoiceChanges) {
  const Json seen = driven("view=all", R"(
    const seen = {};
    seen.all = marksOf(page);
    tick(page, "failed"); seen.no_failures = marksOf(page);
    tick(page, "wrong"); seen.no_wrong = marksOf(page);
    tick(page, "failed"); tick(page, "wrong");
    choose(page, "y", "jacobians"); seen.jacobians = marksOf(page);
    choose(page, "y", "steps"); seen.steps = marksOf(page);
    page.querySelector("#scenes input[value=robertson]").click(); seen.one_scene = marksOf(page);
    page.querySelector("#solvers input[value=gauss_3]").click(); seen.no_gauss = marksOf(page);
    page.querySelector("[data-none=solvers]").click(); seen.none = marksOf(page);
    seen.empty = page.querySelector("#panels svg").textContent;
    return seen;)");
  EXPECT_EQ(seen["all"]["all"], kRuns);
  EXPECT_EQ(seen["all"]["wrong"], 1);
  EXPECT_EQ(seen["all"]["failed"], 1);
  EXPECT_EQ(seen["all"]["panels"], 2);
  EXPECT_EQ(seen["no_failures"]["all"], kRuns - 1);
  EXPECT_EQ(seen["no_failures"]["failed"], 0);
  EXPECT_EQ(seen["no_wrong"]["all"], kRuns - 2);
  EXPECT_EQ(seen["jacobians"]["all"], kRuns - kTolerances) << "a logarithm has no place for no Jacobians";
  EXPECT_EQ(seen["steps"]["all"], kRuns);
  EXPECT_EQ(seen["one_scene"]["all"], kRuns / 2);
  EXPECT_EQ(seen["one_scene"]["panels"], 1);
  EXPECT_EQ(seen["no_gauss"]["solvers"], Json({"cvode_bdf", "radau_iia_3", "radau_iia_5"}));
  EXPECT_EQ(seen["none"]["all"], 0);
  EXPECT_TRUE(containsAll(seen["empty"], {"no solver"}));
}

TEST_F(ExplorerInBrowser, HasViewsByOneClick) {
  const Json seen = driven("", R"(
    const seen = { first: marksOf(page) };
    const click = view => page.querySelector(`[data-view=${view}]`).click();
    const colours = () => new Set([...page.querySelectorAll(".curve[data-solver]")].map(path => path.getAttribute("stroke"))).size;
    click("family"); choose(page, "family", "radau_iia"); seen.family = marksOf(page);
    click("peers"); seen.peers = marksOf(page); seen.colours = colours();
    seen.envelopes = page.querySelectorAll("#panels .envelope").length;
    tick(page, "front"); seen.fronts = [...page.querySelectorAll("#panels .front")].map(path => path.getAttribute("d").split("L").length);
    seen.table = [...page.querySelectorAll("#cheapest tbody tr")].map(row => row.cells[2].textContent);
    return seen;)");
  const Json best{"cvode_bdf", "gauss_3", "radau_iia_5"};
  EXPECT_EQ(seen["first"]["solvers"], best) << "the cheaper Radau IIA method";
  EXPECT_EQ(seen["family"]["solvers"], Json({"radau_iia_3", "radau_iia_5"}));
  EXPECT_EQ(seen["family"]["all"], 2 * 2 * kTolerances);
  EXPECT_EQ(seen["peers"]["all"], kRuns);
  EXPECT_EQ(seen["colours"], 2);
  EXPECT_EQ(seen["envelopes"], 2 * 2) << "ours and peers, in two panels";
  // The runs of radau_iia_5 and the end: 5 points of stairs are 1 + 2 * 4 pieces.
  EXPECT_EQ(seen["fronts"], Json({9, 9}));
  // At the error 1e-4: 1e-3 s against 2e-3 s.
  EXPECT_EQ(seen["table"], Json({"radau_iia_5 (2.0)", "radau_iia_5 (2.0)"}));
}

// On robertson the other Radau IIA method is the cheaper one: both are there, in one hue with two marks.
TEST_F(ExplorerInBrowser, TellsTheBestOfOneFamilyApart) {
  Table runs = madeUpRuns();
  for (auto& row : runs.rows) {
    const bool best = textAt(runs, row, "scene") == "robertson" && textAt(runs, row, "method") == "radau_iia_3";
    if (best) row[runs.column("cpu_s")] = "1e-5";
  }
  write(runs);
  const Json seen = driven("view=best", R"(
    const looks = new Map();
    for (const mark of page.querySelectorAll("#panels .mark.right")) {
      const path = mark.querySelector("path");
      looks.set(mark.dataset.solver, path.getAttribute("d") + path.getAttribute("fill"));
    }
    return { solvers: marksOf(page).solvers, looks: Object.fromEntries(looks) };)");
  EXPECT_EQ(seen["solvers"], Json({"cvode_bdf", "gauss_3", "radau_iia_3", "radau_iia_5"}));
  EXPECT_NE(seen["looks"]["radau_iia_3"], seen["looks"]["radau_iia_5"]);
}

// The largest error at the reference times is the first choice, the error at the end the other one.
TEST_F(ExplorerInBrowser, OffersBothErrors) {
  Table runs = madeUpRuns();
  for (auto& row : runs.rows) {
    if (textAt(runs, row, "scene") != "van_der_pol") continue;  // robertson: no references at earlier times
    row[runs.column("error_over_time")] = fmt::format("{}", 8 * numberAt(runs, row, "error"));
  }
  write(runs);
  const Json seen = driven("view=all", R"(
    const seen = { x: page.getElementById("x").value, all: marksOf(page).all };
    const label = () => page.querySelector("#panels .mark.right").getAttribute("aria-label");
    seen.over_time = label();
    choose(page, "x", "error"); seen.at_end = label(); seen.all_at_end = marksOf(page).all;
    return seen;)");
  EXPECT_EQ(seen["x"], "error_over_time");
  EXPECT_EQ(seen["all"], kRuns);
  EXPECT_EQ(seen["all_at_end"], kRuns);
  EXPECT_TRUE(containsAll(seen["over_time"], {"largest at the reference times"}));
  EXPECT_FALSE(containsAll(seen["at_end"], {"largest at the reference times"}));
}

TEST_F(ExplorerInBrowser, KeepsTheChoiceInTheLink) {
  const std::string link = driven("", R"(
    page.querySelector("[data-view=all]").click();
    choose(page, "x", "tolerance"); choose(page, "y", "steps");
    page.querySelector("#scenes input[value=van_der_pol]").click();
    page.querySelector("#solvers input[value=radau_iia_3]").click();
    tick(page, "failed");
    return view.location.hash.slice(1);)");
  const Json seen = driven(link, R"(
    return { marks: marksOf(page), x: page.getElementById("x").value, y: page.getElementById("y").value };)");
  EXPECT_EQ(seen["x"], "tolerance");
  EXPECT_EQ(seen["y"], "steps");
  EXPECT_EQ(seen["marks"]["all"], 3 * kTolerances - 1) << link;
  EXPECT_EQ(seen["marks"]["solvers"], Json({"cvode_bdf", "gauss_3", "radau_iia_5"}));
  EXPECT_EQ(seen["marks"]["failed"], 0);
  // Names that results no longer have are left out.
  const Json other = driven("view=none&x=none&scenes=gone&study=gone", "return marksOf(page);");
  EXPECT_EQ(other["panels"], 0);
}

// Nothing but tables scrolls sideways: the page does not, and nothing hangs out of its form.
TEST_F(ExplorerInBrowser, FitsAPhone) {
  const Json seen = drive(page_, "view=peers", R"(
    for (const box of page.querySelectorAll("details")) box.open = true;
    const inside = [...page.querySelectorAll("form *, svg")].map(node => node.getBoundingClientRect().right);
    return { page: page.documentElement.scrollWidth, inside: Math.max(...inside) };)",
                          400);
  EXPECT_LE(seen["page"], 400);
  EXPECT_LE(seen["inside"], 400);
}

TEST_F(ExplorerInBrowser, NamesARunAndItsCommand) {
  const Json seen = driven("view=all", R"(
    const tip = page.getElementById("tip"), svg = page.querySelector("#panels svg");
    const seen = { hidden: tip.hidden };
    const mark = [...page.querySelectorAll("#panels .mark.wrong")][0];
    mark.dispatchEvent(new MouseEvent("mouseenter"));
    seen.tip = tip.hidden ? "" : tip.textContent;
    mark.dispatchEvent(new MouseEvent("mouseleave"));
    seen.gone = tip.hidden;
    svg.focus();
    press(page, svg, "ArrowRight");
    press(page, page.activeElement, "ArrowRight");
    press(page, page.activeElement, "ArrowDown");
    seen.solver = page.activeElement.dataset.solver;
    press(page, page.activeElement, "Enter");
    seen.command = page.querySelector("#chosen code").textContent;
    return seen;)");
  EXPECT_EQ(seen["hidden"], true);
  EXPECT_TRUE(containsAll(seen["tip"], {"gauss_3 on robertson", "above 1000 tolerances", "tolerance 0.001",
                                        "error at the end 5", "irk solve robertson --method gauss_3", "--tol 0.001"}));
  EXPECT_EQ(seen["gone"], true);
  EXPECT_EQ(seen["solver"], "radau_iia_5") << "down: the next solver";
  EXPECT_TRUE(containsAll(seen["command"], {"irk solve van_der_pol --method radau_iia_5", "--tol 0.001"}));
}

// Envelopes belong to ours against peers, unless they were asked for.
TEST_F(ExplorerInBrowser, TakesTheEnvelopesOfAViewAwayAgain) {
  const Json seen = driven("view=all", R"(
    const click = view => page.querySelector(`[data-view=${view}]`).click();
    const envelopes = () => page.querySelectorAll("#panels .envelope").length;
    const seen = {};
    click("peers"); seen.peers = envelopes();
    click("all"); seen.left = envelopes();
    tick(page, "envelope"); seen.wanted = envelopes();
    click("peers"); click("all"); seen.kept = envelopes();
    return seen;)");
  EXPECT_EQ(seen["peers"], 4);
  EXPECT_EQ(seen["left"], 0);
  EXPECT_EQ(seen["wanted"], 2) << "one in each panel";
  EXPECT_EQ(seen["kept"], 2);
  const Json linked = driven("view=peers&envelope=1", R"(
    page.querySelector("[data-view=all]").click();
    return page.querySelectorAll("#panels .envelope").length;)");
  EXPECT_EQ(linked, 0);
}

TEST_F(ExplorerInBrowser, SaysWithWhatItCompares) {
  const Json seen = driven("view=best", R"(
    const text = () => page.querySelector("#cheapest p").textContent, best = text();
    page.querySelector("[data-view=all]").click();
    return { best, all: text() };)");
  EXPECT_TRUE(containsAll(seen["best"], {"the best of the next family needs"}));
  EXPECT_TRUE(containsAll(seen["all"], {"the next solver needs"}));
}

// A long title takes two lines on a phone and stays on the screen.
TEST_F(ExplorerInBrowser, CutsNoTitleOnAPhone) {
  Table runs = madeUpRuns();
  for (auto& row : runs.rows) row[runs.column("error_over_time")] = row[runs.column("error")];
  write(runs);
  const Json seen = drive(page_, "view=all", R"(
    const svg = [...page.querySelectorAll("#panels svg")].pop(), box = svg.getBoundingClientRect();
    const lines = [...svg.querySelectorAll(".title_below")];
    const boxes = lines.map(line => line.getBoundingClientRect());
    return { text: lines.map(line => line.textContent).join(" "), left: Math.min(...boxes.map(b => b.left - box.left)),
             right: Math.max(...boxes.map(b => b.right - box.right)), low: Math.max(...boxes.map(b => b.bottom - box.bottom)) };)",
                          320);
  EXPECT_TRUE(containsAll(seen["text"], {"error, largest at the reference times", "failed runs: tolerance"}));
  EXPECT_GE(seen["left"], -0.5);
  EXPECT_LE(seen["right"], 0.5);
  EXPECT_LE(seen["low"], 12) << "the next panel is not hidden";
}

TEST_F(ExplorerInBrowser, CapsItsLegend) {
  Table runs = madeUpRuns();
  const auto rows = runs.rows;
  for (int k = 1; k <= 30; ++k) {
    for (auto row : rows) {
      if (row[runs.column("method")] != "radau_iia_3") continue;
      row[runs.column("newton")] = "modified";
      row[runs.column("contractivity_limit")] = fmt::format("{}", 0.01 * k);
      runs.rows.push_back(row);
    }
  }
  write(runs);
  const std::string legend = driven("view=all", "return page.getElementById('legend').innerText;");
  EXPECT_TRUE(containsAll(legend, {"radau_iia_3", "and 10 more"}));
  const Json entries = driven("view=all", "return page.querySelectorAll('#legend li').length;");
  EXPECT_EQ(entries, 24 + 1 + 2) << "solvers, the rest, failed and wrong";
}

}  // namespace
}  // namespace irk
