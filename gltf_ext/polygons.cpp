#include "gltf_ext/polygons.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "gltf_ext/accessors.h"

namespace tutte {
namespace {

/// Reads what EXT_mesh_polygon says about one polygon after the other.
class PolygonReader {
 public:
  PolygonReader(std::span<const Index> triangles, const PolygonArrays& arrays, const std::string& where)
      : triangles_(triangles), arrays_(arrays), where_(where) {}

  Outcome<PrimitiveFaces> read() {
    const size_t count = arrays_.index_offsets.size();
    if (arrays_.loop_offsets.size() != count) return invalid(where_, "both offset arrays need one entry per polygon");
    if (count == 0 || arrays_.index_offsets[0] != 0 || arrays_.loop_offsets[0] != 0) {
      return invalid(where_, "the first polygon must begin at offset 0");
    }
    for (size_t n = 0; n < count; ++n) {
      const auto loops = slice(arrays_.loops, arrays_.loop_offsets, n);
      const auto triangles = slice(triangles_, arrays_.index_offsets, n);
      if (!loops || !triangles) return invalid(where_, "offsets must rise and stay inside their arrays");
      const auto rings = readRings(*loops);
      if (!rings) return rings.error();
      const auto drawn = readTriangles(*triangles);
      if (!drawn) return drawn.error();
    }
    if (!has_holes_) faces_.ring_owners.clear();
    return std::move(faces_);
  }

 private:
  /// The elements of polygon n; nothing when the offsets are wrong.
  static std::optional<std::span<const Index>> slice(std::span<const Index> values, std::span<const Index> offsets,
                                                     size_t n) {
    const size_t begin = offsets[n], end = n + 1 < offsets.size() ? offsets[n + 1] : values.size();
    if (begin > end || end > values.size()) return std::nullopt;
    return values.subspan(begin, end - begin);
  }

  Outcome<Done> readRings(std::span<const Index> loops) {
    exterior_ = static_cast<Index>(faces_.degrees.size());
    first_corner_ = static_cast<Index>(faces_.corners.size());
    size_t begin = 0;
    for (size_t i = 0; i <= loops.size(); ++i) {
      if (i < loops.size() && loops[i] != kNone) continue;
      if (i > begin) addRing(loops.subspan(begin, i - begin));
      begin = i + 1;
    }
    if (faces_.degrees.size() == exterior_) return invalid(where_, "a polygon has no ring");
    return Done{};
  }

  void addRing(std::span<const Index> ring) {
    const bool is_hole = faces_.degrees.size() > exterior_;
    has_holes_ |= is_hole;
    faces_.degrees.push_back(static_cast<Index>(ring.size()));
    faces_.ring_owners.push_back(is_hole ? exterior_ : kNone);
    faces_.triangulation.counts.push_back(0);
    for (const Index wedge : ring) {
      const auto corner = static_cast<Index>(faces_.corners.size());
      Index& local = local_.try_emplace(wedge, corner).first->second;
      if (local < first_corner_) local = corner;
      faces_.corners.push_back(wedge);
    }
  }

  Outcome<Done> readTriangles(std::span<const Index> triangles) {
    if (triangles.size() % 3 != 0) return invalid(where_ + "/indicesOffsets", "an offset is not at a triangle");
    for (const Index wedge : triangles) {
      const auto corner = local_.find(wedge);
      if (corner == local_.end() || corner->second < first_corner_) {
        return invalid(where_, "a triangle uses a vertex that is not on its polygon's rings");
      }
      faces_.triangulation.corners.push_back(corner->second);
    }
    faces_.triangulation.counts[exterior_] = static_cast<Index>(triangles.size() / 3);
    return Done{};
  }

  std::span<const Index> triangles_;
  const PolygonArrays& arrays_;
  const std::string& where_;
  PrimitiveFaces faces_;
  /// Wedge -> its first corner in the polygon at hand; entries below first_corner_ are older polygons'. It is never
  /// cleared, because that would cost as much as the largest polygon, every time.
  std::unordered_map<Index, Index> local_;
  Index first_corner_ = 0;
  Index exterior_ = 0;
  bool has_holes_ = false;
};

bool isDegenerate(Index a, Index b, Index c) { return a == b || b == c || c == a; }

Outcome<std::vector<Index>> readMember(const Asset& asset, const Json& object, const char* key,
                                       const std::string& where) {
  const auto accessor = integerMember(object, key, where);
  if (!accessor) return accessor.error();
  return readIndices(asset, *accessor);
}

/// The restart value of the accessor's type becomes kNone.
Outcome<std::vector<Index>> readLoops(const Asset& asset, const Json& polygon, const std::string& where) {
  auto loops = readMember(asset, polygon, "loopIndices", where);
  if (!loops) return loops;
  const auto shape = accessorShape(asset.json, *asInteger(polygon["loopIndices"]));
  if (!shape) return shape.error();
  const uint32_t bits = 8 * sizeOf(shape->type);
  const Index restart = kNone >> (32 - bits);
  std::replace(loops->begin(), loops->end(), restart, kNone);
  return loops;
}

Outcome<PolygonArrays> readPolygonArrays(const Asset& asset, const Json& polygon, const std::string& where) {
  auto index_offsets = readMember(asset, polygon, "indicesOffsets", where);
  if (!index_offsets) return index_offsets.error();
  auto loop_offsets = readMember(asset, polygon, "loopIndicesOffsets", where);
  if (!loop_offsets) return loop_offsets.error();
  auto loops = readLoops(asset, polygon, where);
  if (!loops) return loops.error();
  const auto count = integerMember(polygon, "count", where);
  if (!count) return count.error();
  if (*count != index_offsets->size()) return invalid(where + "/count", "this is not the length of indicesOffsets");
  return PolygonArrays{*std::move(index_offsets), *std::move(loops), *std::move(loop_offsets)};
}

Outcome<std::vector<Index>> readTriangleList(const Asset& asset, const Json& primitive, uint64_t wedge_count,
                                             const std::string& where) {
  const auto mode = integerMember(primitive, "mode", kModeTriangles, where);
  if (!mode) return mode.error();
  std::vector<Index> indices;
  if (member(primitive, "indices")) {
    auto read = readMember(asset, primitive, "indices", where);
    if (!read) return read.error();
    indices = *std::move(read);
  } else {
    indices.resize(wedge_count);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  for (const Index index : indices) {
    if (index >= wedge_count) return invalid(where + "/indices", "an index is not below the number of vertices");
  }
  return triangleList(*mode, indices);
}

}  // namespace

std::vector<Index> triangleList(uint64_t mode, std::span<const Index> indices) {
  if (mode == kModeTriangles) return {indices.begin(), indices.begin() + indices.size() / 3 * 3};
  std::vector<Index> triangles;
  for (size_t i = 0; i + 2 < indices.size(); ++i) {
    const Index a = mode == kModeFan ? indices[0] : indices[i];
    const size_t odd = mode == kModeStrip ? i % 2 : 0;
    const Index b = indices[i + 1 + odd], c = indices[i + 2 - odd];
    if (!isDegenerate(a, b, c)) triangles.insert(triangles.end(), {a, b, c});
  }
  return triangles;
}

PrimitiveFaces facesOfTriangles(std::span<const Index> triangles) {
  PrimitiveFaces faces;
  faces.degrees.assign(triangles.size() / 3, 3);
  faces.corners.assign(triangles.begin(), triangles.end());
  return faces;
}

PrimitiveFaces facesOfFans(std::span<const Index> triangles) {
  PrimitiveFaces faces;
  Triangulation& drawn = faces.triangulation;
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const bool goes_on =
        !faces.degrees.empty() && triangles[i] == triangles[i - 3] && triangles[i + 1] == triangles[i - 1];
    const auto corner = static_cast<Index>(faces.corners.size());
    if (goes_on) {
      faces.corners.push_back(triangles[i + 2]);
      drawn.corners.insert(drawn.corners.end(), {corner - faces.degrees.back(), corner - 1, corner});
      ++faces.degrees.back();
      ++drawn.counts.back();
    } else {
      faces.corners.insert(faces.corners.end(), {triangles[i], triangles[i + 1], triangles[i + 2]});
      drawn.corners.insert(drawn.corners.end(), {corner, corner + 1, corner + 2});
      faces.degrees.push_back(3);
      drawn.counts.push_back(1);
    }
  }
  return faces;
}

Outcome<PrimitiveFaces> facesOfPolygons(std::span<const Index> triangles, const PolygonArrays& arrays,
                                        const std::string& where) {
  return PolygonReader(triangles, arrays, where).read();
}

bool usesUnmarkedFans(const Json& json) {
  if (!listsExtension(json, "extensionsUsed", "FB_ngon_encoding")) return false;
  for (size_t i = 0; i < countOf(json, "meshes"); ++i) {
    const Json* primitives = member(json["meshes"][i], "primitives");
    if (!primitives || !primitives->is_array()) continue;
    for (const Json& primitive : *primitives) {
      if (extensionOf(primitive, "FB_ngon_encoding")) return false;
    }
  }
  return true;
}

PolygonNotation notationOf(const Json& primitive, bool fb_everywhere) {
  const bool fb = fb_everywhere || extensionOf(primitive, "FB_ngon_encoding");
  const bool ext = extensionOf(primitive, "EXT_mesh_polygon");
  if (ext) return fb ? PolygonNotation::kBoth : PolygonNotation::kExt;
  return fb ? PolygonNotation::kFb : PolygonNotation::kTriangles;
}

Outcome<PrimitiveFaces> readFaces(const Asset& asset, const Json& primitive, uint64_t wedge_count, bool fb_everywhere,
                                  const std::string& where) {
  const auto triangles = readTriangleList(asset, primitive, wedge_count, where);
  if (!triangles) return triangles.error();
  const Json* polygon = extensionOf(primitive, "EXT_mesh_polygon");
  if (!polygon) {
    const bool fans = notationOf(primitive, fb_everywhere) == PolygonNotation::kFb;
    return fans ? facesOfFans(*triangles) : facesOfTriangles(*triangles);
  }
  const std::string place = where + "/extensions/EXT_mesh_polygon";
  const auto mode = integerMember(primitive, "mode", kModeTriangles, where);
  if (!mode || *mode != kModeTriangles) {
    return invalid(place, "polygons need a primitive of mode TRIANGLES");
  }
  const auto arrays = readPolygonArrays(asset, *polygon, place);
  if (!arrays) return arrays.error();
  for (const Index index : arrays->loops) {
    if (index != kNone && index >= wedge_count) return invalid(place, "an index is not below the number of vertices");
  }
  return facesOfPolygons(*triangles, *arrays, place);
}

}  // namespace tutte
