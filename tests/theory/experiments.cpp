#include "tests/theory/experiments.h"

#include <algorithm>
#include <cmath>

#include "tests/shapes/shapes.h"
#include "tests/theory/measure.h"
#include "tests/theory/report.h"

namespace tutte::theory {
namespace {

using shapes::Shape;

std::vector<std::string> headWithProfiles(std::vector<std::string> head, const char* tail = nullptr) {
  head.insert(head.end(), kProfileNames.begin(), kProfileNames.end());
  if (tail) head.emplace_back(tail);
  return head;
}

std::string rate(size_t bytes, size_t count) { return formatted("%.3f", perUnit(bytes, count)); }

/// log2 of the number of rooted triangulations of the sphere without double edges (Tutte 1962).
double triangulationBits(Index vertices) {
  const double n = vertices - 2.0;
  return (std::log(2.0) + std::lgamma(4 * n - 2) - std::lgamma(n + 1) - std::lgamma(3 * n)) / std::log(2.0);
}

/// "3.443 (+6.1 %)"
std::string withExcess(double rate, double bound) {
  return formatted("%.3f (%+.1f %%)", rate, 100 * (rate / bound - 1));
}

Shape irregularQuads(Index vertices, uint64_t seed) {
  return shapes::subdivideToQuads(shapes::mergeFaces(shapes::randomTriangulation(vertices, seed), vertices / 2, seed));
}

struct Tessellated {
  Index base_vertices, features, deepest, width;
};

Shape tessellated(const Tessellated& kind) {
  return shapes::adaptiveTessellation(irregularQuads(kind.base_vertices, 1), kind.features, kind.deepest, kind.width,
                                      2);
}

}  // namespace

std::string regularMeshes() {
  Table table(headWithProfiles({"torus of", "faces"}));
  const auto add = [&](const char* name, const Shape& shape) {
    std::vector<std::string> row{name, withCommas(shape.mesh.face_degrees.size())};
    for (const Coded& coded : codeAll(shape.mesh, 0)) row.push_back(withCommas(coded.bytes));
    table.add(row);
  };
  constexpr std::array<std::array<Index, 2>, 4> kSizes{{{40, 25}, {100, 100}, {400, 250}, {1000, 1000}}};
  for (const auto [columns, rows] : kSizes) add("triangles", shapes::triangleTorus(columns / 2, rows));
  for (const auto [columns, rows] : kSizes) add("quads", shapes::quadTorus(columns, rows));
  for (const auto [columns, rows] : kSizes) add("hexagons", shapes::hexTorus(columns, rows));
  return "## Regular meshes cost a constant\n\n"
         "Bytes of the whole connectivity section; nothing is searched for (effort 0). `paper` and `fast` take a\n"
         "little per symbol, for the probabilities that their counters reach end at about 255/256.\n\n" +
         table.text();
}

std::string duals() {
  Table table(
      {"mesh", "edges", "mesh, bytes", "its dual", "difference", "not searched: mesh", "its dual", "difference"});
  const auto add = [&](const char* name, const Shape& mesh) {
    const Shape dual = shapes::dual(mesh);
    std::vector<std::string> row{name, withCommas(mesh.mesh.corners.size() / 2)};
    for (const int effort : {2, 0}) {
      const double one = static_cast<double>(code(mesh.mesh, Profile::kDefault, effort).bytes);
      const double other = static_cast<double>(code(dual.mesh, Profile::kDefault, effort).bytes);
      row.push_back(withCommas(static_cast<uint64_t>(one)));
      row.push_back(withCommas(static_cast<uint64_t>(other)));
      row.push_back(formatted("%+.2f %%", 100 * (other / one - 1)));
    }
    table.add(row);
  };
  add("uniform polyhedron", shapes::uniformPolyhedron(10'000, 1));
  add("uniform triangulation", shapes::uniformTriangulation(10'000, 1));
  add("adaptive tessellation", tessellated({250, 10, 3, 1}));
  add("adaptive tessellation", tessellated({1000, 100, 2, 2}));
  add("subdivided polygons", shapes::subdivideToQuads(irregularQuads(700, 3)));
  return "## A mesh and its dual cost the same\n\n"
         "Profile `default`. The encoder may walk over the dual instead, so both have the same choice; which is the\n"
         "better one, and where to begin, it finds by search (effort 2 here). Not searched (effort 0), each is\n"
         "walked over as it is, and valences are predicted better than degrees.\n\n" +
         table.text();
}

std::string uniformTriangulations() {
  Table table(headWithProfiles({"vertices", "log2 of their number, b/v"}, "splits of small, b/v"));
  for (const Index vertices : {1000u, 10'000u, 100'000u, 1'000'000u}) {
    const Shape shape = shapes::uniformTriangulation(vertices, 1);
    const double bound = triangulationBits(vertices) / vertices;
    std::vector<std::string> row{withCommas(vertices), formatted("%.3f", bound)};
    const AllCoded all = codeAll(shape.mesh, 0);
    for (const Coded& coded : all) row.push_back(withExcess(perUnit(coded.bytes, vertices), bound));
    row.push_back(formatted("%.3f (%s)", all.back().split_bits / vertices, withCommas(all.back().splits).c_str()));
    table.add(row);
  }
  return "## Uniformly random triangulations\n\n"
         "Every rooted triangulation of the sphere of that size is equally likely (Poulalhon and Schaeffer 2006), so\n"
         "no coder takes less than the binary logarithm of their number on average, which tends to Tutte's\n"
         "log2(256/27) = 3.245 bits per vertex (Tutte 1962). In parentheses the excess; for splits, their number.\n\n" +
         table.text();
}

std::string uniformPolyhedra() {
  Table table(headWithProfiles({"edges", "vertices", "faces"}, "splits of small, b/e"));
  for (const Index edges : {1000u, 10'000u, 100'000u, 1'000'000u}) {
    const Shape shape = shapes::uniformPolyhedron(edges, 1);
    std::vector<std::string> row{withCommas(edges), withCommas(shape.mesh.vertex_count),
                                 withCommas(shape.mesh.face_degrees.size())};
    const AllCoded all = codeAll(shape.mesh, 0);
    for (const Coded& coded : all) row.push_back(withExcess(perUnit(coded.bytes, edges), 2));
    row.push_back(formatted("%.3f (%s)", all.back().split_bits / edges, withCommas(all.back().splits).c_str()));
    table.add(row);
  }
  return "## Uniformly random polyhedra\n\n"
         "Every rooted 3-connected planar map with that many edges is equally likely (Fusy, Poulalhon and Schaeffer\n"
         "2008); their number grows as 4^edges: 2 bits per edge (Tutte 1963), less 2.5 log2(edges) in all. Bits per\n"
         "edge, and in parentheses the excess over 2; for splits, their number.\n\n" +
         table.text();
}

std::string semiRegularMeshes() {
  struct Model {
    const char* name;
    Index base_vertices, times;
    double paper;
  };
  Table table(headWithProfiles({"as large as", "vertices", "base", "paper's figure"}));
  for (const Model& model :
       {Model{"fandisk", 73, 4, 0.043}, Model{"rabbit", 107, 5, 0.011}, Model{"dinosaur", 128, 5, 0.013},
        Model{"horse", 180, 5, 0.010}, Model{"venus", 196, 5, 0.009}, Model{"feline", 254, 5, 0.012},
        Model{"skull", 4, 8, 0.001}}) {
    const Shape base = shapes::randomTriangulation(model.base_vertices, 1);
    const Shape shape = shapes::subdivideTriangles(base, model.times);
    std::vector<std::string> row{model.name, withCommas(shape.mesh.vertex_count),
                                 formatted("%u, %u times", model.base_vertices, model.times),
                                 formatted("%.3f", model.paper)};
    for (const Coded& coded : codeAll(shape.mesh, 0)) {
      row.push_back(formatted("%.4f (%zu B)", perUnit(coded.bytes, shape.mesh.vertex_count), coded.bytes));
    }
    table.add(row);
  }
  return "## Semi-regular triangle meshes\n\n"
         "The paper's table 4 has remeshed models. The number of their vertices tells how many the base meshes had;\n"
         "ours are random triangulations of that size, subdivided as often. Bits per vertex.\n\n" +
         table.text();
}

std::string adaptiveTessellations() {
  Table table(
      headWithProfiles({"base", "features", "levels, width", "vertices", "triangles among faces"}, "splits of small"));
  for (const Tessellated kind :
       {Tessellated{560, 56, 2, 2}, Tessellated{160, 16, 3, 2}, Tessellated{1000, 30, 3, 1},
        Tessellated{1110, 111, 2, 2}, Tessellated{310, 31, 3, 2}, Tessellated{2000, 60, 3, 1}}) {
    const Shape shape = tessellated(kind);
    const auto& degrees = shape.mesh.face_degrees;
    const double triangles = static_cast<double>(std::count(degrees.begin(), degrees.end(), 3u));
    std::vector<std::string> row{formatted("%u", kind.base_vertices), formatted("%u", kind.features),
                                 formatted("%u, %u", kind.deepest, kind.width), withCommas(shape.mesh.vertex_count),
                                 formatted("%.0f %%", 100 * triangles / static_cast<double>(degrees.size()))};
    const AllCoded all = codeAll(shape.mesh, 1);
    for (const Coded& coded : all) row.push_back(rate(coded.bytes, shape.mesh.vertex_count));
    row.push_back(withCommas(all.back().splits));
    table.add(row);
  }
  return "## Adaptively tessellated Catmull-Clark surfaces\n\n"
         "Quads with conforming triangles between levels, as in the paper's table 5, where models of 10 and 20\n"
         "thousand vertices take 1.71 to 1.92 bits per vertex. Ours: a random triangulation of the sphere with merged\n"
         "faces as base, one step of subdivision, then grids that are finest in some random quads. Bits per vertex,\n"
         "effort 1.\n\n" +
         table.text();
}

}  // namespace tutte::theory
