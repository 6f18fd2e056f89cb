/* The codec for other languages: C99, flat arrays, nothing to link but this library.
 *
 * Arrays are always the caller's. A decoded or encoded mesh is held by the library, behind a handle, until the caller
 * frees it: ask how long an array is, make room, read it.
 *
 *     tutte_mesh* mesh;
 *     int32_t status = tutte_decode_payload(bytes, size, NULL, &mesh);
 *     if (status != TUTTE_OK) return fail(tutte_describe(status));
 *     int64_t count = tutte_read(mesh, TUTTE_TRIANGLE_INDICES, 4, NULL, 0);
 *     uint32_t* indices = malloc(4 * (size_t)count);
 *     tutte_read(mesh, TUTTE_TRIANGLE_INDICES, 4, indices, (size_t)count);
 *     tutte_free(mesh);
 *
 * Errors are negative. Any bytes and any numbers may be passed, and null pointers give TUTTE_INVALID_ARGUMENT; only
 * pointers to memory that is not there, and handles that were freed, cannot be detected. Different handles may be used
 * by different threads at once, one handle by one at a time. No C++ exception leaves a function, and none is used:
 *
 * Memory. A payload says how large its mesh is, and an encoder's input is as large as it is; so both first ask the
 * system whether as much memory can be had at all as that may take, and return TUTTE_OUT_OF_MEMORY if not. A
 * connectivity section alone says nothing about its size: give limits that the memory is large enough for. Should the
 * system refuse memory nevertheless, the process ends (a WebAssembly instance traps).
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The version of this interface. It grows when a declaration changes its meaning; new ones do not count. */
#define TUTTE_ABI_VERSION 1
/** The same, of the library that is linked. */
int32_t tutte_abi_version(void);

/** What functions return where they have nothing better to return. */
enum {
  TUTTE_OK = 0,
  TUTTE_TRUNCATED = -1,           /**< the bytes end before the mesh does */
  TUTTE_MALFORMED = -2,           /**< the bytes break a rule of the format */
  TUTTE_UNSUPPORTED_VERSION = -3, /**< another version of the format */
  TUTTE_LIMIT_EXCEEDED = -4,      /**< more vertices, faces or corners than the limits allow */
  TUTTE_INDEX_OUT_OF_RANGE = -5,  /**< a corner names a vertex that does not exist */
  TUTTE_COUNT_MISMATCH = -6,      /**< two counts contradict each other */
  TUTTE_TOO_LARGE = -7,           /**< more than 2^30 corners; or a value that does not fit the asked stride */
  TUTTE_CHECKSUM = -8,            /**< a section's bytes do not match their checksum */
  TUTTE_MISSING_SECTION = -9,     /**< a payload lacks a section that it needs */
  TUTTE_TRAILING_BYTES = -10,     /**< bytes after the end */
  TUTTE_OUT_OF_MEMORY = -11,      /**< the system has not enough memory for this mesh */
  TUTTE_ATTRIBUTES = -12,         /**< the attribute section is damaged or of an unknown kind */
  TUTTE_INVALID_ARGUMENT = -100,  /**< a null pointer, or a number that is none of those listed here */
  TUTTE_BUFFER_TOO_SMALL = -101,  /**< the array has more elements than there is room for; nothing was written */
  TUTTE_NOT_AVAILABLE = -102,     /**< this handle does not have that array */
  TUTTE_NOT_BUILT = -103,         /**< this build of the library leaves out what these bytes need */
  TUTTE_UNSUPPORTED = -104        /**< a valid file that uses something which is not handled */
};

/** A sentence in English for any status, never null. */
const char* tutte_describe(int32_t status);

/** What a decoder may build at most. Where a pointer to limits is null, 2^28 vertices, 2^28 faces and 2^30 corners. */
typedef struct tutte_limits {
  uint32_t max_vertices;
  uint32_t max_faces;
  uint32_t max_corners; /**< and triangles, and wedges */
} tutte_limits;

/** How large a mesh is. */
typedef struct tutte_counts {
  uint32_t vertices;
  uint32_t wedges; /**< glTF's vertices */
  uint32_t faces;
  uint32_t corners;
  uint32_t triangles;
  uint32_t groups; /**< glTF's primitives */
  uint32_t attributes;
  uint32_t umbrellas;
} tutte_counts;

/** The memory in bytes that it takes at most to decode a mesh of that size and to read all its arrays, beside the
 * caller's own. */
uint64_t tutte_memory_for(const tutte_counts* counts);

/** Polygons to encode: face i has face_degrees[i] corners, and the corners of all faces follow each other. */
typedef struct tutte_polygons {
  const uint32_t* face_degrees;
  const uint32_t* corners; /**< each a vertex, below vertex_count */
  size_t face_count;
  size_t corner_count;
  uint32_t vertex_count;
} tutte_polygons;

/** "None" in an array of 32-bit numbers. */
#define TUTTE_NONE 0xFFFFFFFFu

/** A mesh that was encoded or decoded. */
typedef struct tutte_mesh tutte_mesh;

/** How to encode. No choice changes what is decoded. */
typedef struct tutte_encode_options {
  int32_t profile; /**< 0: the paper's, 1: fast, 2: default, 3: small; -1: by the size of the mesh */
  int32_t effort;  /**< 0 to 3: how long to search for fewer bytes; 1 is usual */
} tutte_encode_options;

/** Encodes the connectivity of any polygons without loss: TUTTE_SECTION_BYTES, and the orders in which attributes are
 * to be coded. Null for `options` is {-1, 1}. On success *mesh must be freed; on failure it is null. */
int32_t tutte_encode_connectivity(const tutte_polygons* polygons, const tutte_encode_options* options,
                                  tutte_mesh** mesh);

/** Decodes a connectivity section. `limits` may be null. *mesh as above. */
int32_t tutte_decode_connectivity(const uint8_t* bytes, size_t size, const tutte_limits* limits, tutte_mesh** mesh);

/** Decodes a payload, that is, the bytes of a buffer view of the glTF extension, but for the attributes' values. */
int32_t tutte_decode_payload(const uint8_t* bytes, size_t size, const tutte_limits* limits, tutte_mesh** mesh);

/** What decoders need beside a mesh, kept from one payload to the next: small meshes decode several times as fast. */
typedef struct tutte_decoder tutte_decoder;

/** To be freed with tutte_free_decoder(), for which null is allowed. Null if there is no memory. */
tutte_decoder* tutte_new_decoder(void);
void tutte_free_decoder(tutte_decoder* decoder);

/** As tutte_decode_payload(). */
int32_t tutte_decode_next_payload(tutte_decoder* decoder, const uint8_t* bytes, size_t size, const tutte_limits* limits,
                                  tutte_mesh** mesh);

/** Where a section's bytes lie in a payload; its number is that of the specification (5: ATTRIBUTES). All checksums
 * are verified. TUTTE_NOT_AVAILABLE if the payload does not have that section. */
int32_t tutte_find_section(const uint8_t* bytes, size_t size, uint32_t section, size_t* offset, size_t* length);

/** Null is allowed. */
void tutte_free(tutte_mesh* mesh);

/** How large a mesh is. Without a payload, wedges are vertices, there is one group, and no triangles. */
int32_t tutte_get_counts(const tutte_mesh* mesh, tutte_counts* counts);

/** What a payload claims, without decoding or checksums; umbrellas are 0. */
int32_t tutte_peek_counts(const uint8_t* bytes, size_t size, tutte_counts* counts);

/** The arrays of a mesh. All numbers of vertices, wedges, faces and corners are coded ones unless it says "input". */
typedef enum tutte_array {
  /* Of every mesh. */
  TUTTE_FACE_DEGREES = 0,  /**< per face */
  TUTTE_CORNERS = 1,       /**< per corner: its vertex, each face in its original orientation */
  TUTTE_CODED_CORNERS = 2, /**< per corner: its number in the coded orientation, which the arrays 3 and 4 use */
  TUTTE_UMBRELLAS = 3,     /**< per coded corner: its umbrella */
  TUTTE_TWINS = 4,         /**< per coded corner: the corner whose edge is the other side of its edge, or NONE */
  TUTTE_VERTICES = 5,      /**< per umbrella: its vertex (in a welded payload: its point); empty: the same number */
  TUTTE_FLIPPED = 6,       /**< per face: 1 where the coded orientation is the reverse; empty: nowhere */

  /* Of an encoded mesh. */
  TUTTE_SECTION_BYTES = 7, /**< the connectivity section, a byte per element */
  TUTTE_VERTEX_ORDER = 8,  /**< per vertex: the input's vertex */
  TUTTE_FACE_ORDER = 9,    /**< per face: the input's face */
  TUTTE_CORNER_ORDER = 10, /**< per coded corner: the input's corner */

  /* Of a payload's mesh. */
  TUTTE_WEDGES = 11,           /**< per corner (as TUTTE_CORNERS); empty: its vertex */
  TUTTE_GROUPS = 12,           /**< per face; empty: all 0 */
  TUTTE_RING_OWNERS = 13,      /**< per face: NONE, or of an interior ring its exterior one; empty: all NONE */
  TUTTE_TRIANGLE_COUNTS = 14,  /**< per face */
  TUTTE_TRIANGLE_CORNERS = 15, /**< three corners (as TUTTE_CORNERS) per triangle, face by face */

  /* What buffer views hold: polygons by group, and in coded order within one (EXTENSION_SPEC.md, modes). */
  TUTTE_TRIANGLE_INDICES = 16,
  TUTTE_POLYGON_INDEX_OFFSETS = 17,
  TUTTE_POLYGON_LOOPS = 18,
  TUTTE_POLYGON_LOOP_OFFSETS = 19,
  TUTTE_RING_DEGREES = 20,
  TUTTE_WELDED_WEDGES = 21,

  TUTTE_ARRAY_COUNT = 22
} tutte_array;

/** Added to an array from TUTTE_TRIANGLE_INDICES on: where each group's slice starts; one more element than groups. */
#define TUTTE_GROUP_STARTS 0x100u

/** Reads an array, as unsigned integers of `stride` bytes (1, 2 or 4) in the machine's order; NONE becomes the type's
 * largest value. Returns the number of elements. With room for 0 elements it only counts; `out` may then be null. */
int64_t tutte_read(tutte_mesh* mesh, uint32_t array, uint32_t stride, void* out, size_t capacity);

#ifdef __cplusplus
}
#endif
