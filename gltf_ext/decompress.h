#pragma once
// Compressed glTF to plain glTF, which every loader reads.

#include <map>
#include <vector>

#include "codec/decode.h"
#include "gltf_ext/asset.h"
#include "gltf_ext/extension.h"
#include "gltf_ext/failure.h"
#include "gltf_ext/polygon_mesh.h"

namespace tutte {

/// The asset without TUTTE_mesh_compression: its views hold the decoded bytes. FB_ngon_encoding and EXT_mesh_polygon
/// stay. An asset that does not use the extension comes back as it is. Every payload is decoded once.
///
/// The asset may hold anything. Rules are checked before anything is decoded, and a payload's counts are compared with
/// what the JSON declares before memory is taken. Errors: kInvalid, kUnsupported.
Outcome<Asset> decompress(const Asset& asset);

/// Decodes one payload of several. `views` are all the views that name it: they bound what it may hold.
Outcome<PolygonMesh> decodePayload(const Asset& asset, const PayloadRange& range,
                                   const std::vector<CompressedView>& views, Decoder& decoder);

/// The bytes that `view` stands for. Errors: kInvalid when the payload does not fit the view's count or stride.
Outcome<Bytes> decodedBytes(const PolygonMesh& mesh, const CompressedView& view, const std::string& where);

/// All payloads of an asset, each with the views (index and object) that name it, in order of their ranges.
using PayloadViews = std::map<PayloadRange, std::vector<std::pair<size_t, CompressedView>>>;

/// Checks every rule of the extension and lists the payloads. The first rule that is broken is the error.
Outcome<PayloadViews> payloadViewsOf(const Asset& asset);

/// Everything that is wrong with the extension's use in an asset: its rules, payloads that do not decode, counts that
/// differ, and fallback bytes that are not the decoded ones. An empty list means that it is valid.
std::vector<Failure> validate(const Asset& asset);

}  // namespace tutte
