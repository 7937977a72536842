// A simplification of the Jacobian: without dr/du. Newton's method then needs steps that are small against the periods
// of the stiffness, and more iterations.
#include <irk/strategies.h>

IRK_REGISTER {
  irk::registerStrategy<irk::JacobianTerms>(
      {.id = {"no_stiffness"},
       .meaning = "without dr/du",
       .change = {[](const irk::Sizes&, irk::Linearization<double>& D) { D.d2.setZero(); }, {}}});
}
