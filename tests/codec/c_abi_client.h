/* The C interface as a program in C sees it. Every function returns null, or what went wrong. */
#pragma once

#include "codec/c_abi.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Encodes with `options`, which may be null, decodes, and finds the input's polygons again by way of the orders. */
const char* c_client_round_trip(const tutte_polygons* polygons, const tutte_encode_options* options);

/** Reads every array of a payload with every stride. */
const char* c_client_read_payload(const uint8_t* bytes, size_t size);

/** Null pointers, numbers out of range, buffers that are too small. */
const char* c_client_hostile_arguments(void);

#ifdef __cplusplus
}
#endif
