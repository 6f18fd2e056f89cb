// Uniformly random planar meshes: of all rooted ones of a size, each is equally likely.
//
// Both begin with a random plane tree whose nodes carry stems, half-edges without an end. On a walk around the tree a
// stem that is followed by enough sides of edges is bent to their end, which closes a face; the stems that remain go
// to a few outer vertices.
// - Triangulations: D. Poulalhon, G. Schaeffer, Optimal coding and sampling of triangulations, Algorithmica 46 (2006).
// - 3-connected maps, as quadrangulations without separating 4-cycles: E. Fusy, D. Poulalhon, G. Schaeffer,
//   Dissections, orientations, and trees with applications to optimal mesh encoding and random sampling, ACM
//   Transactions on Algorithms 4 (2008).

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "tests/shapes/shapes.h"

namespace tutte::shapes {
namespace {

/// A piece of the walk around the outer face: the side of an edge, or a stem.
struct Piece {
  Index from = kNone;
  Index to = kNone;  ///< kNone: a stem

  bool isStem() const { return to == kNone; }
};

using Contour = std::vector<Piece>;
using Word = std::vector<int8_t>;

/// `ups` steps of `rise` and the steps down that lead from `start` to 0, in random order, but above 0 until the end.
/// All such words are equally likely: of the rotations of a word, `start` are good, and one of them is chosen.
Word randomWord(Index ups, int rise, int start, Random& random) {
  Word word(size_t{ups} * static_cast<size_t>(rise + 1) + static_cast<size_t>(start), -1);
  std::fill_n(word.begin(), ups, static_cast<int8_t>(rise));
  for (size_t i = word.size(); i > 1; --i) std::swap(word[i - 1], word[random.below(static_cast<Index>(i))]);
  int64_t height = 0, least = 0;
  for (const int8_t step : word) least = std::min(least, height += step);
  // A good rotation begins where the word first falls to one of its `start` least heights.
  const int64_t target = least + static_cast<int64_t>(random.below(static_cast<Index>(start)));
  height = 0;
  size_t begin = 0;
  while (height > target) height += word[begin++];
  std::rotate(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(begin % word.size()), word.end());
  return word;
}

/// The walk around a tree, given by a word: a step up opens a node, a step down ends one of its parts.
class TreeWalk {
 public:
  /// Nodes have `parts` parts; behind each but the last stands a stem, if `stems_between`.
  TreeWalk(int parts, bool stems_between) : parts_(parts), stems_between_(stems_between) {}

  Contour contour(const Word& word, int root_parts) {
    open(root_parts);
    add(current(), kNone);  // where the tree is entered
    for (const int8_t step : word) step > 0 ? descend() : endPart();
    return std::move(contour_);
  }

  Index nodes() const { return nodes_; }

 private:
  struct Node {
    Index number;
    int parts_left;
  };

  Index current() const { return path_.back().number; }
  void open(int parts) { path_.push_back({nodes_++, parts}); }
  void add(Index from, Index to) { contour_.push_back({from, to}); }

  void descend() {
    add(current(), nodes_);
    // Between stems, any number of children; otherwise a child is a part.
    if (!stems_between_) --path_.back().parts_left;
    open(parts_);
  }

  void endPart() {
    --path_.back().parts_left;
    if (!stems_between_ || path_.back().parts_left > 0) add(current(), kNone);
    while (path_.size() > 1 && path_.back().parts_left == 0) {
      const Index child = current();
      path_.pop_back();
      add(child, current());
      if (stems_between_) break;
    }
  }

  int parts_;
  bool stems_between_;
  Index nodes_ = 0;
  std::vector<Node> path_;
  Contour contour_;
};

/// Bends stems until none is followed by `sides` sides. What remains begins with a stem.
Contour closeStems(const Contour& walk, size_t sides, Shape& shape) {
  Contour rest;
  const auto add = [&](Piece piece) {
    rest.push_back(piece);
    while (rest.size() > sides && rest[rest.size() - 1 - sides].isStem() &&
           std::none_of(rest.end() - static_cast<std::ptrdiff_t>(sides), rest.end(),
                        [](const Piece& p) { return p.isStem(); })) {
      const Index from = rest[rest.size() - 1 - sides].from, to = rest.back().to;
      std::vector<Index> face{from};
      for (size_t i = rest.size() - sides; i < rest.size(); ++i) face.push_back(rest[i].to);
      shape.addFace(face);
      rest.resize(rest.size() - 1 - sides);
      rest.push_back({from, to});
    }
  };
  for (const Piece& piece : walk) add(piece);
  while (!rest.front().isStem()) {  // the walk is a circle
    const auto stem = std::find_if(rest.begin(), rest.end(), [](const Piece& p) { return p.isStem(); });
    const Contour front(rest.begin(), stem);
    rest.erase(rest.begin(), stem);
    for (const Piece& piece : front) add(piece);
  }
  return rest;
}

/// Ties the remaining stems to `count` new vertices around everything, so that all faces but the outer one get degree
/// `degree`. Returns the first of these vertices.
Index tieToFrame(const Contour& rest, Index degree, Index count, Shape& shape) {
  const Index frame = shape.mesh.vertex_count;
  shape.mesh.vertex_count += count;
  Index at = 0;
  for (size_t i = 0; i < rest.size();) {
    std::vector<Index> face{rest[i].from};
    for (++i; i < rest.size() && !rest[i].isStem(); ++i) face.push_back(rest[i].to);
    const Index steps = degree - 1 - static_cast<Index>(face.size());
    for (Index k = steps + 1; k-- > 0;) face.push_back(frame + (at + k) % count);
    at += steps;
    shape.addFace(face);
  }
  return frame;
}

uint64_t edgeKey(Index a, Index b) { return uint64_t{a} << 32 | b; }

/// True when a path of three edges leads from frame[0] to frame[3] besides the frame's own two.
bool hasShortcut(const Shape& shape, const std::array<Index, 6>& frame) {
  std::unordered_set<uint64_t> edges;
  std::vector<Index> from, to;
  for (size_t first = 0; first < shape.mesh.corners.size(); first += 4) {
    for (size_t i = 0; i < 4; ++i) {
      const Index a = shape.mesh.corners[first + i], b = shape.mesh.corners[first + (i + 1) % 4];
      edges.insert(edgeKey(a, b));
      edges.insert(edgeKey(b, a));
      if (a == frame[0]) from.push_back(b);
      if (b == frame[0]) from.push_back(a);
      if (a == frame[3]) to.push_back(b);
      if (b == frame[3]) to.push_back(a);
    }
  }
  if (edges.count(edgeKey(frame[0], frame[3]))) return true;
  for (const Index a : from) {
    for (const Index b : to) {
      const bool own = (a == frame[1] && b == frame[2]) || (a == frame[5] && b == frame[4]);
      if (!own && edges.count(edgeKey(a, b))) return true;
    }
  }
  return false;
}

/// The map whose vertices are one class of a quadrangulation's vertices, that of `some_vertex`, whose faces are the
/// other, and whose edges are its faces.
Shape mapOf(const Shape& quads, Index some_vertex) {
  const Polygons& mesh = quads.mesh;
  std::unordered_map<uint64_t, Index> next;  // around (face, vertex): the next vertex
  std::vector<int8_t> is_face(mesh.vertex_count, -1);
  std::vector<std::vector<Index>> quads_at(mesh.vertex_count);
  for (Index c = 0; c < mesh.corners.size(); ++c) quads_at[mesh.corners[c]].push_back(c / 4);
  std::vector<Index> pending{some_vertex};
  is_face[some_vertex] = 0;
  while (!pending.empty()) {
    const Index vertex = pending.back();
    pending.pop_back();
    for (const Index quad : quads_at[vertex]) {
      const Index* corner = &mesh.corners[size_t{quad} * 4];
      const auto place = static_cast<size_t>(std::find(corner, corner + 4, vertex) - corner);
      for (const size_t neighbour : {(place + 1) % 4, (place + 3) % 4}) {
        if (is_face[corner[neighbour]] >= 0) continue;
        is_face[corner[neighbour]] = static_cast<int8_t>(1 - is_face[vertex]);
        pending.push_back(corner[neighbour]);
      }
      if (is_face[vertex] == 1) next[edgeKey(vertex, corner[(place + 3) % 4])] = corner[(place + 1) % 4];
    }
  }
  Shape map;
  std::vector<Index> names(mesh.vertex_count, kNone);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    if (is_face[v] == 0) names[v] = map.addVertex();
  }
  for (Index f = 0; f < mesh.vertex_count; ++f) {
    if (is_face[f] != 1) continue;
    const Index* corner = &mesh.corners[size_t{quads_at[f].front()} * 4];
    const auto place = static_cast<size_t>(std::find(corner, corner + 4, f) - corner);
    const Index first = corner[(place + 1) % 4];
    std::vector<Index> face;
    Index vertex = first;
    do {
      face.push_back(names[vertex]);
      vertex = next.at(edgeKey(f, vertex));
    } while (vertex != first);
    map.addFace(face);
  }
  return map;
}

}  // namespace

Shape uniformTriangulation(Index vertices, uint64_t seed) {
  Random random(seed);
  // Every node has two stems, that is, three parts with children; the root, which is entered at a stem, two.
  const Word word = randomWord(vertices - 3, 3, 2, random);
  TreeWalk walk(3, true);
  const Contour contour = walk.contour(word, 2);
  Shape shape;
  shape.mesh.vertex_count = walk.nodes();
  tieToFrame(closeStems(contour, 2, shape), 3, 2, shape);
  return shape;
}

Shape uniformPolyhedron(Index edges, uint64_t seed) {
  for (Random random(seed);;) {
    // Every node has three neighbours or stems, but for the one where it is entered, two.
    const Word word = randomWord(edges - 5, 1, 2, random);
    TreeWalk walk(2, false);
    const Contour contour = walk.contour(word, 2);
    Shape quads;
    quads.mesh.vertex_count = walk.nodes();
    const Index first = tieToFrame(closeStems(contour, 3, quads), 4, 6, quads);
    const Index turn = random.below(6);
    std::array<Index, 6> frame;
    for (Index i = 0; i < 6; ++i) frame[i] = first + (i + turn) % 6;
    if (hasShortcut(quads, frame)) continue;  // about two of three have one: 1 - 2^8 / 3^6
    quads.addFace({frame[0], frame[1], frame[2], frame[3]});
    quads.addFace({frame[3], frame[4], frame[5], frame[0]});
    return mapOf(quads, frame[0]);
  }
}

}  // namespace tutte::shapes
