#include "experiments/runs/configurations.h"

#include "core/base/text.h"

namespace irk {
namespace {

#define IRK_EMBEDDED "estimate=embedded;solver=eigen;jacobian_point=predicted;newton=broyden"
constexpr Configuration kConfigurations[] = {
    {"default",
     "Richardson's estimate, predictive control, simplified Newton, Schur basis, switches located, "
     "multipliers consistent at the end",
     ""},
    {"paper", "Gerstmayr & Stangl: modified Newton, difference quotients, one LU, step doubling",
     "newton=modified;derivatives=difference_forward;solver=coupled_dense;predictor=previous;"
     "estimate=doubling;control=paper;norm=absolute;summation=plain;discontinuity=ignore;"
     "multipliers=stages"},
    {"embedded", "embedded estimate, eigenvectors of A, predicted Jacobians, Broyden's updates", IRK_EMBEDDED},
    {"variable", "the same with variable order; a method with its number of stages is the first one",
     IRK_EMBEDDED ";order=variable;method=radau_iia"}};
#undef IRK_EMBEDDED

}  // namespace

std::span<const Configuration> configurations() { return kConfigurations; }

const Configuration& findConfiguration(std::string_view id) {
  return entryNamed("configuration", id, kConfigurations, &Configuration::id);
}

}  // namespace irk
