/* The attributes of a payload for other languages: what codec/c_abi.h leaves out, under the same rules.
 *
 *     tutte_mesh* mesh;
 *     tutte_attributes* attributes;
 *     int32_t status = tutte_decode_payload(bytes, size, NULL, &mesh);
 *     if (status == TUTTE_OK) status = tutte_decode_attributes(mesh, bytes, size, &attributes);
 *     if (status != TUTTE_OK) return fail(tutte_describe(status));
 *     int64_t size = tutte_read_attribute(attributes, 0, 12, NULL, 0);
 *     float* positions = malloc((size_t)size);
 *     tutte_read_attribute(attributes, 0, 12, positions, (size_t)size);
 *     tutte_free_attributes(attributes);
 *     tutte_free(mesh);
 */
#pragma once

#include "codec/c_abi.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The values of all attributes of one payload. */
typedef struct tutte_attributes tutte_attributes;

/** What one attribute is. */
typedef struct tutte_attribute {
  const char* name;    /**< glTF's, such as "TEXCOORD_0"; of morph target 3 "POSITION@3". Lives as long as the handle */
  uint32_t components; /**< 1 to 4 */
  uint32_t component_type; /**< glTF's number: 5120, 5121, 5122, 5123, 5125 or 5126 */
  uint32_t normalized;     /**< 1: integers that stand for 0 to 1, or -1 to 1 */
} tutte_attribute;

/** The memory in bytes that it takes at most to decode the attributes of a decoded payload, beside the mesh, the bytes
 * and the caller's own. 0 for meshes that are no payload's. */
uint64_t tutte_memory_for_attributes(const tutte_mesh* mesh);

/** Decodes the values of a payload's attributes. `mesh` must have been decoded from the same bytes. A payload without
 * attributes gives a handle without any. TUTTE_NOT_BUILT: the bytes need Draco, which this build of the library does
 * not have. On success *attributes must be freed; on failure it is null. */
int32_t tutte_decode_attributes(const tutte_mesh* mesh, const uint8_t* bytes, size_t size,
                                tutte_attributes** attributes);

/** Null is allowed. */
void tutte_free_attributes(tutte_attributes* attributes);

/** How many attributes there are. */
int64_t tutte_attribute_count(const tutte_attributes* attributes);

/** What attribute `index` is. */
int32_t tutte_get_attribute(const tutte_attributes* attributes, uint32_t index, tutte_attribute* attribute);

/** Reads an attribute: per wedge its components, little-endian, and every `stride` bytes the next one. What is between
 * them becomes 0. `stride` is at least the size of a value; 0 stands for that size. Returns the number of bytes. With
 * room for 0 bytes it only counts; `out` may then be null. */
int64_t tutte_read_attribute(const tutte_attributes* attributes, uint32_t index, uint32_t stride, void* out,
                             size_t capacity);

#ifdef __cplusplus
}
#endif
