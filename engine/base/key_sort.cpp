#include "slipface/base/key_sort.h"

#include <algorithm>
#include <cstddef>

#include "slipface/base/parallel.h"

namespace slipface {
namespace {

constexpr unsigned bucket_bits = 12;
constexpr std::size_t buckets = std::size_t{1} << bucket_bits;
constexpr std::size_t few = 4 * buckets;  // below this, buckets do not pay

bool before(const KeyedIndex& a, const KeyedIndex& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
}

std::size_t bucket_of(const KeyedIndex& entry) {
    return entry.key >> (64 - bucket_bits);
}

}  // namespace

// Hashes are spread evenly: distributed by their first bits they make small buckets, which are sorted in the
// cache.
void sort_by_key(std::vector<KeyedIndex>& entries) {
    if (entries.size() < few) return std::sort(entries.begin(), entries.end(), before);
    std::vector<std::size_t> begin(buckets + 1, 0);
    for (const KeyedIndex& entry : entries)
        ++begin[bucket_of(entry) + 1];
    for (std::size_t bucket = 0; bucket < buckets; ++bucket)
        begin[bucket + 1] += begin[bucket];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    std::vector<KeyedIndex> dealt(entries.size());
    for (const KeyedIndex& entry : entries)
        dealt[next[bucket_of(entry)]++] = entry;
    parallel_for(buckets, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t bucket = first; bucket < last; ++bucket)
            std::sort(dealt.data() + begin[bucket], dealt.data() + begin[bucket + 1], before);
    });
    entries.swap(dealt);
}

}  // namespace slipface
