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
  std::vector<uint8_t> met(mesh.vertex_count);
  for (Index corner = 0; corner < mesh.umbrellas.size(); ++corner) met[mesh.vertexOf(corner)] = 1;
  EXPECT_EQ(std::ranges::count(vertex_of, kNone), std::ranges::count(met, 0));
}

void expectRoundTrip(const Connectivity& mesh, const std::vector<Index>& raw, uint64_t seed) {
  const Result<WedgeNumbering> numbering = numberWedges(mesh, raw, overlays::countOf(raw));
  ASSERT_TRUE(numbering.ok());
  const Index count = static_cast<Index>(numbering->order.size());
  std::vector<Bytes> data = {Bytes(count), Bytes(count), values(count, 2, seed), values(count, 250, seed + 1)};
  std::vector<ValueView> views;
  for (const Bytes& bytes : data) views.push_back({bytes, 1});
  const Bytes bytes = encodeSeams(mesh, numbering->wedges, views);
  const Result<Seams> seams = decodeSeams(mesh, bytes, static_cast<Index>(views.size()));
  ASSERT_TRUE(seams.ok()) << describe(seams.error());
  EXPECT_EQ(seams->wedges, numbering->wedges);
  EXPECT_EQ(seams->wedge_count, count);
  expectSound(mesh, *seams);
  for (size_t slot = 1; slot < data.size(); ++slot) {
    Bytes expected = seamsOf(mesh, numbering->wedges, data[slot]);
    if (std::ranges::find(expected, 1) == expected.end()) expected.clear();
    EXPECT_EQ(seams->attribute_seams[slot], expected) << "slot " << slot;
  }
}

TEST(Wedges, AreVerticesWhereThereAreNoSeams) {
  for (const overlays::Base& base : overlays::bases()) {
    std::vector<Index> raw;
    for (Index c = 0; c < base.mesh.umbrellas.size(); ++c) raw.push_back(base.mesh.vertexOf(c) * 3 + 1);
    const Result<WedgeNumbering> numbering = numberWedges(base.mesh, raw, base.mesh.vertex_count * 3);
    ASSERT_TRUE(numbering.ok());
    EXPECT_TRUE(wedgesAreVertices(base.mesh, numbering->wedges)) << base.name;
    EXPECT_EQ(numbering->wedges, withoutSeams(base.mesh, 0).wedges);
    EXPECT_EQ(numbering->order.size(), base.mesh.vertex_count);
  }
}

TEST(Wedges, RefusesWhatNoMeshHas) {
  const Connectivity mesh = encode(shapes::cube().mesh)->connectivity;
  EXPECT_EQ(numberWedges(mesh, std::vector<Index>(23), 8).error(), Error::kCountMismatch);
  EXPECT_EQ(numberWedges(mesh, std::vector<Index>(24, 8), 8).error(), Error::kIndexOutOfRange);
  EXPECT_EQ(numberWedges(mesh, std::vector<Index>(24, 7), 8).error(), Error::kMalformed);
}

TEST(Seams, AnyWedgesComeBack) {
  for (const overlays::Base& base : overlays::bases()) {
    SCOPED_TRACE(base.name);
    for (const Index colours : {0u, 1u, 2u, 5u}) {
      for (const Index patch : {1u, 3u, 20u}) {
        expectRoundTrip(base.mesh, overlays::wedgesByColour(base.mesh, colours, patch, colours + patch), patch);
      }
    }
  }
}

TEST(Seams, CostNextToNothingWhereThereAreNone) {
  const Connectivity mesh = encode(shapes::quadTorus(50, 50).mesh)->connectivity;
  std::vector<Index> wedges = withoutSeams(mesh, 0).wedges;
  wedges.back() = mesh.vertex_count;
  const Result<WedgeNumbering> numbering = numberWedges(mesh, wedges, mesh.vertex_count + 1);
  ASSERT_TRUE(numbering.ok());
  EXPECT_LE(encodeSeams(mesh, numbering->wedges, {}).size(), 20u);
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
  const Result<WedgeNumbering> apart = numberWedges(cube, overlays::wedgesByColour(cube, 0, 1, 0), 24);
  EXPECT_EQ(encodeSeams(cube, apart->wedges, {}), (Bytes{0x00, 0x00, 0x30}));
  std::vector<Index> one_more = withoutSeams(cube, 0).wedges;
  one_more[0] = 8;
  const Result<WedgeNumbering> cut = numberWedges(cube, one_more, 9);
  const Bytes data = {0, 1, 0, 0, 0, 0, 0, 0, 0};
  const std::vector<ValueView> views(2, ValueView{data, 1});
  EXPECT_EQ(encodeSeams(cube, cut->wedges, views), (Bytes{0x0E, 0x50}));
}

void expectHarmless(const Connectivity& mesh, std::span<const uint8_t> bytes) {
  const Bytes exact(bytes.begin(), bytes.end());
  const Result<Seams> seams = decodeSeams(mesh, exact, 3);
  if (seams) expectSound(mesh, *seams);
}

TEST(Seams, DamagedBytesAreHarmless) {
  for (const overlays::Base& base : overlays::bases()) {
    if (base.mesh.umbrellas.size() > 300) continue;
    const std::vector<Index> raw = overlays::wedgesByColour(base.mesh, 3, 2, 1);
    const Result<WedgeNumbering> numbering = numberWedges(base.mesh, raw, overlays::countOf(raw));
    ASSERT_TRUE(numbering.ok());
    const Bytes data = values(static_cast<Index>(numbering->order.size()), 2, 7);
    const std::vector<ValueView> views(3, ValueView{data, 1});
    Bytes bytes = encodeSeams(base.mesh, numbering->wedges, views);
    for (size_t size = 0; size < bytes.size(); ++size) expectHarmless(base.mesh, std::span(bytes).first(size));
    for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
      expectHarmless(base.mesh, bytes);
      bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    }
  }
}

TEST(Seams, BytesBehindTheEndAreRefused) {
  const Connectivity mesh = encode(shapes::cube().mesh)->connectivity;
  const Result<WedgeNumbering> numbering = numberWedges(mesh, overlays::wedgesByColour(mesh, 0, 1, 0), 24);
  Bytes bytes = encodeSeams(mesh, numbering->wedges, {});
  bytes.resize(bytes.size() + 20, 0x55);
  EXPECT_EQ(decodeSeams(mesh, bytes, 1).error(), Error::kTrailingBytes);
}

}  // namespace
}  // namespace tutte
