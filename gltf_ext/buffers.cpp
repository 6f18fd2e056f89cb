#include "gltf_ext/buffers.h"

#include <algorithm>
#include <functional>
#include <map>

#include "gltf_ext/accessors.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/references.h"

namespace tutte {
namespace {

constexpr uint64_t kAlignment = 8;

/// Calls `visit` with everything that names bytes of a buffer: buffer views, and the objects of compression extensions
/// on them, which all have the properties buffer, byteOffset and byteLength.
void forEachRange(Json& json, const std::function<void(Json& range, size_t view)>& visit) {
  for (size_t i = 0; i < countOf(json, "bufferViews"); ++i) {
    Json& view = json["bufferViews"][i];
    if (!view.is_object()) continue;
    visit(view, i);
    if (!objectMember(view, "extensions")) continue;
    for (Json& extension : view["extensions"]) {
      if (member(extension, "buffer")) visit(extension, i);
    }
  }
}

/// A range of bytes of one old buffer, and where it goes.
struct Piece {
  uint64_t begin = 0;
  uint64_t end = 0;
  uint64_t moved = 0;
};

class Merger {
 public:
  explicit Merger(Asset& asset) : asset_(asset), pieces_(asset.buffers.size()), used_(asset.buffers.size()) {}

  Outcome<Done> run() {
    const auto collected = collect();
    if (!collected) return collected;
    for (size_t i = 0; i < pieces_.size(); ++i) join(pieces_[i]);
    place();
    rewriteRanges();
    rewriteBuffers();
    return Done{};
  }

 private:
  bool merges(uint64_t buffer) const {
    return !asset_.buffers[buffer].empty() && !isFallbackBuffer(asset_.json["buffers"][buffer]);
  }

  Outcome<Done> collect() {
    Outcome<Done> result = Done{};
    forEachRange(asset_.json, [&](Json& range, size_t view) {
      const std::string where = pointerTo("bufferViews", view);
      const auto buffer = integerMember(range, "buffer", where);
      const auto offset = integerMember(range, "byteOffset", 0, where);
      const auto length = integerMember(range, "byteLength", where);
      if (!buffer || !offset || !length || *buffer >= pieces_.size()) {
        result = invalid(where, "this does not describe a range of a buffer");
        return;
      }
      used_[*buffer] = true;
      if (!merges(*buffer)) return;
      const uint64_t size = asset_.buffers[*buffer].size();
      if (*offset > size || *length > size - *offset) {
        result = invalid(where, "the range does not lie inside its buffer");
        return;
      }
      pieces_[*buffer].push_back({*offset, *offset + *length, 0});
    });
    return result;
  }

  /// Sorts, and joins pieces that touch or overlap.
  static void join(std::vector<Piece>& pieces) {
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
    std::vector<Piece> joined;
    for (const Piece& piece : pieces) {
      if (!joined.empty() && piece.begin <= joined.back().end) {
        joined.back().end = std::max(joined.back().end, piece.end);
      } else {
        joined.push_back(piece);
      }
    }
    pieces = std::move(joined);
  }

  void place() {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      for (Piece& piece : pieces_[i]) {
        piece.moved = (merged_.size() + 3) / 4 * 4;
        while (piece.moved % kAlignment != piece.begin % kAlignment) ++piece.moved;
        merged_.resize(piece.moved);
        const Bytes& bytes = asset_.buffers[i];
        merged_.insert(merged_.end(), bytes.begin() + piece.begin, bytes.begin() + piece.end);
      }
    }
  }

  void rewriteRanges() {
    numberBuffers();
    forEachRange(asset_.json, [&](Json& range, size_t) {
      const uint64_t buffer = *asInteger(range["buffer"]);
      range["buffer"] = numbers_[buffer];
      if (!merges(buffer)) return;
      const Json* old = member(range, "byteOffset");
      const uint64_t offset = old ? *asInteger(*old) : 0;
      const auto& pieces = pieces_[buffer];
      auto piece = std::upper_bound(pieces.begin(), pieces.end(), offset,
                                    [](uint64_t value, const Piece& p) { return value < p.begin; });
      range["byteOffset"] = offset - std::prev(piece)->begin + std::prev(piece)->moved;
    });
  }

  void numberBuffers() {
    numbers_.resize(pieces_.size());
    uint64_t next = merged_.empty() ? 0 : 1;
    for (size_t i = 0; i < numbers_.size(); ++i) {
      const bool stays = !merges(i) && used_[i];
      if (stays) kept_.push_back(i);
      numbers_[i] = stays ? next++ : 0;
    }
  }

  void rewriteBuffers() {
    Json buffers = Json::array();
    std::vector<Bytes> bytes;
    if (!merged_.empty()) {
      merged_.resize((merged_.size() + 3) / 4 * 4);
      buffers.push_back(mergedBuffer());
      bytes.push_back(std::move(merged_));
    }
    for (const size_t i : kept_) {
      buffers.push_back(std::move(asset_.json["buffers"][i]));
      bytes.push_back(std::move(asset_.buffers[i]));
    }
    asset_.json["buffers"] = std::move(buffers);
    if (bytes.empty()) asset_.json.erase("buffers");
    asset_.buffers = std::move(bytes);
  }

  /// Name and extras of the first of the merged buffers survive.
  Json mergedBuffer() const {
    Json result = Json::object();
    for (size_t i = 0; i < pieces_.size(); ++i) {
      if (!merges(i) || pieces_[i].empty()) continue;
      result = asset_.json["buffers"][i];
      break;
    }
    result.erase("uri");
    result["byteLength"] = merged_.size();
    return result;
  }

  Asset& asset_;
  std::vector<std::vector<Piece>> pieces_;
  std::vector<bool> used_;
  std::vector<uint64_t> numbers_;
  std::vector<size_t> kept_;
  Bytes merged_;
};

/// The bytes of a view that its accessors use.
struct Hull {
  uint64_t begin = ~uint64_t{0};
  uint64_t end = 0;
  size_t accessors = 0;
};

std::map<uint64_t, Hull> hullsOf(const Asset& asset, const std::set<uint64_t>& views) {
  std::map<uint64_t, Hull> hulls;
  for (size_t i = 0; i < countOf(asset.json, "accessors"); ++i) {
    const Json& accessor = asset.json["accessors"][i];
    const auto view = integerMember(accessor, "bufferView", "");
    const auto shape = accessorShape(asset.json, i);
    const auto offset = integerMember(accessor, "byteOffset", 0, "");
    if (!view || !views.count(*view) || !shape || !offset || *offset > kMaxJsonInteger / 2) continue;
    const auto used = elementOf(asset.json, "bufferViews", *view);
    if (!used) continue;
    const auto stride = integerMember(**used, "byteStride", shape->elementBytes(), "");
    const uint64_t step = stride ? std::min<uint64_t>(*stride, 4096) : shape->elementBytes();
    Hull& hull = hulls[*view];
    ++hull.accessors;
    hull.begin = std::min(hull.begin, *offset);
    hull.end = std::max(hull.end, *offset + step * (shape->count - 1) + shape->elementBytes());
  }
  return hulls;
}

}  // namespace

void trimViews(Asset& asset, const std::set<uint64_t>& views) {
  const std::vector<size_t> uses = viewUses(asset.json);
  if (!suspectsOf(asset.json).numbers.empty()) return;
  std::map<uint64_t, uint64_t> shifts;
  for (const auto& [index, hull] : hullsOf(asset, views)) {
    if (index >= uses.size() || hull.accessors != uses[index]) continue;
    Json& view = asset.json["bufferViews"][index];
    const auto length = integerMember(view, "byteLength", ""), offset = integerMember(view, "byteOffset", 0, "");
    if (!length || !offset || hull.end > *length || member(view, "extensions")) continue;
    const uint64_t begin = hull.begin / kAlignment * kAlignment;
    view["byteOffset"] = *offset + begin;
    view["byteLength"] = hull.end - begin;
    shifts[index] = begin;
  }
  for (size_t i = 0; i < countOf(asset.json, "accessors"); ++i) {
    Json& accessor = asset.json["accessors"][i];
    const auto view = integerMember(accessor, "bufferView", ""), offset = integerMember(accessor, "byteOffset", 0, "");
    if (!view || !offset) continue;
    const auto shift = shifts.find(*view);
    if (shift != shifts.end() && shift->second > 0) accessor["byteOffset"] = *offset - shift->second;
  }
}

Outcome<Done> mergeBuffers(Asset& asset) {
  for (size_t i = 0; i < countOf(asset.json, "buffers"); ++i) {
    const auto buffer = elementOf(asset.json, "buffers", i);
    if (!buffer) return buffer.error();
  }
  asset.buffers.resize(countOf(asset.json, "buffers"));
  return Merger(asset).run();
}

}  // namespace tutte
