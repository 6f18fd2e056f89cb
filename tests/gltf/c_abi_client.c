#include "tests/gltf/c_abi_client.h"

#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                 \
  do {                                   \
    if (!(condition)) return #condition; \
  } while (0)

static const char* check_values(const tutte_attributes* attributes, uint32_t index, const expected_attribute* expected,
                                uint32_t wedges) {
  for (uint32_t stride = expected->size; stride <= expected->size + 5; ++stride) {
    const size_t size = (size_t)wedges * stride;
    uint8_t* bytes = malloc(size + 1);
    const char* problem = NULL;
    memset(bytes, 0xA5, size + 1);
    if (tutte_read_attribute(attributes, index, stride, NULL, 0) != (int64_t)size) problem = "the count is wrong";
    if (size > 0 && tutte_read_attribute(attributes, index, stride, bytes, size) != (int64_t)size) problem = "not read";
    if (bytes[size] != 0xA5) problem = "bytes behind the end were written";
    for (uint32_t w = 0; w < wedges; ++w) {
      const uint8_t* value = bytes + (size_t)w * stride;
      if (memcmp(value, expected->data + (size_t)w * expected->size, expected->size) != 0) problem = "a value differs";
      for (uint32_t i = expected->size; i < stride; ++i) problem = value[i] == 0 ? problem : "the gaps are not empty";
    }
    free(bytes);
    if (problem != NULL) return problem;
  }
  return NULL;
}

static const char* check_all(const tutte_attributes* attributes, const expected_attribute* expected, size_t count,
                             uint32_t wedges) {
  CHECK(tutte_attribute_count(attributes) == (int64_t)count);
  for (uint32_t i = 0; i < count; ++i) {
    tutte_attribute attribute;
    const char* problem;
    CHECK(tutte_get_attribute(attributes, i, &attribute) == TUTTE_OK);
    CHECK(strcmp(attribute.name, expected[i].name) == 0);
    CHECK(attribute.components == expected[i].components && attribute.component_type == expected[i].component_type);
    CHECK(attribute.normalized == expected[i].normalized);
    problem = check_values(attributes, i, &expected[i], wedges);
    if (problem != NULL) return problem;
  }
  return NULL;
}

const char* c_client_read_attributes(const uint8_t* payload, size_t size, const expected_attribute* expected,
                                     size_t count) {
  tutte_mesh* mesh;
  tutte_attributes* attributes;
  tutte_counts counts;
  const char* problem;
  CHECK(tutte_decode_payload(payload, size, NULL, &mesh) == TUTTE_OK);
  CHECK(tutte_get_counts(mesh, &counts) == TUTTE_OK);
  CHECK(tutte_memory_for_attributes(mesh) > 0);
  CHECK(tutte_decode_attributes(mesh, payload, size, &attributes) == TUTTE_OK);
  problem = check_all(attributes, expected, count, counts.wedges);
  tutte_free_attributes(attributes);
  tutte_free(mesh);
  return problem;
}

static const char* without_attributes(void) {
  const uint32_t triangle[1] = {3}, corners[3] = {0, 1, 2};
  const tutte_polygons polygons = {triangle, corners, 1, 3, 3};
  const uint8_t one[1] = {0};
  tutte_mesh* mesh;
  tutte_attributes* attributes;
  CHECK(tutte_encode_connectivity(&polygons, NULL, &mesh) == TUTTE_OK);
  CHECK(tutte_memory_for_attributes(mesh) == 0);
  CHECK(tutte_decode_attributes(mesh, one, 1, &attributes) == TUTTE_NOT_AVAILABLE && attributes == NULL);
  tutte_free(mesh);
  return NULL;
}

static const char* wrong_arguments(const tutte_mesh* mesh, const uint8_t* payload, size_t size) {
  uint8_t room[4] = {7, 7, 7, 7};
  tutte_attributes* attributes;
  tutte_attribute attribute;
  CHECK(tutte_decode_attributes(NULL, payload, size, &attributes) == TUTTE_INVALID_ARGUMENT && attributes == NULL);
  CHECK(tutte_decode_attributes(mesh, payload, size, NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_attributes(mesh, NULL, size, &attributes) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_attributes(mesh, payload, SIZE_MAX, &attributes) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_attributes(mesh, payload, size - 1, &attributes) < 0 && attributes == NULL);
  CHECK(tutte_memory_for_attributes(NULL) == 0);
  CHECK(tutte_attribute_count(NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_decode_attributes(mesh, payload, size, &attributes) == TUTTE_OK);
  CHECK(tutte_get_attribute(NULL, 0, &attribute) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_get_attribute(attributes, 0, NULL) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_get_attribute(attributes, 0xFFFFFFFFu, &attribute) == TUTTE_NOT_AVAILABLE);
  CHECK(tutte_read_attribute(NULL, 0, 0, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read_attribute(attributes, 0, 0, NULL, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read_attribute(attributes, 0, 0, room, SIZE_MAX) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read_attribute(attributes, 0, 1, room, 4) == TUTTE_INVALID_ARGUMENT);
  CHECK(tutte_read_attribute(attributes, 0xFFFFFFFFu, 0, room, 4) == TUTTE_NOT_AVAILABLE);
  CHECK(tutte_read_attribute(attributes, 0, 0, room, 4) == TUTTE_BUFFER_TOO_SMALL && room[0] == 7);
  tutte_free_attributes(attributes);
  tutte_free_attributes(NULL);
  return NULL;
}

const char* c_client_hostile_attributes(const uint8_t* payload, size_t size) {
  const char* problem = without_attributes();
  tutte_mesh* mesh;
  if (problem != NULL) return problem;
  CHECK(tutte_decode_payload(payload, size, NULL, &mesh) == TUTTE_OK);
  problem = wrong_arguments(mesh, payload, size);
  tutte_free(mesh);
  return problem;
}
