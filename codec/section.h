#pragma once
// The head of a connectivity section.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/bytes.h"
#include "codec/gaps.h"
#include "codec/mesh.h"
#include "codec/profile.h"
#include "codec/result.h"

namespace tutte {

/// What the decoder must know before the first symbol.
struct SectionHeader {
  Profile profile = Profile::kPaper;
  bool match = false;        ///< repeated sequences of symbols are predicted (not by kPaper)
  int table_bits = 7;        ///< of tables, 5 to 12; profiles add some (not used by kPaper)
  Index uniform_degree = 0;  ///< all faces have this degree, 3 to 15; 0: degrees are coded
  bool dual = false;         ///< the walk is over the dual mesh: its faces are the umbrellas, its umbrellas the faces
  bool closed = false;       ///< there are no dummy faces
  bool repairs = false;      ///< the symbols end with repairs
  bool copies = false;       ///< some components repeat earlier ones
  TieRule tie = TieRule::kOldestFirst;

  /// Nothing is left to code about degrees.
  bool degreesKnown() const { return !hasDummyFaces() && uniform_degree != 0; }

  /// The walk meets dummy faces as faces.
  bool hasDummyFaces() const { return !closed && !dual; }

  /// ... or as umbrellas.
  bool hasDummyUmbrellas() const { return !closed && dual; }

  Index leastDegree() const { return dual ? 2 : 3; }
};

/// The most table bits that a section of this many bytes may ask for: more would stay empty, and what a few bytes claim
/// must not cost megabytes.
constexpr int mostTableBits(size_t section_bytes) {
  return std::clamp(static_cast<int>(std::bit_width(section_bytes)), 7, 12);
}

/// Head and symbols in one piece: two bytes of flags, and to the end the valences and degrees as the range coder made
/// them, one by one as the walk asks for them.
std::vector<uint8_t> writeSection(const SectionHeader& header, std::span<const uint8_t> symbols);

/// The reverse: the symbols, a part of `bytes`.
Result<std::span<const uint8_t>> readSection(std::span<const uint8_t> bytes, SectionHeader& header);

}  // namespace tutte
