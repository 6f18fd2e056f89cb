#pragma once
// Who refers to which accessor, buffer view and buffer: so that unused ones can go, and the rest be renumbered.

#include <functional>
#include <set>
#include <vector>

#include "gltf_ext/asset.h"
#include "gltf_ext/json_access.h"

namespace tutte {

/// Calls `visit` with every accessor index in the JSON: of primitives, targets, skins, animations and of the
/// extensions that we know. The values may be changed; ones that are no integers are left out.
void forEachAccessorReference(Json& json, const std::function<void(Json&)>& visit);

/// The same for buffer views.
void forEachViewReference(Json& json, const std::function<void(Json&)>& visit);

/// What an extension that we do not know may refer to: all integers inside it. Nothing with such a number may be
/// removed or renumbered.
struct Suspects {
  bool any = false;
  std::set<uint64_t> numbers;
};

Suspects suspectsOf(const Json& json);

/// How often each accessor is referred to, by what we know.
std::vector<size_t> accessorUses(Json& json);

/// How often each buffer view is referred to, by what we know.
std::vector<size_t> viewUses(Json& json);

/// Removes those of the given accessors that nothing refers to. When an extension that we do not know holds integers,
/// indices stay as they are: then the unused are emptied, except those it might mean.
void removeUnusedAccessors(Asset& asset, const std::set<uint64_t>& candidates);

/// The same for buffer views.
void removeUnusedViews(Asset& asset, const std::set<uint64_t>& candidates);

}  // namespace tutte
