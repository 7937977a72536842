// The error estimates that come with the library.
#include "core/estimates/step_attempt.h"
#include "core/options/entries.h"

namespace irk {

IRK_STRATEGIES(ErrorEstimate, "estimate")

IRK_CATALOGUE(ErrorEstimate, richardsonEstimate(), doublingEstimate(), scalarDoublingEstimate(), embeddedEstimate(),
              tableauEstimate(), noEstimate())

}  // namespace irk
