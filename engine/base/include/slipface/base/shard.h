// One part of a long job that is divided among several machines: 1/4 to 4/4. All command-line verbs use the
// same notation.
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
    // True if `item` belongs to this part. Items are counted from 0 over the whole job.
    bool has(std::uint64_t item) const { return item % count == number - 1; }
    friend bool operator==(const Shard&, const Shard&) = default;
};

// Reads "2/4". The error names `location`, what was found and what was expected.
Result<Shard> parse_shard(std::string_view text, const std::string& location);
std::string shard_text(const Shard& shard);  // "2/4"

// One part and the file that it was read from.
struct ShardFile {
    std::string file;
    Shard shard;
};
// Checks that the parts make a whole. The error names parts that occur twice, parts that are missing, and
// parts that belong to another number of parts.
Status check_shards_complete(std::span<const ShardFile> parts, const std::string& location);

}  // namespace slipface
