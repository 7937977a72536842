// The gate of experiments/examples against the pendulum that it is.
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <string>

#include "experiments/runs/run_table.h"
#include "tests/experiments/own/own_files.h"

namespace irk {
namespace {

class SwingingGate : public OwnFiles {};

// The gate has one degree of freedom, the angle phi about the hinge's axis, which leans by l. About that axis its
// moment of inertia is J = Jz + m (w/2)^2, and its weight has the potential -m g (w/2) sin(l) cos(phi): a pendulum with
// phi'' = -omega^2 sin(phi), omega^2 = m g (w/2) sin(l) / J. From rest at phi0 it has
// sin(phi / 2) = k cd(omega t, k), k = sin(phi0 / 2), in Jacobi's functions; cd' = -(1 - k^2) sn / dn^2.
TEST_F(SwingingGate, IsAPendulum) {
  const double m = 20, arm = 0.6, inertia = 2.4 + m * arm * arm, lean = 0.3490658504, k = std::sin(0.5);
  const double omega = std::sqrt(m * 9.81 * arm * std::sin(lean) / inertia), c = std::cos(lean), s = std::sin(lean);
  for (const std::string formulation : {"index2", "ggl", "index1"}) {
    const Ran ran = irk("solve " IRK_SOURCE_DIR
                        "/experiments/examples/swinging_gate.cpp --method radau_iia_5 --tol 1e-10 "
                        "--points 4 --out gate.csv --formulation " +
                        formulation);
    ASSERT_EQ(ran.status, 0) << ran.text;
    const Table gate = readTable(folder_.path() / "gate.csv");
    ASSERT_EQ(gate.rows.size(), 4u);
    for (const auto& row : gate.rows) {
      const double t = numberAt(gate, row, "t");
      double cn = 0, dn = 0;
      const double sn = boost::math::jacobi_elliptic(k, omega * t, &cn, &dn);
      const double half = std::asin(k * cn / dn), phi = 2 * half;
      const double rate = -2 * k * (1 - k * k) * omega * sn / (dn * dn) / std::cos(half);
      // 1000 tolerances: the constraints of index 1 drift.
      const auto expectAt = [&](const char* name, double expected) {
        EXPECT_NEAR(numberAt(gate, row, name), expected, 1e-7) << formulation << ": " << name << " at t = " << t;
      };
      // The centre of the gate: the arm, turned by phi about z and then by the lean about y.
      expectAt("x", arm * std::cos(phi) * c);
      expectAt("y", arm * std::sin(phi));
      expectAt("z", -arm * std::cos(phi) * s);
      expectAt("x'", -arm * std::sin(phi) * c * rate);
      expectAt("y'", arm * std::cos(phi) * rate);
      expectAt("z'", arm * std::sin(phi) * s * rate);
      expectAt("e0", std::cos(half) * std::cos(lean / 2));  // of the product of the two turns
    }
  }
}

}  // namespace
}  // namespace irk
