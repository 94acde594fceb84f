// Bytes packed into fewer (deflate with the zlib wrapper, RFC 1950), in one call.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

inline constexpr int pack_fast = 1;       // about as fast as copying through memory
inline constexpr int pack_usual = 6;      // as zlib's usual level
inline constexpr int pack_smallest = 12;  // tens of times slower, a few per cent smaller

// The same bytes and effort give the same result (with one version of libdeflate).
std::string pack(std::string_view bytes, int effort = pack_usual);

// Exactly `size` bytes, or nothing: for damaged data, and for data that unpack to another size. Sizes that no
// packing could have come from are refused before any memory is taken.
std::optional<std::string> unpack(std::string_view packed, std::size_t size);

}  // namespace slipface
