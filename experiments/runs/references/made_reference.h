// References that are made for runs, and which runs need one.
#pragma once

#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"
#include "irk/scene.h"

namespace irk {

/// A computed reference; experiments/reference makes it.
struct MadeReference {
  std::vector<Reference> values;  ///< empty: there is none
  std::string problem;            ///< why there is none, in one line
};

/// Whether the run asks for a reference (`auto`) and none is stored: neither the closed form nor the files of
/// problems/reference know a component at t_end. With `smooth` a scene that switches is another problem, whose
/// solution nothing stored describes. Throws Misuse as makeScene.
bool needsReference(const RunSpec& resolved);

/// The runs to each of the times at which the errors of `resolved` are taken; the last is the run itself.
std::vector<RunSpec> atReferenceTimes(const RunSpec& resolved);

}  // namespace irk
