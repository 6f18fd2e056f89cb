// A user of the installed package: a cube there and back.
#include <cstdio>

#include "codec/decode.h"
#include "codec/encode.h"
#ifdef WITH_GLTF
#include "gltf_ext/pack.h"
#endif

int main() {
  tutte::Polygons cube;
  cube.face_degrees.assign(6, 4);
  cube.corners = {3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  cube.vertex_count = 8;

  const auto encoded = tutte::encode(cube);
  if (!encoded) return 1;
  const auto decoded = tutte::decode(encoded->bytes);
  if (!decoded || decoded->vertex_count != 8 || tutte::polygonsOf(*decoded).corners.size() != 24) return 2;
  std::printf("%zu bytes\n", encoded->bytes.size());

#ifdef WITH_GLTF
  tutte::PolygonMesh mesh;
  mesh.polygons = cube;
  mesh.wedge_count = 8;
  const auto packed = tutte::pack(mesh);
  if (!packed || !tutte::unpack(packed->bytes)) return 3;
#endif
  return 0;
}
