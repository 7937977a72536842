// Computed references in the user's cache, one file per question.
#pragma once

#include <optional>
#include <string>

#include "experiments/reference/making.h"

namespace irk {

/// The reference that an earlier call has kept for this question; nullopt if there is none, or if its file is damaged
/// or belongs to another question or code. Throws what cacheFolder throws.
std::optional<ComputedReference> keptReference(const ReferenceQuestion& question);

/// Keeps the reference, also one without values: the next call need not find out again that there is none. Readers
/// never see half a file. Throws what cacheFolder throws, and if the file cannot be written.
void keepReference(const ReferenceQuestion& question, const ComputedReference& reference);

}  // namespace irk
