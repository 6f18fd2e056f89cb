#pragma once
// What encoding a connectivity needs beside its input and its result, kept from one walk to the next.

#include "codec/codec_memory.h"
#include "codec/mesh_oracle.h"

namespace tutte {

struct EncoderMemory : CodecMemory {
  OracleMemory oracle;
};

}  // namespace tutte
