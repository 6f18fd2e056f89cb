#include "codec/wedges.h"

namespace tutte {
namespace {

/// How many parts each whole has.
Result<std::vector<Index>> countParts(std::span<const Index> wholes, Index whole_count, std::span<const Index> parts,
                                      Index part_count) {
  std::vector<Index> whole_of(part_count, kNone), parts_of(whole_count, 0);
  for (size_t corner = 0; corner < parts.size(); ++corner) {
    if (parts[corner] >= part_count) return Error::kIndexOutOfRange;
    Index& whole = whole_of[parts[corner]];
    if (whole == wholes[corner]) continue;
    if (whole != kNone) return Error::kMalformed;
    whole = wholes[corner];
    ++parts_of[whole];
  }
  return parts_of;
}

}  // namespace

Result<PartNumbering> numberParts(std::span<const Index> wholes, Index whole_count, std::span<const Index> parts,
                                  Index part_count) {
  if (wholes.size() != parts.size()) return Error::kCountMismatch;
  Result<std::vector<Index>> free = countParts(wholes, whole_count, parts, part_count);
  if (!free) return free.error();
  Index total = 0;
  for (Index& slot : *free) {
    const Index count = slot == 0 ? 1 : slot;
    slot = total;
    total += count;
  }

  PartNumbering numbering{std::vector<Index>(parts.size()), std::vector<Index>(total, kNone)};
  std::vector<Index> coded(part_count, kNone);
  for (size_t corner = 0; corner < parts.size(); ++corner) {
    Index& part = coded[parts[corner]];
    if (part == kNone) {
      part = (*free)[wholes[corner]]++;
      numbering.order[part] = parts[corner];
    }
    numbering.parts[corner] = part;
  }
  return numbering;
}

}  // namespace tutte
