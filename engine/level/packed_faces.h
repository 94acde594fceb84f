// Painted faces of a large level in few bytes: 23 a face, as base64 31 characters. Many faces as readable
// rows would make the file larger than the geometry.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// As many low bits of the loop hash are kept, and compared where a painted face is looked for.
inline constexpr int packed_hash_bits = 48;
inline std::uint64_t packed_hash(std::uint64_t loop_hash) {
    return loop_hash & ((std::uint64_t{1} << packed_hash_bits) - 1);
}

// Rows of base64, for keys in ascending order of their packed_hash. Which faces share a row depends on their
// hashes alone, so painting one more face changes one row. What becomes coarser: the normal (to 0.05 degrees)
// and the area (to 0.1 %); the copy is not kept.
std::vector<std::string> pack_faces(std::span<const FaceKey* const> keys);

// Appends the keys of a row, without material; false where the row is none.
bool unpack_faces(std::string_view row, std::vector<FaceKey>& keys);

}  // namespace slipface
