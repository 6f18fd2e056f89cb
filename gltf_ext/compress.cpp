#include "gltf_ext/compress.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "codec/triangulation.h"
#include "gltf_ext/accessors.h"
#include "gltf_ext/buffers.h"
#include "gltf_ext/decompress.h"
#include "gltf_ext/emit.h"
#include "gltf_ext/foreign.h"
#include "gltf_ext/gather.h"
#include "gltf_ext/plan.h"
#include "gltf_ext/polygons.h"
#include "gltf_ext/primitive_writer.h"
#include "gltf_ext/references.h"
#include "gltf_ext/welding.h"

namespace tutte {
namespace {

/// Removes the attributes that are not to be kept. A morph target that would become empty stays as it is, because
/// glTF has no empty ones.
void keepAttributes(Json& json, const std::set<std::string>& kept) {
  const auto filter = [&](Json& list, bool may_be_empty) {
    if (!list.is_object()) return;
    Json filtered = Json::object();
    for (const auto& [name, accessor] : list.items()) {
      if (name == "POSITION" || kept.count(name)) filtered[name] = accessor;
    }
    if (may_be_empty || !filtered.empty()) list = std::move(filtered);
  };
  for (size_t m = 0; m < countOf(json, "meshes"); ++m) {
    const Json* primitives = member(json["meshes"][m], "primitives");
    if (!primitives || !primitives->is_array()) continue;
    for (Json& primitive : json["meshes"][m]["primitives"]) {
      if (objectMember(primitive, "attributes")) filter(primitive["attributes"], true);
      const Json* targets = member(primitive, "targets");
      if (!targets || !targets->is_array()) continue;
      for (Json& target : primitive["targets"]) filter(target, false);
    }
  }
}

/// Says on every triangle primitive what the file says as a whole, so that it stays true when some of them change.
void markFans(Json& json) {
  for (size_t m = 0; m < countOf(json, "meshes"); ++m) {
    const Json* primitives = member(json["meshes"][m], "primitives");
    if (!primitives || !primitives->is_array()) continue;
    for (Json& primitive : json["meshes"][m]["primitives"]) {
      const auto mode = integerMember(primitive, "mode", kModeTriangles, "");
      if (!primitive.is_object() || !mode || *mode != kModeTriangles) continue;
      primitive["extensions"]["FB_ngon_encoding"] = Json::object();
    }
  }
}

std::set<uint64_t> inUse(const std::vector<size_t>& uses) {
  std::set<uint64_t> indices;
  for (size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] > 0) indices.insert(i);
  }
  return indices;
}

/// Compresses one asset in place.
class Compressor {
 public:
  Compressor(Asset& asset, const CompressOptions& options, CompressReport& report)
      : asset_(asset), options_(options), report_(report), emitter_(asset, options.fallback) {}

  Outcome<Done> run() {
    const std::set<uint64_t> accessors = inUse(accessorUses(asset_.json)), views = inUse(viewUses(asset_.json));
    if (!options_.attributes.empty()) keepAttributes(asset_.json, options_.attributes);
    if (usesUnmarkedFans(asset_.json)) markFans(asset_.json);
    const auto plans = planPayloads(asset_, Purpose::kCompress, report_.warnings);
    if (!plans) return plans.error();
    const auto grids = planGrids(boxesOf(*plans), options_.pack, options_.grid);
    if (!grids) return grids.error();
    for (size_t i = 0; i < plans->size(); ++i) {
      const auto done = compressPayload((*plans)[i], (*grids)[i]);
      if (!done && done.error().kind != FailureKind::kUnsupported) return done;
      if (!done) report_.warnings.push_back(done.error());
    }
    emitter_.finish();
    finishPolygonExtensions();
    removeUnusedAccessors(asset_, accessors);
    trimViews(asset_, views);
    removeUnusedViews(asset_, views);
    return mergeBuffers(asset_);
  }

 private:
  struct Groups {
    std::vector<PrimitiveFaces> faces;
    std::vector<GroupWish> wishes;
    std::vector<PrimitivePlace> primitives;  ///< those with faces
    std::vector<size_t> group_of;            ///< per primitive
    uint64_t index_bytes = 1;
  };

  /// Payloads of one mesh belong together, and so do those that another one joins.
  std::vector<PositionBox> boxesOf(const std::vector<PayloadPlan>& plans) const {
    std::vector<size_t> parent(countOf(asset_.json, "meshes"));
    std::iota(parent.begin(), parent.end(), size_t{0});
    const auto find = [&](size_t mesh) {
      while (parent[mesh] != mesh) mesh = parent[mesh] = parent[parent[mesh]];
      return mesh;
    };
    for (const PayloadPlan& plan : plans) {
      for (const PrimitivePlace& place : plan.primitives) parent[find(place.mesh)] = find(plan.primitives[0].mesh);
    }
    std::vector<PositionBox> boxes;
    for (const PayloadPlan& plan : plans) {
      const auto positions = readAttribute(plan.attributes[0]);
      boxes.push_back(positions ? boxOf(*positions, find(plan.primitives[0].mesh)) : PositionBox{});
    }
    return boxes;
  }

  Outcome<Done> compressPayload(const PayloadPlan& plan, const std::optional<PositionGrid>& grid) {
    auto groups = readGroups(plan);
    if (!groups) return groups.error();
    if (groups->faces.empty()) return Done{};
    auto attributes = readAttributes(plan);
    if (!attributes) return attributes.error();
    PolygonMesh mesh = weldMesh(std::move(groups->faces), *std::move(attributes), static_cast<Index>(plan.wedge_count));
    if (!options_.attributes.empty()) joinEqualWedges(mesh);
    PackOptions pack_options = options_.pack;
    pack_options.grid = grid;
    auto packed = pack(mesh, pack_options);
    if (!packed) {
      report_.warnings.push_back(at(plan, packed.error()));
      return Done{};
    }
    const auto decoded = unpack(packed->bytes);
    if (!decoded) return at(plan, decoded.error());
    const auto emitted = emitter_.add(packed->bytes, *decoded, groups->wishes, groups->index_bytes);
    if (!emitted) return at(plan, emitted.error());
    addReport(plan, mesh, *std::move(packed));
    PrimitiveWriter writer(asset_, report_.warnings);
    writer.replaceAttributes(plan, *emitted);
    for (size_t i = 0; i < groups->primitives.size(); ++i) {
      const size_t group = groups->group_of[i];
      writer.write(groups->primitives[i], group, emitted->groups[group], groups->wishes[group].notation);
    }
    return Done{};
  }

  static Failure at(const PayloadPlan& plan, Failure failure) {
    failure.where = plan.primitives[0].pointer() + (failure.where.empty() ? "" : " " + failure.where);
    return failure;
  }

  /// Primitives with the same indices and notation show the same group.
  Outcome<Groups> readGroups(const PayloadPlan& plan) {
    Groups groups;
    std::map<std::string, size_t> known;
    for (const PrimitivePlace& place : plan.primitives) {
      const Json& primitive = place.in(asset_.json);
      Json key = {{"indices", nullptr}, {"mode", kModeTriangles}, {"polygons", nullptr}};
      for (const char* name : {"indices", "mode"}) {
        if (const Json* value = member(primitive, name)) key[name] = *value;
      }
      if (const Json* polygons = extensionOf(primitive, "EXT_mesh_polygon")) key["polygons"] = *polygons;
      key["fans"] = extensionOf(primitive, "FB_ngon_encoding") != nullptr;
      const auto [group, is_new] = known.try_emplace(key.dump(), groups.faces.size());
      if (is_new) {
        const auto added = addGroup(groups, place, plan.wedge_count);
        if (!added) return added.error();
        if (!*added) {
          known.erase(group);
          continue;
        }
      }
      groups.primitives.push_back(place);
      groups.group_of.push_back(group->second);
    }
    return groups;
  }

  /// False when the primitive has no triangles, which no accessor could show.
  Outcome<bool> addGroup(Groups& groups, PrimitivePlace place, uint64_t wedge_count) {
    const Json& primitive = place.in(asset_.json);
    auto faces = readFaces(asset_, primitive, wedge_count, false, place.pointer());
    if (!faces) return faces.error();
    const auto& counts = faces->triangulation.counts;
    const bool drawn = counts.empty() ? !faces->degrees.empty() : !faces->triangulation.corners.empty();
    if (!drawn) {
      report_.warnings.push_back(unsupported(place.pointer(), "a primitive without triangles stays as it is"));
      return false;
    }
    const auto indices = integerMember(primitive, "indices", "");
    const auto shape = indices ? accessorShape(asset_.json, *indices) : Outcome<AccessorShape>(AccessorShape{});
    groups.index_bytes = std::max<uint64_t>(groups.index_bytes, indices && shape ? sizeOf(shape->type) : 2);
    groups.wishes.push_back({wishOf(primitive, *faces)});
    groups.faces.push_back(*std::move(faces));
    return true;
  }

  PolygonNotation wishOf(const Json& primitive, const PrimitiveFaces& faces) const {
    const PolygonNotation found = notationOf(primitive, false);
    const bool all_triangles = faces.ring_owners.empty() && onlyTriangles(faces.degrees);
    if (all_triangles && found != PolygonNotation::kExt) return PolygonNotation::kTriangles;
    if (options_.polygons == PolygonOutput::kAuto) return found;
    switch (options_.polygons) {
      case PolygonOutput::kFb: return PolygonNotation::kFb;
      case PolygonOutput::kExt: return PolygonNotation::kExt;
      default: return PolygonNotation::kBoth;
    }
  }

  Outcome<std::vector<Attribute>> readAttributes(const PayloadPlan& plan) const {
    std::vector<Attribute> attributes;
    for (const PlannedAttribute& planned : plan.attributes) {
      auto attribute = readAttribute(planned);
      if (!attribute) return attribute.error();
      attributes.push_back(*std::move(attribute));
    }
    return attributes;
  }

  Outcome<Attribute> readAttribute(const PlannedAttribute& planned) const {
    const auto shape = accessorShape(asset_.json, planned.accessor);
    if (!shape) return shape.error();
    auto data = readAccessor(asset_, planned.accessor);
    if (!data) return data.error();
    return Attribute{planned.name, static_cast<uint8_t>(shape->components), shape->type, shape->normalized,
                     *std::move(data)};
  }

  void addReport(const PayloadPlan& plan, const PolygonMesh& mesh, Packed packed) {
    const Json& first = asset_.json["meshes"][plan.primitives[0].mesh];
    report_.payloads.push_back({stringMember(first, "name"), mesh.polygons.vertex_count, mesh.wedge_count,
                                mesh.polygons.face_degrees.size(), mesh.polygons.corners.size(), mesh.group_count,
                                std::move(packed)});
  }

  /// Lists the polygon extensions that are in use after all. Primitives that stayed as they are count, too.
  void finishPolygonExtensions() {
    bool fans = false, polygons = false;
    for (size_t m = 0; m < countOf(asset_.json, "meshes"); ++m) {
      for (Json& primitive : asset_.json["meshes"][m]["primitives"]) {
        fans |= extensionOf(primitive, "FB_ngon_encoding") != nullptr;
        polygons |= extensionOf(primitive, "EXT_mesh_polygon") != nullptr;
      }
    }
    setUsed("FB_ngon_encoding", fans);
    setUsed("EXT_mesh_polygon", polygons);
  }

  void setUsed(const char* extension, bool used) {
    if (used) {
      addExtension(asset_.json, "extensionsUsed", extension);
    } else {
      removeExtension(asset_.json, "extensionsUsed", extension);
      removeExtension(asset_.json, "extensionsRequired", extension);
    }
  }

  Asset& asset_;
  const CompressOptions& options_;
  CompressReport& report_;
  PayloadEmitter emitter_;
};

Outcome<Compressed> compressGuarded(const Asset& asset, const CompressOptions& options) {
  auto plain = decompress(asset);
  if (!plain) return plain.error();
  Compressed result{*std::move(plain), {}};
  const auto decoded = decodeForeign(result.asset, result.report.warnings);
  if (!decoded) return decoded.error();
  const auto done = Compressor(result.asset, options, result.report).run();
  if (!done) return done.error();
  return result;
}

}  // namespace

Outcome<Compressed> compress(const Asset& asset, const CompressOptions& options) {
  return guarded<Compressed>([&] { return compressGuarded(asset, options); });
}

}  // namespace tutte
