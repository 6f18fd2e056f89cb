// The rules between the extension's objects and the rest of the asset.

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "gltf_ext/extension.h"

namespace tutte {
namespace {

/// Collects what is wrong.
class Rules {
 public:
  explicit Rules(const Asset& asset) : asset_(asset), json_(asset.json) {}

  std::vector<Failure> check() {
    for (size_t i = 0; i < countOf(json_, "bufferViews"); ++i) {
      const auto view = compressedViewAt(json_, i);
      if (!view) {
        failures_.push_back(view.error());
      } else if (*view) {
        ++views_;
        checkView(i, **view);
      }
    }
    checkOverlaps();
    for (size_t i = 0; i < countOf(json_, "buffers"); ++i) checkBuffer(i);
    checkUsers();
    checkLists();
    return std::move(failures_);
  }

 private:
  void fail(std::string where, std::string what) { failures_.push_back(invalid(std::move(where), std::move(what))); }

  /// A required integer, or 0 and an entry in the list.
  uint64_t integer(const Json& object, const char* key, const std::string& where) {
    const auto value = integerMember(object, key, where);
    if (!value) failures_.push_back(value.error());
    return value ? *value : 0;
  }

  void checkView(size_t index, const CompressedView& view) {
    const std::string where = pointerTo("bufferViews", index);
    const std::string extension = where + "/extensions/" + kExtensionName;
    checkPayload(view.payload, extension);
    payloads_.insert(view.payload);
    if (!arrays_.insert({view.payload, view.mode, view.attribute}).second) {
      fail(extension, "another buffer view has the same payload, mode and attribute");
    }
    checkParent(json_["bufferViews"][index], view, where);
  }

  void checkPayload(const PayloadRange& payload, const std::string& where) {
    if (payload.buffer >= asset_.buffers.size()) return fail(where + "/buffer", "there is no such buffer");
    const Bytes& bytes = asset_.buffers[payload.buffer];
    if (payload.byte_offset > bytes.size() || payload.byte_length > bytes.size() - payload.byte_offset) {
      fail(where, "the payload does not lie inside its buffer");
    }
    if (isFallbackBuffer(json_["buffers"][payload.buffer])) {
      fail(where + "/buffer", "a payload cannot lie in a fallback buffer");
    }
  }

  void checkParent(const Json& parent, const CompressedView& view, const std::string& where) {
    const uint64_t length = integer(parent, "byteLength", where);
    // Both factors are below 2^33, so that the product cannot wrap.
    if (length != view.count * view.byte_stride) fail(where + "/byteLength", "this is not count times byteStride");
    const Json* stride = member(parent, "byteStride");
    if (stride && asInteger(*stride) != view.byte_stride) {
      fail(where + "/byteStride", "the view and its extension have different strides");
    }
    checkPlace(parent, length, where);
  }

  void checkPlace(const Json& parent, uint64_t length, const std::string& where) {
    const uint64_t buffer = integer(parent, "buffer", where);
    const auto offset = integerMember(parent, "byteOffset", 0, where);
    if (!offset) return failures_.push_back(offset.error());
    const auto target = elementOf(json_, "buffers", buffer);
    if (!target) return failures_.push_back(target.error());
    const uint64_t available = integer(**target, "byteLength", pointerTo("buffers", buffer));
    if (*offset > available || length > available - *offset) fail(where, "the view does not lie inside its buffer");
    if (*offset % 4 != 0) fail(where + "/byteOffset", "the offset of a compressed view is a multiple of 4");
    places_[buffer].push_back({*offset, length});
    if (!extensionOf(**target, kExtensionName)) {
      fail(where + "/buffer", "the view's buffer is not marked as a fallback of this extension");
    }
  }

  void checkOverlaps() {
    const PayloadRange* previous = nullptr;
    for (const PayloadRange& payload : payloads_) {
      if (previous && previous->buffer == payload.buffer &&
          previous->byte_length > payload.byte_offset - previous->byte_offset) {
        fail(pointerTo("buffers", payload.buffer), "two payloads overlap");
      }
      previous = &payload;
    }
    for (auto& [buffer, ranges] : places_) {
      std::sort(ranges.begin(), ranges.end());
      for (size_t i = 1; i < ranges.size(); ++i) {
        if (ranges[i - 1].second > ranges[i].first - ranges[i - 1].first) {
          fail(pointerTo("buffers", buffer), "two compressed views overlap");
        }
      }
    }
  }

  void checkBuffer(size_t index) {
    const std::string where = pointerTo("buffers", index);
    const auto buffer = elementOf(json_, "buffers", index);
    if (!buffer) return failures_.push_back(buffer.error());
    const Json* extension = extensionOf(**buffer, kExtensionName);
    if (!extension) return;
    ++views_;
    const Json* fallback = member(*extension, "fallback");
    if (!fallback || *fallback != true) {
      fail(where + "/extensions/" + kExtensionName + "/fallback", "this must be true");
    }
    needed_ |= index >= asset_.buffers.size() || asset_.buffers[index].empty();
    placeholders_.insert(index);
  }

  /// Only compressed views may lie in a placeholder.
  void checkUsers() {
    for (size_t i = 0; i < countOf(json_, "bufferViews") && !placeholders_.empty(); ++i) {
      const Json& view = json_["bufferViews"][i];
      const Json* used = member(view, "buffer");
      const auto buffer = used ? asInteger(*used) : std::nullopt;
      if (!buffer || !placeholders_.count(*buffer)) continue;
      const Json* extensions = objectMember(view, "extensions");
      if (!extensions || !extensions->contains(kExtensionName)) {
        fail(pointerTo("bufferViews", i),
             "an ordinary buffer view lies in the fallback " + pointerTo("buffers", *buffer));
      }
    }
  }

  void checkLists() {
    if (views_ == 0) return;
    if (!listsExtension(json_, "extensionsUsed", kExtensionName)) {
      fail("/extensionsUsed", std::string("this must name ") + kExtensionName);
    }
    if (needed_ && !listsExtension(json_, "extensionsRequired", kExtensionName)) {
      fail("/extensionsRequired", std::string("without fallback data, this must name ") + kExtensionName);
    }
  }

  const Asset& asset_;
  const Json& json_;
  std::vector<Failure> failures_;
  std::set<PayloadRange> payloads_;
  std::set<std::tuple<PayloadRange, Mode, uint64_t>> arrays_;
  std::map<uint64_t, std::vector<std::pair<uint64_t, uint64_t>>> places_;
  std::set<uint64_t> placeholders_;
  size_t views_ = 0;
  bool needed_ = false;
};

}  // namespace

std::vector<Failure> checkExtension(const Asset& asset) { return Rules(asset).check(); }

}  // namespace tutte
