#include "core/estimates/carried_error.h"

#include <sstream>

#include "core/estimates/accumulation.h"

namespace irk {

std::string CarriedError::doubt(const Tolerances& tolerances) const {
  // Five times what the sum of estimates may be, a success's own bound: the amplification by the motion is in it.
  if (!(size > 5 * largestError(tolerances))) return {};
  std::ostringstream text;
  text.precision(2);
  text << "the errors of all steps are about " << size << " tolerances at the end; the motion has multiplied them by "
       << amplification;
  return text.str();
}

}  // namespace irk
