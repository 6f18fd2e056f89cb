#include "tests/codec/c_abi_client.h"

#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                 \
  do {                                   \
    if (!(condition)) return #condition; \
  } while (0)

typedef struct array {
  uint32_t* values;
  int64_t count; /* or an error */
} array;

static array read_array(tutte_mesh* mesh, uint32_t which) {
  array result = {NULL, tutte_read(mesh, which, 4, NULL, 0)};
  if (result.count < 0) return result;
  result.values = malloc(4 * (size_t)result.count + 4);
  result.count = tutte_read(mesh, which, 4, result.values, (size_t)result.count);
  return result;
}

/* What a round trip needs of both meshes. */
typedef struct arrays {
  array vertex_order, face_order, corner_order;
  array degrees, corners, coded_corners;
} arrays;

static void free_arrays(arrays* all) {
  free(all->vertex_order.values);
  free(all->face_order.values);
  free(all->corner_order.values);
  free(all->degrees.values);
  free(all->corners.values);
  free(all->coded_corners.values);
}

/* Corner by corner: the vertex is the input's, and the corner belongs to the input's face. */
static const char* compare(const arrays* all, const tutte_polygons* input, const uint32_t* first) {
  size_t corner = 0;
  CHECK(all->degrees.count == (int64_t)input->face_count && all->corners.count == (int64_t)input->corner_count);
  CHECK(all->face_order.count == all->degrees.count && all->corner_order.count == all->corners.count);
  CHECK(all->vertex_order.count == (int64_t)input->vertex_count);
  for (size_t f = 0; f < input->face_count; ++f) {
    const uint32_t input_face = all->face_order.values[f], degree = all->degrees.values[f];
    CHECK(input->face_degrees[input_face] == degree);
    for (uint32_t i = 0; i < degree; ++i, ++corner) {
      const uint32_t source = all->corner_order.values[all->coded_corners.values[corner]];
      CHECK(source - first[input_face] < degree);
      CHECK(input->corners[source] == all->vertex_order.values[all->corners.values[corner]]);
    }
  }
  return NULL;
}

static const char* compare_meshes(tutte_mesh* encoded, tutte_mesh* decoded, const tutte_polygons* input) {
  arrays all = {read_array(encoded, TUTTE_VERTEX_ORDER), read_array(encoded, TUTTE_FACE_ORDER),
                read_array(encoded, TUTTE_CORNER_ORDER), read_array(decoded, TUTTE_FACE_DEGREES),
                read_array(decoded, TUTTE_CORNERS),      read_array(decoded, TUTTE_CODED_CORNERS)};
  uint32_t* first = malloc(4 * input->face_count + 4);
  const char* problem;
  first[0] = 0;
  for (size_t f = 0; f + 1 < input->face_count; ++f) first[f + 1] = first[f] + input->face_degrees[f];
  problem = compare(&all, input, first);
  free(first);
  free_arrays(&all);
  return problem;
}

const char* c_client_round_trip(const tutte_polygons* polygons, const tutte_encode_options* options) {
  tutte_mesh *encoded = NULL, *decoded = NULL;
  const char* problem = NULL;
  uint8_t* bytes = NULL;
  int64_t size;
  const int32_t status = tutte_encode_connectivity(polygons, options, &encoded);
  if (status != TUTTE_OK) return tutte_describe(status);
  size = tutte_read(encoded, TUTTE_SECTION_BYTES, 1, NULL, 0);
  if (size > 0) bytes = malloc((size_t)size);
  if (bytes == NULL || tutte_read(encoded, TUTTE_SECTION_BYTES, 1, bytes, (size_t)size) != size) {
    problem = "the bytes cannot be read";
  } else if (tutte_decode_connectivity(bytes, (size_t)size, NULL, &decoded) != TUTTE_OK) {
    problem = "the bytes cannot be decoded";
  } else {
    problem = compare_meshes(encoded, decoded, polygons);
  }
  free(bytes);
  tutte_free(decoded);
  tutte_free(encoded);
  return problem;
}

static const char* read_all(tutte_mesh* mesh, const tutte_counts* counts) {
  for (uint32_t which = 0; which < TUTTE_ARRAY_COUNT; ++which) {
    array whole = read_array(mesh, which);
    const int encoded_only = which >= TUTTE_SECTION_BYTES && which < TUTTE_WEDGES;
    free(whole.values);
    CHECK((whole.count == TUTTE_NOT_AVAILABLE) == encoded_only);
    for (uint32_t stride = 1; !encoded_only && stride <= 4; stride *= 2) {
      const size_t room = (size_t)whole.count * stride;
      uint8_t* buffer = malloc(room + 1);
      int64_t count;
      buffer[room] = 0xA5;
      count = tutte_read(mesh, which, stride, buffer, (size_t)whole.count);
      whole.values = NULL;
      if (buffer[room] != 0xA5) count = TUTTE_MALFORMED;
      free(buffer);
      CHECK(count == whole.count || (count == TUTTE_TOO_LARGE && stride < 4));
    }
    if (which < TUTTE_TRIANGLE_INDICES) continue;
    CHECK(tutte_read(mesh, which | TUTTE_GROUP_STARTS, 4, NULL, 0) ==
          (which == TUTTE_WELDED_WEDGES ? 2 : (int64_t)counts->groups + 1));
  }
  return NULL;
}

const char* c_client_read_payload(const uint8_t* bytes, size_t size) {
  tutte_mesh* mesh;
  tutte_counts counts, claimed;
  const char* problem;
  tutte_decoder* const decoder = tutte_new_decoder();
  CHECK(tutte_decode_next_payload(decoder, bytes, size, NULL, &mesh) == TUTTE_OK);
  tutte_free(mesh);
  CHECK(tutte_decode_next_payload(decoder, bytes, size, NULL, &mesh) == TUTTE_OK);
  tutte_free_decoder(decoder);
  CHECK(tutte_get_counts(mesh, &counts) == TUTTE_OK);
  CHECK(tutte_peek_counts(bytes, size, &claimed) == TUTTE_OK);
  claimed.umbrellas = counts.umbrellas;
  problem = memcmp(&counts, &claimed, sizeof counts) == 0 ? read_all(mesh, &counts) : "the counts differ";
  tutte_free(mesh);
  return problem;
}

static const char* hostile_input(void) {
  const uint8_t one[1] = {0};
  const tutte_polygons no_arrays = {NULL, NULL, 1, 3, 3}, too_many = {NULL, NULL, SIZE_MAX, 0, 0};
  const tutte_polygons empty = {NULL, NULL, 0, 0, 0};
  const uint32_t triangle[1] = {3}, corners[3] = {0, 1, 7};
  const tutte_polygons out_of_range = {triangle, corners, 1, 3, 3}, too_short = {triangle, corners, 1, 2, 8};
  tutte_mesh* mesh;
  tutte_counts counts;
  size_t offset, length;
  CHECK(tutte_encode_connectivity(NULL, NULL, &mesh) == TUTTE_INVALID_ARGUMENT && mesh == NULL);
  CHECK(tutte_encode_connectivity(&empty, NULL, NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_encode_connectivity(&no_arrays, NULL, &mesh) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_encode_connectivity(&too_many, NULL, &mesh) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_encode_connectivity(&out_of_range, NULL, &mesh) == TUTTE_INDEX_OUT_OF_RANGE && mesh == NULL);
  CHECK(tutte_encode_connectivity(&too_short, NULL, &mesh) == TUTTE_COUNT_MISMATCH);
  for (int i = 0; i < 4; ++i) {
    const tutte_encode_options wrong[4] = {{-2, 1}, {4, 1}, {0, -1}, {0, 4}};
    CHECK(tutte_encode_connectivity(&empty, &wrong[i], &mesh) == TUTTE_INVALID_ARGUMENT);
  }
  CHECK(tutte_decode_connectivity(NULL, 1, NULL, &mesh) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_connectivity(one, SIZE_MAX, NULL, &mesh) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_connectivity(one, 1, NULL, NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_connectivity(NULL, 0, NULL, &mesh) == TUTTE_TRUNCATED && mesh == NULL);
  CHECK(tutte_decode_payload(NULL, 0, NULL, &mesh) == TUTTE_TRUNCATED && mesh == NULL);
  CHECK(tutte_decode_payload(one, 1, NULL, NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_next_payload(NULL, one, 1, NULL, &mesh) == TUTTE_INVALID_ARGUMENT && mesh == NULL);
  tutte_free_decoder(NULL);
  CHECK(tutte_peek_counts(NULL, 5, &counts) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_peek_counts(one, 1, NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_find_section(one, 1, 6, &offset, &length) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_find_section(one, 1, 0, NULL, &length) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_find_section(one, 1, 0, &offset, &length) < 0);
  return NULL;
}

static const char* hostile_reading(tutte_mesh* mesh) {
  uint32_t room[4] = {7, 7, 7, 7};
  CHECK(tutte_read(NULL, TUTTE_CORNERS, 4, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_CORNERS, 4, NULL, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_CORNERS, 3, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_CORNERS, 0, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_CORNERS, 4, room, SIZE_MAX) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_ARRAY_COUNT, 4, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, 0xFFFFFFFFu, 4, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_CORNERS | TUTTE_GROUP_STARTS, 4, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read(mesh, TUTTE_TRIANGLE_INDICES, 4, room, 4) == TUTTE_NOT_AVAILABLE);
  CHECK(tutte_read(mesh, TUTTE_CORNERS, 4, room, 2) == TUTTE_BUFFER_TOO_SMALL && room[0] == 7);
  CHECK(tutte_read(mesh, TUTTE_CORNERS, 4, room, 4) == 3 && room[2] < 3 && room[3] == 7);
  CHECK(tutte_read(mesh, TUTTE_TWINS, 2, room, 4) == 3 && room[0] == 0xFFFFFFFFu);
  CHECK(tutte_get_counts(mesh, NULL) == TUTTE_INVALID_ARGUMENT);
  return NULL;
}

const char* c_client_hostile_arguments(void) {
  const uint32_t triangle[1] = {3}, corners[3] = {0, 1, 2};
  const tutte_polygons polygons = {triangle, corners, 1, 3, 3};
  const char* problem = hostile_input();
  tutte_mesh* mesh;
  tutte_counts counts;
  if (problem != NULL) return problem;
  CHECK(tutte_get_counts(NULL, &counts) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_memory_for(NULL) == 0);
  CHECK(strlen(tutte_describe(12345)) > 0 && strlen(tutte_describe(INT32_MIN)) > 0);
  CHECK(strlen(tutte_describe(TUTTE_NOT_AVAILABLE)) > 0 && strlen(tutte_describe(TUTTE_CHECKSUM)) > 0);
  tutte_free(NULL);
  CHECK(tutte_encode_connectivity(&polygons, NULL, &mesh) == TUTTE_OK);
  problem = hostile_reading(mesh);
  tutte_free(mesh);
  return problem;
}
