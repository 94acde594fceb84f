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

// A hash of what a level file stores of `keys`.
std::uint64_t hash_of_keys(std::span<const FaceKey* const> keys);

// Rows of base64, for keys in ascending order of their packed_hash(). The hashes alone decide which faces
// share a row, so painting one more face changes one row. The normal is rounded to 0.05 degrees, the area to
// 0.1 %; the copy is not stored.
std::vector<std::string> pack_faces(std::span<const FaceKey* const> keys);

// Little-endian numbers of `count` bytes in a string.
void put_bytes(std::string& bytes, std::uint64_t value, std::size_t count);
std::uint64_t take_bytes(const char*& at, std::size_t count);

// Appends the keys of a row, without material; false if the row is not valid.
bool unpack_faces(std::string_view row, std::vector<FaceKey>& keys);

}  // namespace slipface
