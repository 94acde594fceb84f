// Compression: deflate with the zlib wrapper (RFC 1950), in one call.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

inline constexpr int pack_fast = 1;       // about as fast as copying through memory
inline constexpr int pack_usual = 6;      // zlib's default level
inline constexpr int pack_smallest = 12;  // tens of times slower, a few per cent smaller

// Compresses `bytes`. `effort` is clamped to pack_fast..pack_smallest. The same bytes and effort give the
// same result (with one version of libdeflate).
std::string pack(std::string_view bytes, int effort = pack_usual);

// Returns the decompressed bytes, or nothing if the data are damaged or do not unpack to exactly `size`
// bytes. A `size` that deflate cannot reach from `packed` is refused before memory is allocated.
std::optional<std::string> unpack(std::string_view packed, std::size_t size);

// The same with gzip's wrapper (RFC 1952), which holds the size. unpack_gzip: nothing if the data are damaged
// or would unpack to more than `most` bytes.
std::string pack_gzip(std::string_view bytes);
std::optional<std::string> unpack_gzip(std::string_view packed, std::size_t most);

}  // namespace slipface
