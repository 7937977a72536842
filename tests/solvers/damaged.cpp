// A solver in a shared library that does what IRK_DAMAGE says at its first step; for tests of messages.
#include <irk/peer_c.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" int irk_peer_version() { return IRK_PEER_VERSION; }

extern "C" const irk_peer_description* irk_peer_describe() {
  static const irk_peer_description description = {"Damaged", IRK_PEER_ODE, 1, 0, 0};
  return &description;
}

extern "C" int irk_peer_solve(const irk_peer_problem* p, double t, double t_end, double* y, double*, irk_peer_counts*) {
  const char* const given = std::getenv("IRK_DAMAGE");
  const std::string damage = given ? given : "";
  const double h = (t_end - t) / 100;
  const auto step = [&](double to) { return p->accepted(p->self, to, y, nullptr, nullptr); };
  if (step(t + h)) return IRK_PEER_SUCCESS;
  if (damage == "throws") throw std::runtime_error("no licence");
  if (damage == "throws a number") throw 7;
  if (damage == "exits") std::exit(0);
  if (damage == "aborts") std::abort();
  if (damage == "returns early") return IRK_PEER_SUCCESS;
  if (damage == "fails") return IRK_PEER_SINGULAR;
  if (damage == "unknown outcome") return 99;
  if (damage == "goes back") return step(t - h), IRK_PEER_SUCCESS;
  if (damage == "goes on") return step(t_end + h), IRK_PEER_SUCCESS;
  if (damage == "explains nothing") return p->explain(p->self, nullptr), IRK_PEER_NEWTON_FAILED;
  if (damage == "is not finite") return y[0] = NAN, step(t + 2 * h), IRK_PEER_SUCCESS;
  step(t_end);
  return IRK_PEER_SUCCESS;
}
