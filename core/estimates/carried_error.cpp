#include "core/estimates/carried_error.h"

#include <sstream>

#include "core/estimates/accumulation.h"

namespace irk {

std::string CarriedError::doubt(const Tolerances& tolerances) const {
  // A success should be right to five times what the sum of estimates may be. The amplification by the motion is in
  // this size, but it is an estimate: in the median it is 0.5 to 0.7 of the true error. So the limit is half of it.
  if (!(size > 2.5 * largestError(tolerances))) return {};
  std::ostringstream text;
  text.precision(2);
  text << "the errors of all steps are about " << size << " tolerances at the end; the motion has multiplied them by "
       << amplification;
  return text.str();
}

}  // namespace irk
