// Parts of a long piece of work, done on several machines: 1/4 to 4/4. The same in every verb.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

inline constexpr std::uint32_t max_shards = 100'000;

struct Shard {
    std::uint32_t number = 1;  // 1 to count
    std::uint32_t count = 1;
    bool whole() const { return count == 1; }
    // Which items of the whole belong to this part, counted from 0.
    bool has(std::uint64_t item) const { return item % count == number - 1; }
    friend bool operator==(const Shard&, const Shard&) = default;
};

// "2/4". An error names `place`, what was found and what was expected.
Result<Shard> parse_shard(std::string_view text, const std::string& location);
std::string shard_text(const Shard& shard);  // "2/4"

// Whether the parts, each read from a file, make a whole: an error names those that are there twice, those
// that are missing, and those that are parts of another number of parts.
struct ShardFile {
    std::string file;
    Shard shard;
};
Status check_shards_complete(std::span<const ShardFile> parts, const std::string& location);

}  // namespace slipface
