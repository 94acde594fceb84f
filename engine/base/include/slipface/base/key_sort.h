// Sorting by 64-bit keys.
#pragma once

#include <cstdint>
#include <vector>

namespace slipface {

struct KeyedIndex {
    std::uint64_t key = 0;
    std::uint32_t index = 0;
};

// Sorts ascending by key, then by index. For many entries with hashes as keys it is several times as fast as
// std::sort; with other keys it is never much slower. Needs a second buffer of the size of `entries`.
void sort_by_key(std::vector<KeyedIndex>& entries);

}  // namespace slipface
