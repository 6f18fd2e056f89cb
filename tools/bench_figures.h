#pragma once
// What `tutte bench` measures, and how it adds up.

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "codec/profile.h"

namespace tutte {

/// Bytes and seconds (of processor time) of one coder, summed over the meshes of a file.
struct CoderFigures {
  uint64_t connectivity_bytes = 0;
  uint64_t seam_bytes = 0;
  uint64_t attribute_bytes = 0;
  std::map<std::string, uint64_t> by_attribute;  ///< by its name
  uint64_t total_bytes = 0;
  double encode_seconds = 0;
  double connectivity_encode_seconds = 0;
  double decode_seconds = 0;
  double connectivity_decode_seconds = 0;
  uint64_t decode_peak_bytes = 0;  ///< of memory, the decoded mesh included; in sums the largest

  CoderFigures& operator+=(const CoderFigures& other);
};

/// Whole bytes of the information in a connectivity section's symbols.
struct SymbolBytes {
  uint64_t valences = 0;  ///< with splits
  uint64_t degrees = 0;   ///< with holes

  SymbolBytes& operator+=(const SymbolBytes& other);
};

/// The connectivity alone, with one profile.
struct ProfileFigures {
  SymbolBytes symbols;
  uint64_t connectivity_bytes = 0;
  double encode_seconds = 0;
  double decode_seconds = 0;

  ProfileFigures& operator+=(const ProfileFigures& other);
};

/// All figures of a file, or of several in sum.
struct BenchFigures {
  std::string file;
  uint64_t vertices = 0, wedges = 0, faces = 0, splits = 0;
  SymbolBytes symbols;
  CoderFigures ours;  ///< attribute_bytes include seams; total_bytes are the payloads
  std::map<Profile, ProfileFigures> profiles;
  std::optional<CoderFigures> draco_cl7, draco_cl10, draco_polygons;  ///< nothing where Draco refuses the mesh
  std::optional<CoderFigures> draco_connectivity;  ///< at level 10, all positions zero: the way to connectivity alone
  std::string draco_refusal;                       ///< its reason
  std::optional<uint64_t> paper_bytes;             ///< of connectivity, if the model is one of the paper's
  uint64_t paper_counterpart = 0;                  ///< our connectivity bytes of those models
  uint64_t glb_bytes = 0;                          ///< of the whole file, with its JSON

  uint64_t otherConnectivityBytes() const { return ours.connectivity_bytes - symbols.valences - symbols.degrees; }
  double bitsPerVertex() const;

  /// Draco's figures stay only where both have them.
  BenchFigures& operator+=(const BenchFigures& other);
};

/// A sum of nothing, to which figures can be added.
BenchFigures emptySum(const std::string& name);

}  // namespace tutte
