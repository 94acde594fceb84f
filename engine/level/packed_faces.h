// Painted faces of a large level in few bytes: 23 per face, 31 characters in base64. With readable rows the
// file would be larger than the geometry.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// Number of low bits of the loop hash that are stored, and compared when a face is looked up.
inline constexpr int packed_hash_bits = 48;
inline std::uint64_t packed_hash(std::uint64_t loop_hash) {
    return loop_hash & ((std::uint64_t{1} << packed_hash_bits) - 1);
}

// Rows of base64, for keys in ascending order of their packed_hash(). The hashes alone decide which faces
// share a row, so painting one more face changes one row. The normal is rounded to 0.05 degrees, the area to
// 0.1 %; the copy is not stored.
std::vector<std::string> pack_faces(std::span<const FaceKey* const> keys);

// Appends the keys of a row, without material; false if the row is not valid.
bool unpack_faces(std::string_view row, std::vector<FaceKey>& keys);

}  // namespace slipface
