// Any asset, plain or compressed, to a scene.

#include <algorithm>
#include <map>
#include <optional>

#include "codec/arrays.h"
#include "gltf_ext/accessors.h"
#include "gltf_ext/decompress.h"
#include "gltf_ext/emit.h"
#include "gltf_ext/extract.h"
#include "gltf_ext/foreign.h"
#include "gltf_ext/gather.h"
#include "gltf_ext/plan.h"
#include "gltf_ext/polygons.h"
#include "gltf_ext/scene.h"
#include "gltf_ext/scene_nodes.h"

namespace tutte {
namespace {

/// The mesh of one plan, and which of its groups each primitive shows.
struct PlannedMesh {
  PolygonMesh mesh;
  std::vector<Index> group_of;  ///< per primitive of the plan; kNone when it has no faces
};

/// The compressed view behind an accessor, when there is one.
std::optional<CompressedView> compressedViewOf(const Json& json, uint64_t accessor) {
  const auto element = elementOf(json, "accessors", accessor);
  if (!element || member(**element, "sparse") || integerMember(**element, "byteOffset", 0, "").ok() == false) {
    return std::nullopt;
  }
  const auto index = integerMember(**element, "bufferView", "");
  const auto view = index ? compressedViewAt(json, *index) : Outcome<std::optional<CompressedView>>(std::nullopt);
  return view ? *view : std::nullopt;
}

/// Reads meshes from payloads, so that polygons, vertices and groups are the stored ones.
class PayloadMeshes {
 public:
  explicit PayloadMeshes(const Asset& asset) : asset_(asset) {}

  Outcome<Done> prepare() {
    auto payloads = payloadViewsOf(asset_);
    if (!payloads) return payloads.error();
    payloads_ = *std::move(payloads);
    return Done{};
  }

  /// Nothing when not all that the plan refers to comes from one payload.
  Outcome<std::optional<PlannedMesh>> read(const PayloadPlan& plan) {
    std::vector<uint64_t> numbers;
    const auto range = commonPayload(plan, numbers);
    if (!range) return std::optional<PlannedMesh>();
    std::vector<CompressedView> views;
    for (const auto& [index, view] : payloads_.at(*range)) views.push_back(view);
    auto mesh = decodePayload(asset_, *range, views, decoder_);
    if (!mesh) return mesh.error();
    PlannedMesh planned{*std::move(mesh), {}};
    if (!findGroups(plan, planned) || !chooseAttributes(plan, numbers, planned.mesh)) {
      return std::optional<PlannedMesh>();
    }
    return std::optional<PlannedMesh>(std::move(planned));
  }

 private:
  std::optional<PayloadRange> commonPayload(const PayloadPlan& plan, std::vector<uint64_t>& numbers) const {
    std::optional<PayloadRange> range;
    for (const PlannedAttribute& attribute : plan.attributes) {
      const auto view = compressedViewOf(asset_.json, attribute.accessor);
      if (!view || view->mode != Mode::kAttribute || (range && *range != view->payload)) return std::nullopt;
      range = view->payload;
      numbers.push_back(view->attribute);
    }
    return range && payloads_.count(*range) ? range : std::nullopt;
  }

  /// A primitive's group is told by where its slice of the triangles begins and ends.
  bool findGroups(const PayloadPlan& plan, PlannedMesh& planned) const {
    const std::vector<Index> starts = triangleIndices(arraySourceOf(planned.mesh)).group_starts;
    const auto range = compressedViewOf(asset_.json, plan.attributes[0].accessor)->payload;
    for (const PrimitivePlace& place : plan.primitives) {
      const Json& primitive = asset_.json["meshes"][place.mesh]["primitives"][place.primitive];
      const auto accessor = integerMember(primitive, "indices", "");
      const auto view = accessor ? compressedViewOf(asset_.json, *accessor) : std::nullopt;
      if (!view || view->mode != Mode::kTriangles || view->payload != range) return false;
      const Json& object = asset_.json["accessors"][*accessor];
      const uint64_t begin = *integerMember(object, "byteOffset", 0, "") / view->byte_stride;
      const auto count = integerMember(object, "count", "");
      const Index group = count ? groupAt(starts, begin, *count) : kNone;
      if (group == kNone) return false;
      planned.group_of.push_back(group);
    }
    return true;
  }

  /// Groups without triangles begin where their successor does, so that several have the same start.
  static Index groupAt(const std::vector<Index>& starts, uint64_t begin, uint64_t count) {
    const auto first = std::lower_bound(starts.begin(), starts.end(), begin);
    for (size_t g = static_cast<size_t>(first - starts.begin()); g + 1 < starts.size() && starts[g] == begin; ++g) {
      if (starts[g + 1] - starts[g] == count) return static_cast<Index>(g);
    }
    return kNone;
  }

  /// Attributes get the names that the primitives give them, in their order.
  static bool chooseAttributes(const PayloadPlan& plan, const std::vector<uint64_t>& numbers, PolygonMesh& mesh) {
    std::vector<Attribute> chosen;
    for (size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] >= mesh.attributes.size()) return false;
      chosen.push_back(mesh.attributes[numbers[i]]);
      chosen.back().name = plan.attributes[i].name;
    }
    mesh.attributes = std::move(chosen);
    return true;
  }

  const Asset& asset_;
  PayloadViews payloads_;
  Decoder decoder_;
};

/// Reads meshes from plain accessors.
Outcome<PlannedMesh> readPlain(const Asset& asset, const PayloadPlan& plan, bool fb_everywhere) {
  PlannedMesh planned;
  std::vector<PrimitiveFaces> groups;
  for (const PrimitivePlace& place : plan.primitives) {
    const Json& primitive = asset.json["meshes"][place.mesh]["primitives"][place.primitive];
    auto faces = readFaces(asset, primitive, plan.wedge_count, fb_everywhere, place.pointer());
    if (!faces) return faces.error();
    planned.group_of.push_back(faces->degrees.empty() ? kNone : static_cast<Index>(groups.size()));
    if (!faces->degrees.empty()) groups.push_back(*std::move(faces));
  }
  std::vector<Attribute> attributes;
  for (const PlannedAttribute& item : plan.attributes) {
    const auto shape = accessorShape(asset.json, item.accessor);
    if (!shape) return shape.error();
    auto data = readAccessor(asset, item.accessor);
    if (!data) return data.error();
    attributes.push_back(
        {item.name, static_cast<uint8_t>(shape->components), shape->type, shape->normalized, *std::move(data)});
  }
  planned.mesh = weldMesh(std::move(groups), std::move(attributes), static_cast<Index>(plan.wedge_count));
  return planned;
}

class SceneReader {
 public:
  /// `asset` as it is, and `plain` without compression.
  SceneReader(const Asset& asset, const Asset& plain) : asset_(asset), plain_(plain), payloads_(asset) {}

  Outcome<Scene> run() {
    std::vector<Failure> left_out;
    const auto plans = planPayloads(plain_, Purpose::kRead, left_out);
    if (!plans) return plans.error();
    const auto prepared = payloads_.prepare();
    if (!prepared) return prepared.error();
    for (const PayloadPlan& plan : *plans) {
      const auto planned = read(plan);
      if (!planned) return planned.error();
      addMeshes(plan, *planned);
    }
    readMaterials();
    const auto nodes = readNodes(plain_.json, meshes_of_, scene_);
    if (!nodes) return nodes.error();
    return std::move(scene_);
  }

 private:
  Outcome<PlannedMesh> read(const PayloadPlan& plan) {
    auto stored = payloads_.read(plan);
    if (!stored) return stored.error();
    if (*stored) return **std::move(stored);
    return readPlain(plain_, plan, usesUnmarkedFans(plain_.json));
  }

  /// Per group that a mesh shows: its material or -1.
  using ShownGroups = std::map<Index, int>;

  /// One scene mesh for each glTF mesh that the plan has primitives of.
  void addMeshes(const PayloadPlan& plan, const PlannedMesh& planned) {
    std::map<size_t, ShownGroups> groups;
    for (size_t i = 0; i < plan.primitives.size(); ++i) {
      const PrimitivePlace place = plan.primitives[i];
      const Json& primitive = plain_.json["meshes"][place.mesh]["primitives"][place.primitive];
      const auto material = integerMember(primitive, "material", "");
      const bool known = material && *material < countOf(plain_.json, "materials");
      if (planned.group_of[i] == kNone) continue;
      groups[place.mesh].try_emplace(planned.group_of[i], known ? static_cast<int>(*material) : -1);
    }
    // Groups that no primitive shows (faces without area, of imported meshes) belong to the one mesh that there is.
    for (Index group = 0; groups.size() == 1 && group < planned.mesh.group_count; ++group) {
      groups.begin()->second.try_emplace(group, -1);
    }
    for (const auto& [mesh, shown] : groups) addMesh(mesh, shown, planned.mesh);
  }

  void addMesh(size_t mesh, const ShownGroups& shown, const PolygonMesh& whole) {
    SceneMesh result;
    std::vector<Index> groups;
    for (const auto& [group, material] : shown) {
      groups.push_back(group);
      result.group_materials.push_back(material);
    }
    result.name = stringMember(plain_.json["meshes"][mesh], "name");
    result.mesh = extractGroups(whole, groups);
    meshes_of_[mesh].push_back(static_cast<Index>(scene_.meshes.size()));
    scene_.meshes.push_back(std::move(result));
  }

  void readMaterials() {
    for (size_t i = 0; i < countOf(plain_.json, "materials"); ++i) {
      const Json& source = plain_.json["materials"][i];
      SceneMaterial material;
      material.name = stringMember(source, "name");
      const Json* surface = objectMember(source, "pbrMetallicRoughness");
      const Json* color = surface ? member(*surface, "baseColorFactor") : nullptr;
      for (size_t k = 0; color && color->is_array() && color->size() == 4 && k < 4; ++k) {
        if ((*color)[k].is_number()) material.base_color[k] = (*color)[k].get<double>();
      }
      scene_.materials.push_back(std::move(material));
    }
  }

  const Asset& asset_;
  const Asset& plain_;
  PayloadMeshes payloads_;
  Scene scene_;
  std::map<size_t, std::vector<Index>> meshes_of_;
};

}  // namespace

Outcome<Scene> assetToScene(const Asset& asset) {
  return guarded<Scene>([&]() -> Outcome<Scene> {
    auto plain = decompress(asset);
    if (!plain) return plain.error();
    std::vector<Failure> left_out;
    const auto decoded = decodeForeign(*plain, left_out);
    if (!decoded) return decoded.error();
    return SceneReader(asset, *plain).run();
  });
}

}  // namespace tutte
