#include "codec/triangulation.h"

#include <algorithm>

#include "codec/polygon_table.h"
#include "codec/range_coder.h"
#include "codec/triangulation_script.h"
#include "codec/triangulation_shape.h"

namespace tutte {
namespace {

/// Reads the polygons' triangles one after the other.
class Input {
 public:
  explicit Input(const Triangulation& triangulation) : triangulation_(triangulation) {}

  /// The next `count` triangles, which must be the polygon's own.
  bool read(const Polygon& polygon, Index count, std::vector<Triangle>& triangles) {
    triangles.resize(count);
    for (Triangle& t : triangles) {
      for (Index& corner : t) {
        corner = polygon.localOf(triangulation_.corners[next_++]);
        if (corner == kNone) return false;
      }
    }
    return true;
  }

 private:
  const Triangulation& triangulation_;
  size_t next_ = 0;
};

Error checkInput(const PolygonTable& polygons, size_t face_count, const Triangulation& triangulation) {
  if (triangulation.counts.size() != face_count) return Error::kCountMismatch;
  uint64_t total = 0;
  for (Index face = 0; face < face_count; ++face) {
    const Index count = triangulation.counts[face];
    if (count != 0 && (polygons.isHole(face) || !polygons[face].drawable())) return Error::kMalformed;
    total += count;
  }
  return 3 * total == triangulation.corners.size() ? Error::kNone : Error::kCountMismatch;
}

bool isDefault(const Polygon& polygon, const Shape& shape) {
  return polygon.holes.empty() && shape.kind == Kind::kFan && shape.apex == 0;
}

/// What must be known before the first symbol.
struct Survey {
  bool all_default = true;
  bool lists = false;
};

Result<Survey> survey(const PolygonTable& polygons, size_t face_count, const Triangulation& triangulation) {
  Survey result;
  Input input(triangulation);
  Shape shape;
  ShapeFinder finder(shape);
  for (Index face = 0; face < face_count; ++face) {
    if (polygons.isHole(face) || !polygons[face].drawable()) continue;
    const Polygon polygon = polygons[face];
    if (!input.read(polygon, triangulation.counts[face], shape.triangles)) return Error::kIndexOutOfRange;
    finder.classify(polygon);
    result.all_default &= isDefault(polygon, shape);
    result.lists |= polygon.holes.empty() && shape.kind == Kind::kList;
  }
  return result;
}

/// The corners of the triangles of polygons without holes.
size_t expectedCorners(size_t corners, size_t faces) { return 3 * (corners - std::min(corners, 2 * faces)); }

/// Appends triangles to the result.
class Output {
 public:
  /// `expected` corners; there may be more or less.
  Output(Triangulation& triangulation, size_t face_count, size_t expected)
      : counts_(triangulation.counts), corners_(triangulation.corners) {
    counts_.resize(face_count);
    corners_.resize(expected);
  }

  void fan(Index face, const Ring& ring, Index apex) {
    if (ring.degree < 3) return;
    const auto corner = [&](Index i) {
      const Index at = apex + i;
      return ring.first + (at < ring.degree ? at : at - ring.degree);
    };
    Index* out = begin(face, ring.degree - 2);
    for (Index i = 1; i + 1 < ring.degree; ++i, out += 3) {
      out[0] = corner(0);
      out[1] = corner(i);
      out[2] = corner(i + 1);
    }
  }

  /// Of a quad, whose fan starts at the first or at the second corner.
  void quad(Index face, Index first, Index apex) {
    Index* const out = begin(face, 2);
    out[0] = out[3] = first + apex;
    out[1] = first + apex + 1;
    out[2] = out[4] = first + apex + 2;
    out[5] = first + (apex == 0 ? 3 : 0);
  }

  void triangle(Index face, const Triangle& corners) { std::ranges::copy(corners, begin(face, 1)); }

  /// Afterwards.
  void finish() { corners_.resize(used_); }

 private:
  // Where so many further triangles go.
  Index* begin(Index face, Index count) {
    const size_t at = used_;
    used_ += size_t{3} * count;
    counts_[face] += count;
    if (used_ > corners_.size()) corners_.resize(std::max(used_, at * 3 / 2));
    return corners_.data() + at;
  }

  std::vector<Index>&counts_, &corners_;
  size_t used_ = 0;
};

/// Decodes polygon by polygon, never more than `max_triangles` in all.
class Decoder {
 public:
  Decoder(RangeReader& port, const Connectivity& mesh, Index max_triangles, Triangulation& result)
      : port_(port),
        script_(port, mesh),
        output_(result, mesh.face_degrees.size(),
                std::min(size_t{3} * max_triangles, expectedCorners(mesh.umbrellas.size(), mesh.face_degrees.size()))),
        left_(max_triangles) {
    script_.header(false);
  }

  /// Of a polygon without holes: is it a quad of which nothing is coded but the diagonal?
  bool isPlainQuad(Index degree) const { return degree == 4 && script_.hasPlainQuads() && left_ >= 2; }

  Error quad(Index face, Index first) {
    output_.quad(face, first, script_.quad(first, 0));
    left_ -= 2;
    return port_.overrun() ? Error::kTruncated : Error::kNone;
  }

  Error polygon(Index face, const Polygon& polygon) {
    script_.polygon(polygon, shape_);
    if (shape_.kind == Kind::kList) return list(face, polygon);
    if (polygon.exterior.degree - 2 > left_) return Error::kLimitExceeded;
    left_ -= polygon.exterior.degree - 2;
    if (shape_.kind == Kind::kFan) output_.fan(face, polygon.exterior, shape_.apex);
    if (shape_.kind == Kind::kTree) {
      const Index first = polygon.exterior.first;
      for (const auto& t : shape_.triangles) output_.triangle(face, {first + t[0], first + t[1], first + t[2]});
    }
    return port_.overrun() ? Error::kTruncated : Error::kNone;
  }

  /// After the last one.
  void finish() { output_.finish(); }

 private:
  Error list(Index face, const Polygon& polygon) {
    const Index count = script_.listLength(0);
    if (count > left_) return Error::kLimitExceeded;
    left_ -= count;
    polygon.listCorners(corners_);
    for (Index i = 0; i < count; ++i) {
      Triangle t{};
      script_.listTriangle(polygon.corner_count, t);
      if (port_.overrun()) return Error::kTruncated;
      output_.triangle(face, {corners_[t[0]], corners_[t[1]], corners_[t[2]]});
    }
    return port_.overrun() ? Error::kTruncated : Error::kNone;
  }

  RangeReader& port_;
  TriangulationScript<RangeReader> script_;
  Output output_;
  Index left_;
  Shape shape_;
  std::vector<Index> corners_;
};

}  // namespace

Triangulation fanTriangulation(PolygonView mesh, std::span<const Index> ring_owners) {
  Triangulation result;
  Output output(result, mesh.face_degrees.size(), expectedCorners(mesh.corners.size(), mesh.face_degrees.size()));
  Index first = 0;
  for (Index face = 0; face < mesh.face_degrees.size(); ++face) {
    const Index degree = mesh.face_degrees[face];
    if (ring_owners.empty() || ring_owners[face] == kNone) output.fan(face, {first, degree, 0}, 0);
    first += degree;
  }
  output.finish();
  return result;
}

Result<std::optional<std::vector<uint8_t>>> encodeTriangulation(const Connectivity& mesh,
                                                                std::span<const Index> ring_owners,
                                                                const Triangulation& triangulation) {
  const PolygonTable polygons(mesh.face_degrees, ring_owners);
  const size_t face_count = mesh.face_degrees.size();
  if (const Error error = checkInput(polygons, face_count, triangulation); error != Error::kNone) return error;
  const Result<Survey> found = survey(polygons, face_count, triangulation);
  if (!found) return found.error();
  if (found->all_default) return std::optional<std::vector<uint8_t>>{};

  RangeWriter port;
  TriangulationScript<RangeWriter> script(port, mesh);
  script.header(found->lists);
  Input input(triangulation);
  Shape shape;
  ShapeFinder finder(shape);
  for (Index face = 0; face < face_count; ++face) {
    const Polygon polygon = polygons[face];
    if (polygons.isHole(face) || !polygon.drawable()) continue;
    (void)input.read(polygon, triangulation.counts[face], shape.triangles);
    finder.classify(polygon);
    script.polygon(polygon, shape);
    if (shape.kind != Kind::kList) continue;
    script.listLength(triangulation.counts[face]);
    for (Triangle& t : shape.triangles) script.listTriangle(polygon.corner_count, t);
  }
  return std::optional(std::move(port).finish());
}

Result<Triangulation> decodeTriangulation(const Connectivity& mesh, std::span<const Index> ring_owners,
                                          std::span<const uint8_t> bytes, Index max_triangles) {
  const PolygonTable polygons(mesh.face_degrees, ring_owners);
  RangeReader port(bytes);
  Triangulation result;
  Decoder decoder(port, mesh, max_triangles, result);
  for (Index face = 0, count = polygons.size(); face < count; ++face) {
    Error error = Error::kNone;
    if (ring_owners.empty() && decoder.isPlainQuad(mesh.face_degrees[face])) {
      error = decoder.quad(face, polygons.firstCorner(face));
    } else if (const Polygon polygon = polygons[face]; !polygons.isHole(face) && polygon.drawable()) {
      error = decoder.polygon(face, polygon);
    }
    if (error != Error::kNone) return error;
  }
  if (port.trailing()) return Error::kTrailingBytes;
  decoder.finish();
  return result;
}

}  // namespace tutte
