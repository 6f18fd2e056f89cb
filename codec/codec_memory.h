#pragma once
// What coding a connectivity needs beside its result, kept from one mesh to the next: small meshes would otherwise pay
// more for memory that nobody has touched yet than for their symbols.

#include "codec/gaps.h"
#include "codec/statistics_mixed.h"

namespace tutte {

struct CodecMemory {
  StatisticsMemory statistics;
  GapMemory gaps;
};

}  // namespace tutte
