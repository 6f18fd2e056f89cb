#pragma once
// The head of a connectivity section.

#include <cstdint>
#include <span>
#include <vector>

#include "codec/bytes.h"
#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/result.h"

namespace tutte {

/// What the decoder must know before the first symbol.
struct SectionHeader {
  Index uniform_degree = 0;  ///< all faces have this degree, 3 to 15; 0: degrees are coded
  bool closed = false;       ///< there are no dummy faces
  bool repairs = false;      ///< there is a repair stream
  TieRule tie = TieRule::kOldestFirst;

  /// Nothing is left to code about degrees.
  bool degreesKnown() const { return closed && uniform_degree != 0; }
};

/// The three streams of a section.
struct SectionStreams {
  std::span<const uint8_t> valences, degrees, repairs;
};

/// Head and streams in one piece: flags, the lengths of the optional streams, degrees, repairs, valences.
std::vector<uint8_t> writeSection(const SectionHeader& header, const SectionStreams& streams);

/// The reverse. The spans point into `bytes`.
Result<SectionStreams> readSection(std::span<const uint8_t> bytes, SectionHeader& header);

}  // namespace tutte
