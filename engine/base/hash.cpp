#include "slipface/base/hash.h"

#include <algorithm>
#include <vector>

#include "slipface/base/parallel.h"

namespace slipface {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 18;

std::uint64_t hash_block(const unsigned char* bytes, std::size_t size) {
    std::uint64_t state = 0x9E3779B97F4A7C15ULL ^ size;
    for (std::size_t at = 0; at < size; at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + at, std::min<std::size_t>(8, size - at));
        state = (state ^ word) * 0x9FB21C651E98DF25ULL;
        state ^= state >> 32;
    }
    return state;
}

}  // namespace

std::uint64_t hash_blocks(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    std::vector<std::uint64_t> blocks((size + block_size - 1) / block_size);
    parallel_for(blocks.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            blocks[i] = hash_block(bytes + i * block_size, std::min(block_size, size - i * block_size));
    });
    Hasher hasher;
    for (const std::uint64_t block : blocks)
        hasher.u64(block);
    return hasher.value();
}

}  // namespace slipface
