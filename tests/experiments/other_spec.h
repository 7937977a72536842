// Other legal values for every field of a run.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/runs/fields.h"
#include "tests/core/other_values.h"

namespace irk {

/// Values that differ from those of `spec`, a run of slider_crank. Only fields of text need a line here, and t_end,
/// which lies after the start.
inline std::vector<std::string> otherValues(const SpecField& field, const RunSpec& spec) {
  static const std::map<std::string, std::vector<std::string>> texts = {
      {"scene", {"pendulum"}}, {"settings", {"torque_off_at=0.25"}}, {"method", {"gauss_4"}},
      {"t_end", {"0.5"}},      {"atol_of", {"theta=1e-3"}},          {"stop_at", {"impact:2"}}};
  const auto known = texts.find(field.name);
  auto values = known == texts.end() ? otherValues<RunSpec>(field) : known->second;
  std::erase_if(values, [&](const std::string& value) {
    RunSpec changed = spec;
    field.set(changed, value);
    return field.get(changed) == field.get(spec);
  });
  return values;
}

inline RunSpec sliderCrank() {
  RunSpec spec;
  spec.scene = "slider_crank";
  return resolved(spec);
}

}  // namespace irk
