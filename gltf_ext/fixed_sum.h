#pragma once
// Weights that have one sum everywhere.

#include "gltf_ext/attribute_coding.h"

namespace tutte {

/// Leaves the first component of an attribute out of its coding (AttributeCoding::summed) if the other components tell
/// it: WEIGHTS and custom attributes as words or fractions whose components have the same sum in all wedges. O(values).
void fixSum(const Attribute& attribute, const AttributeName& name, AttributeCoding& coding);

}  // namespace tutte
