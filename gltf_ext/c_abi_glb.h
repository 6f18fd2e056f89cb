/* Whole GLB files for other languages: plain ones to compressed ones and back. codec/c_abi.h says how errors, memory
 * and threads are handled.
 *
 *     tutte_file* file;
 *     int32_t status = tutte_decompress_glb(bytes, size, &file);
 *     if (status != TUTTE_OK) fail(tutte_file_text(file));
 *     else load(tutte_file_bytes(file), tutte_file_size(file));
 *     tutte_free_file(file);
 */
#pragma once

#include "codec/c_abi.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A GLB that was made, or why it was not. */
typedef struct tutte_file tutte_file;

/** How far a component of a decoded value may be from the original. */
typedef struct tutte_error_bound {
  double size;      /**< in the attribute's units (positions: metres); 0: no bound, bits decide. Not negative, finite */
  int32_t relative; /**< 1: `size`, then below 1, is a part of the attribute's largest extent */
} tutte_error_bound;

/** How to compress. tutte_default_options() gives what is usual. */
typedef struct tutte_compress_options {
  int32_t position_bits; /**< 0 to 24; 0: without loss. So are the next ones */
  int32_t normal_bits;   /**< normals and tangents; not 1 */
  int32_t texcoord_bits;
  int32_t color_bits;
  int32_t generic_bits;    /**< custom attributes, and morph targets of anything but positions */
  int32_t attribute_coder; /**< 0: whichever takes fewer bytes, 1: Draco, 2: the codec's own */
  int32_t profile;         /**< of connectivity and attributes, as in tutte_encode_options */
  int32_t effort;          /**< the same */
  int32_t polygons;        /**< 0: as the input has them, 1: FB_ngon_encoding, 2: EXT_mesh_polygon, 3: both */
  int32_t fallback;        /**< 1: keep the uncompressed data too */
  int32_t grid;            /**< whose positions are rounded alike. 0: the file's, 1: each mesh's */
  int32_t lossless; /**< 1: every bit of every attribute, whatever the bits above say; then no bound is allowed */

  /* Where one is given, it decides instead of the bits. In the order of the bits, but for normals. */
  tutte_error_bound position_error, texcoord_error, color_error, generic_error;
} tutte_compress_options;

void tutte_default_options(tutte_compress_options* options);

/** Compresses the meshes of a GLB, or of a .gltf file without external buffers. Null for `options`: the usual ones.
 * What was left uncompressed, and why, is the file's text. Returns TUTTE_OK, TUTTE_MALFORMED, TUTTE_UNSUPPORTED,
 * TUTTE_INVALID_ARGUMENT or TUTTE_OUT_OF_MEMORY. Whatever it returns, *file must be freed unless it is null. */
int32_t tutte_compress_glb(const uint8_t* bytes, size_t size, const tutte_compress_options* options, tutte_file** file);

/** The same file without TUTTE_mesh_compression, for loaders that do not know it. Otherwise as above. */
int32_t tutte_decompress_glb(const uint8_t* bytes, size_t size, tutte_file** file);

/** The GLB; empty after an error. It lives as long as the handle. */
const uint8_t* tutte_file_bytes(const tutte_file* file);
size_t tutte_file_size(const tutte_file* file);

/** After an error what is wrong and where; otherwise the warnings, a line each. Never null. */
const char* tutte_file_text(const tutte_file* file);

/** Null is allowed. */
void tutte_free_file(tutte_file* file);

#ifdef __cplusplus
}
#endif
