#include <gtest/gtest.h>
#include <cmath>
#include <csignal>
#include <iterator>
#include <set>

#include "experiments/commands/commands.h"
#include "experiments/runs/configurations.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/study/draw.h"
#include "experiments/study/drawn/dice.h"
#include "experiments/study/run_command.h"
#include "irk/tableaus.h"
#include "tests/experiments/audit/audited.h"
#include "tests/experiments/study_runs.h"

namespace irk::audit {
namespace {

// The random bits and choices are part of the study: other ones would be another audit.
TEST(AuditDice, AreTheSameOnEveryMachine) {
  Dice dice("1 run 0");
  EXPECT_EQ(dice.uniform(), 0x1.675a664420499p-1);  // by another implementation of MT19937-64
  EXPECT_EQ(dice.below(1000), 28);
  const double weights[] = {0, 1, 0, 3, 0};
  int counts[5] = {};
  for (int i = 0; i < 4000; ++i) ++counts[dice.weighted(weights)];
  EXPECT_EQ(counts[0] + counts[2] + counts[4], 0);
  EXPECT_NEAR(counts[1], 1000, 100);  // 3.7 standard deviations
  std::set<Index> seen;
  for (int i = 0; i < 200; ++i) seen.insert(dice.between(3, 7));
  EXPECT_EQ(seen, (std::set<Index>{3, 4, 5, 6, 7}));
}

std::vector<DrawnRun> drawnRuns(const AuditOptions& options) {
  const Draw draw(options);
  std::vector<DrawnRun> runs;
  for (std::size_t i = 0; i < draw.size(); ++i) runs.push_back(draw[i]);
  return runs;
}

std::vector<std::string> texts(const std::vector<DrawnRun>& runs) {
  std::vector<std::string> all;
  for (const auto& run : runs) all.push_back(run.treatment + " " + canonicalText(run.spec));
  return all;
}

TEST(AuditDraw, DependsOnTheSeedAlone) {
  const auto first = texts(drawnRuns({.runs = 60}));
  EXPECT_EQ(first, texts(drawnRuns({.runs = 60})));
  auto longer = texts(drawnRuns({.runs = 80}));
  longer.resize(60);
  EXPECT_EQ(first, longer) << "a shorter audit is the beginning of a longer one";
  const Draw draw({.runs = 60});
  for (const std::size_t i : {47u, 5u, 47u}) {
    EXPECT_EQ(texts({draw[i]}).front(), first[i]) << "in any order";
  }
  const auto other = texts(drawnRuns({.runs = 60, .seed = 2}));
  int same = 0;
  for (std::size_t i = 0; i < other.size(); ++i) same += first[i] == other[i];
  EXPECT_LT(same, 3);
}

TEST(AuditDraw, ReachesEveryScenesAxisAndTolerance) {
  std::set<std::string> scenes, configurations, treatments, formulations, families, methods;
  std::set<double> tolerances;
  int with_settings = 0;
  const auto runs = drawnRuns({.runs = 2500});
  for (const auto& [spec, treatment] : runs) {
    scenes.insert(spec.scene);
    configurations.insert(spec.configuration);
    treatments.insert(treatment);
    formulations.insert(std::string(idOf(spec.formulation)));
    methods.insert(spec.method);
    tolerances.insert(spec.options.tolerances.rtol);
    with_settings += !spec.settings.empty();
    for (const auto& [name, value] : spec.settings) {
      const bool unknowns = name == "m" && spec.scene == "beam_chain";
      EXPECT_TRUE(!unknowns || std::stoi(value) <= 100) << value;
      EXPECT_TRUE(name != "elements" || std::stoi(value) <= 4) << value;
      EXPECT_TRUE(!name.starts_with("smoothing") || treatment == "smooth" || treatment == kNoSwitches);
    }
    // Options that are not drawn have their defaults, whatever these are.
    if (treatment == kDefaultTreatment || treatment == kNoSwitches) {
      RunSpec configured;
      findField("configuration").set(configured, spec.configuration);
      EXPECT_EQ(spec.discontinuity, configured.discontinuity);
    } else {
      EXPECT_EQ(idOf(spec.discontinuity), treatment);
    }
  }
  // Scenes that other tests of this process have registered are not drawn.
  std::set<std::string> own;
  for (const auto& scene : sceneCatalogue()) {
    if (!scene.registered) own.insert(scene.id);
  }
  EXPECT_EQ(scenes, own);
  EXPECT_EQ(configurations.size(), irk::configurations().size());
  EXPECT_EQ(treatments, (std::set<std::string>{"default", "ignore", "iterate", "locate", "no switches", "smooth"}));
  EXPECT_EQ(formulations.size(), named<Formulation>().size());
  EXPECT_EQ(tolerances.size(), 12u);
  for (const auto* id : {"gauss_20", "radau_iia_1", "lobatto_iiid_4", "radau_ia"}) {
    EXPECT_TRUE(methods.contains(id)) << id;
  }
  EXPECT_GT(with_settings, 700);  // half of the runs, for scenes with parameters
}

// How many values of an option are drawn.
const std::map<std::string_view, std::size_t> kDrawnValues{{"norm", 2},   {"estimate", 4},  {"control", 3},
                                                           {"newton", 4}, {"predictor", 3}, {"multipliers", 2}};

TEST(AuditDraw, ReachesOptionsEndsAndOtherLibraries) {
  std::set<std::string> methods;
  std::map<std::string_view, std::set<std::string>> options;
  int two_tolerances = 0, other_ends = 0, on_the_way = 0, by_peers = 0;
  for (const auto& [spec, treatment] : drawnRuns({.runs = 2500})) {
    methods.insert(spec.method);
    const auto& [rtol, atol] = std::pair(spec.options.tolerances.rtol, spec.options.tolerances.atol);
    EXPECT_LE(std::max(rtol, atol) / std::min(rtol, atol), 1000 * (1 + 1e-15));
    two_tolerances += rtol != atol;
    for (const auto& [name, values] : kDrawnValues) options[name].insert(findField(name).get(spec));
    const double own_end = makeScene<double>(spec.scene, spec.settings).t_end;
    EXPECT_GE(spec.t_end, 0.199 * own_end);
    EXPECT_LE(spec.t_end, 2.01 * own_end);
    other_ends += spec.t_end != own_end;
    on_the_way += spec.reference_times > 1;
    EXPECT_TRUE(spec.reference_times == 1 || makeScene<double>(spec.scene, spec.settings).exact) << spec.scene;
    const bool by_peer = findPeer(spec.method) != nullptr;
    by_peers += by_peer;
    EXPECT_EQ(spec.error_bar == ErrorBarUse::kNone, by_peer);
  }
  for (const auto& [name, values] : kDrawnValues) EXPECT_EQ(options[name].size(), values) << name;
  EXPECT_GT(two_tolerances, 500);  // 0.3 of the runs, but for those at the ends of the range
  EXPECT_GT(other_ends, 500);      // a quarter; more of the foreign scenes
  EXPECT_GT(on_the_way, 200);
  EXPECT_GT(by_peers, 150);  // fewer than 0.15: they do not take all scenes
  for (const auto& peer : peerCatalogue()) EXPECT_TRUE(!peer.source.empty() || methods.contains(peer.id)) << peer.id;
}

// medakzo has 400 unknowns; twenty stages of it in one dense matrix take 21 s for one factorization.
TEST(AuditDraw, LeavesOutCoupledMatricesThatOutlastEveryTimeLimit) {
  int coupled = 0, many_stages = 0;
  for (const auto& run : drawnRuns({.runs = 300, .scenes = {"medakzo"}})) {
    if (run.spec.method.find_first_of("0123456789") == std::string::npos) continue;  // a whole family
    if (findPeer(run.spec.method)) continue;
    const auto tableau = makeTableau<double>(run.spec.method);
    const Index unknowns = makeScene<double>("medakzo", run.spec.settings).sizes().n();
    if (run.spec.configuration == "paper") {
      ++coupled;
      EXPECT_LE(tableau.stages() * unknowns, 3000) << canonicalText(run.spec);
    } else {
      many_stages += tableau.stages() * unknowns > 3000;
    }
  }
  EXPECT_GT(coupled, 15);      // of about 45
  EXPECT_GT(many_stages, 15);  // other configurations keep them
}

// The parameters of foreign scenes come from their whole ranges.
TEST(AuditDraw, ReachesTheEndsOfTheRangesOfForeignScenes) {
  double least = 1e300, most = 0;
  for (const auto& run : drawnRuns({.runs = 200, .scenes = {"two_point_control"}})) {
    const auto width = run.spec.settings.find("width");
    if (width == run.spec.settings.end()) continue;
    least = std::min(least, std::stod(width->second));
    most = std::max(most, std::stod(width->second));
  }
  EXPECT_GE(least, 1e-8);
  EXPECT_LT(least, 1e-7);
  EXPECT_GT(most, 0.1);
  EXPECT_LE(most, 1);
}

TEST(AuditDraw, CommandsRepeatTheRuns) {
  auto runs = drawnRuns({.runs = 300});
  runs[0].spec.t_end *= 0.3;
  for (const auto& run : runs) {
    RunRecord record;
    record.spec = run.spec;
    const Table made{{}, runColumns(), {runRow("key", "audit", record)}};
    const std::string command = seriesCommand(made, made.rows[0]).text + sweptOptions(made, made.rows[0]);
    EXPECT_EQ(specKey(solveSpec(parsed(command))), specKey(run.spec)) << command;
  }
}

}  // namespace
}  // namespace irk::audit
