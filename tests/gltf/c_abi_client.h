/* The C interface to attributes as a program in C sees it. Every function returns null, or what went wrong. */
#pragma once

#include "gltf_ext/c_abi.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the client must find. */
typedef struct expected_attribute {
  const char* name;
  uint32_t components, component_type, normalized;
  const uint8_t* data; /* wedges * size bytes */
  uint32_t size;       /* of one value */
} expected_attribute;

const char* c_client_read_attributes(const uint8_t* payload, size_t size, const expected_attribute* expected,
                                     size_t count);
const char* c_client_hostile_attributes(const uint8_t* payload, size_t size);

#ifdef __cplusplus
}
#endif
