#include "codec/sorting.h"

#include <algorithm>

namespace tutte {

void sortNumbers(std::vector<uint64_t>& numbers) { std::sort(numbers.begin(), numbers.end()); }

}  // namespace tutte
