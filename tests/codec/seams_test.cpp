// Wedges and seams: they come back exactly, whatever they are; damaged bytes give an error or a sound structure.

#include "codec/seams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "codec/wedges.h"
#include "tests/codec/overlays.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;

/// Random values of one byte per wedge.
Bytes values(Index wedge_count, Index different, uint64_t seed) {
  shapes::Random random(seed);
  Bytes bytes(wedge_count);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.below(different));
  return bytes;
}

Index next(const Connectivity& mesh, const std::vector<Index>& face_of, const std::vector<Index>& first, Index corner) {
  const Index face = face_of[corner];
  return corner + 1 == first[face] + mesh.face_degrees[face] ? first[face] : corner + 1;
}

/// The seams of one attribute by definition: both ends of every edge are compared.
Bytes seamsOf(const Connectivity& mesh, const std::vector<Index>& wedges, const Bytes& data) {
  std::vector<Index> face_of, first;
  for (Index face = 0; face < mesh.face_degrees.size(); ++face) {
    first.push_back(static_cast<Index>(face_of.size()));
    face_of.insert(face_of.end(), mesh.face_degrees[face], face);
  }
  Bytes seams(wedges.size());
  for (Index corner = 0; corner < seams.size(); ++corner) {
    const Index twin = mesh.twins[corner];
    if (twin == kNone) continue;
    const auto value = [&](Index c) { return data[wedges[c]]; };
    seams[corner] = value(corner) != value(next(mesh, face_of, first, twin)) ||
                    value(next(mesh, face_of, first, corner)) != value(twin);
  }
  return seams;
}

/// What decodes must name wedges below the count, give each to one vertex, and leave none but those of isolated
/// vertices unused.
void expectSound(const Connectivity& mesh, const Seams& seams) {
  std::vector<Index> vertex_of(seams.wedge_count, kNone);
  ASSERT_EQ(seams.wedges.size(), mesh.umbrellas.size());
  for (Index corner = 0; corner < seams.wedges.size(); ++corner) {
    ASSERT_LT(seams.wedges[corner], seams.wedge_count);
    Index& vertex = vertex_of[seams.wedges[corner]];
    if (vertex == kNone) vertex = mesh.vertexOf(corner);
    ASSERT_EQ(vertex, mesh.vertexOf(corner));
  }
  std::vector<Index> owner(seams.wedge_count, kNone);
  for (Index corner = 0; corner < seams.vertices.size(); ++corner) {
    ASSERT_LT(seams.vertices[corner], seams.vertex_count);
    Index& vertex = owner[seams.wedges[corner]];
    if (vertex == kNone) vertex = seams.vertices[corner];
    ASSERT_EQ(vertex, seams.vertices[corner]) << "a wedge of two vertices";
  }
  std::vector<uint8_t> met(mesh.vertex_count);
  for (Index corner = 0; corner < mesh.umbrellas.size(); ++corner) met[mesh.vertexOf(corner)] = 1;
  EXPECT_EQ(std::ranges::count(vertex_of, kNone), std::ranges::count(met, 0));
}

/// Numbers that tell corners apart which differ in either list.
std::vector<Index> refined(const std::vector<Index>& wholes, const std::vector<Index>& parts) {
  std::map<std::pair<Index, Index>, Index> number;
  std::vector<Index> result;
  for (size_t c = 0; c < wholes.size(); ++c) {
    result.push_back(number.try_emplace({wholes[c], parts[c]}, static_cast<Index>(number.size())).first->second);
  }
  return result;
}

PartNumbering numbered(const std::vector<Index>& wholes, Index whole_count, const std::vector<Index>& raw) {
  const Result<PartNumbering> numbering = numberParts(wholes, whole_count, raw, overlays::countOf(raw));
  EXPECT_TRUE(numbering.ok());
  return *numbering;
}

/// The wedges of a mesh that is not welded.
PartNumbering numbered(const Connectivity& mesh, const std::vector<Index>& raw) {
  return numbered(verticesOf(mesh), mesh.vertex_count, raw);
}

/// `raw_vertices`: empty when not welded.
void expectRoundTrip(const Connectivity& mesh, const std::vector<Index>& raw_vertices, const std::vector<Index>& raw,
                     uint64_t seed) {
  const bool welded = !raw_vertices.empty();
  PartNumbering vertices{verticesOf(mesh), std::vector<Index>(mesh.vertex_count)};
  if (welded) vertices = numbered(mesh, raw_vertices);
  const PartNumbering wedges = numbered(vertices.parts, static_cast<Index>(vertices.order.size()), raw);
  const Index count = static_cast<Index>(wedges.order.size());
  std::vector<Bytes> data = {Bytes(count), Bytes(count), values(count, 2, seed), values(count, 250, seed + 1)};
  std::vector<ValueView> views;
  for (const Bytes& bytes : data) views.push_back({bytes, 1});
  const std::vector<Index> parted = welded ? vertices.parts : std::vector<Index>();
  const Bytes bytes = encodeSeams(mesh, parted, wedges.parts, views);
  const Result<Seams> seams = decodeSeams(mesh, welded, bytes, static_cast<Index>(views.size()));
  ASSERT_TRUE(seams.ok()) << describe(seams.error());
  EXPECT_EQ(seams->vertices, parted);
  EXPECT_EQ(seams->vertex_count, vertices.order.size());
  EXPECT_EQ(seams->wedges, wedges.parts);
  EXPECT_EQ(seams->wedge_count, count);
  expectSound(mesh, *seams);
  for (size_t slot = 1; slot < data.size(); ++slot) {
    Bytes expected = seamsOf(mesh, wedges.parts, data[slot]);
    if (std::ranges::find(expected, 1) == expected.end()) expected.clear();
    EXPECT_EQ(seams->attribute_seams[slot], expected) << "slot " << slot;
  }
}

TEST(Wedges, AreVerticesWhereThereAreNoSeams) {
  for (const overlays::Base& base : overlays::bases()) {
    std::vector<Index> raw;
    for (Index c = 0; c < base.mesh.umbrellas.size(); ++c) raw.push_back(base.mesh.vertexOf(c) * 3 + 1);
    const PartNumbering numbering = numbered(base.mesh, raw);
    EXPECT_EQ(numbering.parts, verticesOf(base.mesh)) << base.name;
    EXPECT_EQ(numbering.order.size(), base.mesh.vertex_count);
  }
}

TEST(Wedges, RefusesWhatNoMeshHas) {
  const Connectivity mesh = encode(shapes::cube().mesh)->connectivity;
  const std::vector<Index> vertices = verticesOf(mesh);
  EXPECT_EQ(numberParts(vertices, 8, std::vector<Index>(23), 8).error(), Error::kCountMismatch);
  EXPECT_EQ(numberParts(vertices, 8, std::vector<Index>(24, 8), 8).error(), Error::kIndexOutOfRange);
  EXPECT_EQ(numberParts(vertices, 8, std::vector<Index>(24, 7), 8).error(), Error::kMalformed);
}

TEST(Seams, AnyWedgesComeBack) {
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Index colours : {0u, 1u, 2u, 5u}) {
      for (const Index patch : {1u, 3u, 20u}) {
        expectRoundTrip(base.mesh, {}, overlays::wedgesByColour(base.mesh, colours, patch, colours + patch), patch);
      }
    }
  }
}

TEST(Seams, AnyVerticesOfPointsComeBack) {
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Index colours : {0u, 1u, 2u, 5u}) {
      const std::vector<Index> vertices = overlays::wedgesByColour(base.mesh, colours, 4, colours);
      if (vertices.empty()) continue;
      expectRoundTrip(base.mesh, vertices, vertices, colours);
      for (const Index patch : {1u, 5u}) {
        const std::vector<Index> finer = overlays::wedgesByColour(base.mesh, 2, patch, colours + patch + 9);
        expectRoundTrip(base.mesh, vertices, refined(vertices, finer), patch);
      }
    }
  }
}

TEST(Seams, CostNextToNothingWhereThereAreNone) {
  const Connectivity mesh = encode(shapes::quadTorus(50, 50).mesh)->connectivity;
  std::vector<Index> wedges = verticesOf(mesh);
  wedges.back() = mesh.vertex_count;
  EXPECT_LE(encodeSeams(mesh, {}, numbered(mesh, wedges).parts, {}).size(), 20u);
}

/// A closed manifold mesh in its own order, without the connectivity coder.
Connectivity inItsOwnOrder(const Polygons& polygons) {
  Connectivity mesh;
  mesh.face_degrees = polygons.face_degrees;
  mesh.umbrellas = polygons.corners;
  mesh.umbrella_count = mesh.vertex_count = polygons.vertex_count;
  std::map<std::pair<Index, Index>, Index> edges;
  std::vector<Index> ends;
  Index first = 0;
  for (const Index degree : mesh.face_degrees) {
    for (Index i = 0; i < degree; ++i) {
      ends.push_back(mesh.umbrellas[first + (i + 1) % degree]);
      edges[{mesh.umbrellas[first + i], ends.back()}] = first + i;
    }
    first += degree;
  }
  for (Index corner = 0; corner < ends.size(); ++corner) {
    mesh.twins.push_back(edges.at({ends[corner], mesh.umbrellas[corner]}));
  }
  return mesh;
}

TEST(Seams, GoldenBytes) {
  const Connectivity cube = inItsOwnOrder(shapes::cube().mesh);
  const std::vector<Index> apart = numbered(cube, overlays::wedgesByColour(cube, 0, 1, 0)).parts;
  EXPECT_EQ(encodeSeams(cube, {}, apart, {}), (Bytes{0x80}));
  std::vector<Index> one_more = verticesOf(cube);
  one_more[0] = 8;
  const std::vector<Index> cut = numbered(cube, one_more).parts;
  const Bytes data = {0, 1, 0, 0, 0, 0, 0, 0, 0};
  const std::vector<ValueView> views(2, ValueView{data, 1});
  EXPECT_EQ(encodeSeams(cube, {}, cut, views), (Bytes{0x3E, 0xFC}));
  EXPECT_EQ(encodeSeams(cube, cut, cut, views), (Bytes{0x3E, 0xFC}));
  EXPECT_EQ(encodeSeams(cube, cut, apart, {}), (Bytes{0x3E, 0xF9, 0xEE, 0x63, 0xC0}));
}

void expectHarmless(const Connectivity& mesh, bool welded, std::span<const uint8_t> bytes) {
  const Bytes exact(bytes.begin(), bytes.end());
  const Result<Seams> seams = decodeSeams(mesh, welded, exact, 3);
  if (seams) expectSound(mesh, *seams);
}

/// All prefixes, and all single flipped bits.
void expectDamageHarmless(const Connectivity& mesh, bool welded, Bytes bytes) {
  for (size_t size = 0; size < bytes.size(); ++size) expectHarmless(mesh, welded, std::span(bytes).first(size));
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    expectHarmless(mesh, welded, bytes);
    expectHarmless(mesh, !welded, bytes);
    bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
  }
}

TEST(Seams, DamagedBytesAreHarmless) {
  for (const overlays::Base& base : overlays::bases()) {
    if (base.mesh.umbrellas.size() > 300) continue;
    const std::vector<Index> raw = overlays::wedgesByColour(base.mesh, 3, 2, 1);
    const PartNumbering coarse = numbered(base.mesh, raw);
    const PartNumbering fine = numbered(coarse.parts, static_cast<Index>(coarse.order.size()),
                                        refined(raw, overlays::wedgesByColour(base.mesh, 2, 3, 4)));
    const Bytes data = values(static_cast<Index>(fine.order.size()), 2, 7);
    const std::vector<ValueView> views(3, ValueView{data, 1});
    expectDamageHarmless(base.mesh, false, encodeSeams(base.mesh, {}, coarse.parts, views));
    if (!raw.empty()) expectDamageHarmless(base.mesh, true, encodeSeams(base.mesh, coarse.parts, fine.parts, views));
  }
}

TEST(Seams, BytesBehindTheEndAreRefused) {
  const Connectivity mesh = encode(shapes::cube().mesh)->connectivity;
  Bytes bytes = encodeSeams(mesh, {}, numbered(mesh, overlays::wedgesByColour(mesh, 0, 1, 0)).parts, {});
  bytes.resize(bytes.size() + 20, 0x55);
  EXPECT_EQ(decodeSeams(mesh, false, bytes, 1).error(), Error::kTrailingBytes);
}

}  // namespace
}  // namespace tutte
