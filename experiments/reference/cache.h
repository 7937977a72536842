// Computed references in the user's cache, one file per question.
#pragma once

#include <optional>
#include <string>

#include "experiments/reference/making.h"

namespace irk {

/// The reference that an earlier call has kept for this question; nullopt if there is none, or if its file is damaged
/// or belongs to another question or code. Throws what cacheFolder throws.
std::optional<ComputedReference> keptReference(const ReferenceQuestion& question);

/// Keeps the reference, also one without values, so that the next call need not try again. Readers never see an
/// incomplete file. Throws what cacheFolder throws, and if the file cannot be written.
void keepReference(const ReferenceQuestion& question, const ComputedReference& reference);

}  // namespace irk
