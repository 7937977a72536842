#include "experiments/claims/evaluations.h"

#include <fmt/format.h>

#include <stdexcept>

namespace irk::claims {

Evaluation evaluationOf(std::string_view part) {
  for (const Evaluations& list : evaluationLists()) {
    for (const auto& [id, evaluate] : list) {
      if (id == part) return evaluate;
    }
  }
  throw std::logic_error(fmt::format("no evaluation of part '{}' of claims.toml", part));
}

}  // namespace irk::claims
