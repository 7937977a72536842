#include "experiments/runs/run_spec.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "experiments/runs/fields.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

RunSpec sample() {
  RunSpec spec;
  spec.scene = "slider_crank";
  spec.settings = {{"coordinates", "absolute"}, {"torque_off_at", "0.5"}};
  spec.method = "gauss_7";
  spec.formulation = Formulation::kIndex3;
  spec.scalar = {50};
  spec.options.newton.kind = NewtonKind::kModified;
  spec.options.step.h = 0.1 + 0.2;  // has no short decimal form
  spec.options.tolerances.rtol = 1e-9 / 3;
  spec.t_end = 2.0 / 3;
  spec.time_limit = 1.5;
  return spec;
}

TEST(RunSpec, TextReadsBackToTheSameBits) {
  const RunSpec spec = sample();
  const RunSpec back = parseSpec(canonicalText(spec));
  EXPECT_EQ(canonicalText(back), canonicalText(spec));
  EXPECT_EQ(back.options.step.h, spec.options.step.h);
  EXPECT_EQ(back.options.tolerances.rtol, spec.options.tolerances.rtol);
  EXPECT_EQ(back.settings, spec.settings);
  EXPECT_EQ(back.scalar, spec.scalar);
}

TEST(RunSpec, DefaultsReadBackToo) {
  RunSpec spec;
  spec.scene = "kepler";
  EXPECT_EQ(canonicalText(parseSpec(canonicalText(spec))), canonicalText(spec));
}

TEST(RunSpec, EqualRunsHaveEqualKeys) {
  RunSpec spec;
  spec.scene = "slider_crank";
  RunSpec spelled_out = spec;
  spelled_out.settings["coordinates"] = "redundant";
  spelled_out.t_end = makeScene<double>("slider_crank").t_end;
  EXPECT_EQ(specKey(spec), specKey(spelled_out));
}

TEST(RunSpec, KeyHoldsTheContentsOfAMethodFile) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "method.txt";
  RunSpec spec = sample();
  spec.method = path;
  std::ofstream(path) << "one";
  const std::string key = specKey(spec);
  std::ofstream(path) << "two";
  EXPECT_NE(specKey(spec), key);
}

TEST(RunSpec, ErrorsNameFieldValueAndWhatIsAllowed) {
  RunSpec spec = sample();
  const auto set = [&spec](const char* field, const char* value) {
    return misuseOf([&] { findField(field).set(spec, value); });
  };
  EXPECT_TRUE(containsAll(set("h", "-1"), {"h", "-1", ">= 0"}));
  EXPECT_TRUE(containsAll(set("rtol", "-2"), {"rtol", "-2", ">= 0"}));
  EXPECT_TRUE(containsAll(set("atol", "1e-6x"), {"atol", "1e-6x", "number"}));
  EXPECT_TRUE(containsAll(set("atol", "nan"), {"atol", "nan", "> 0"}));
  EXPECT_TRUE(containsAll(set("max_steps", "0"), {"max_steps", "0", "1"}));
  EXPECT_TRUE(containsAll(set("newton", "simplifed"), {"newton", "simplifed", "'simplified'"}));
  EXPECT_TRUE(containsAll(set("scalar", "mp5"), {"scalar", "mp5", "mp30 to mp1000"}));
  EXPECT_TRUE(containsAll(set("scene", "slider_krank"), {"slider_krank", "'slider_crank'"}));
  EXPECT_TRUE(containsAll(set("settings", "k"), {"setting", "'k'", "name=value"}));
  EXPECT_TRUE(containsAll(misuseOf([] { findField("solvr"); }), {"solvr", "'solver'"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parseSpec("scene"); }), {"'scene'", "field=value"}));
}

}  // namespace
}  // namespace irk
