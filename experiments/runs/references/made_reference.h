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
/// solution nothing stored describes, and so is the end at a switch (stop_at). Where a run that ends when it is steady
/// will end is not known before it has been made: no. Throws Misuse as makeScene.
bool needsReference(const RunSpec& resolved);

/// The run whose reference is that of `resolved`, a run that has ended at t: without `steady` and up to t. Where it has
/// ended at a switch (stop_at) it is `resolved`: the reference ends at its own time of the switch.
RunSpec endingAt(RunSpec resolved, double t);

/// The runs to each of the times at which the errors of `resolved` are taken; the last is the run itself.
std::vector<RunSpec> atReferenceTimes(const RunSpec& resolved);

}  // namespace irk
