#pragma once
// The rules of glTF that keep readers of its binary data safe.

#include "gltf_ext/asset.h"
#include "gltf_ext/failure.h"

namespace tutte {

/// Checks that buffer views lie in their buffers and accessors in their views, that references to accessors and views
/// exist, and that nodes form trees. Views whose buffer has no data (placeholders) are not checked. The first rule
/// that is broken is the error: kInvalid, with a JSON pointer.
Outcome<Done> checkAsset(const Asset& asset);

}  // namespace tutte
