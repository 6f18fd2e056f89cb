#pragma once
// Meshes with one site per vertex, for tests of values.

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "codec/encode.h"
#include "codec/value_graph.h"

namespace tutte {

/// An encoded mesh and the sites of its vertices.
struct VertexSites {
  explicit VertexSites(const Polygons& mesh) : VertexSites(encodedOf(mesh)) {}
  VertexSites(const VertexSites&) = delete;

  const Encoded encoded;
  const std::vector<Index> sites;
  const ValueGraph graph;
  const std::vector<Index>& vertex_order;

 private:
  explicit VertexSites(Encoded coded)
      : encoded(std::move(coded)),
        sites(verticesOf(encoded.connectivity)),
        graph(encoded.connectivity, sites, encoded.connectivity.vertex_count),
        vertex_order(encoded.vertex_order) {}

  static Encoded encodedOf(const Polygons& mesh) {
    Result<Encoded> encoded = encode(mesh);
    EXPECT_TRUE(encoded);
    return encoded ? *std::move(encoded) : Encoded();
  }

  static std::vector<Index> verticesOf(const Connectivity& mesh) {
    std::vector<Index> vertices;
    for (Index corner = 0; corner < mesh.umbrellas.size(); ++corner) vertices.push_back(mesh.vertexOf(corner));
    return vertices;
  }
};

}  // namespace tutte
