#include "png_limit.h"

#include <stb/stb_image.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "png_chunk.h"

namespace slipface {
namespace {

// An upper bound of the bytes of all rows with their filter bytes. Interlacing adds at most a filter byte and
// a partial byte per row and pass.
std::size_t unpacked_size(const PngSize& size) {
    constexpr std::size_t largest_pixel = 8;
    constexpr std::size_t interlace_rows = 4;
    return size.height * (size.width * largest_pixel + interlace_rows) + 1024;
}

}  // namespace

std::optional<PngSize> png_size(std::string_view bytes) {
    constexpr std::size_t header_end = png_signature.size() + 8 + 13;
    if (bytes.size() < header_end || !bytes.starts_with(png_signature)) return std::nullopt;
    return PngSize{.width = big_endian(bytes, 16), .height = big_endian(bytes, 20)};
}

bool png_data_fits_header(std::string_view bytes) {
    // Deflate reaches at most 1032 to 1, so data smaller than this cannot grow beyond about 256 MiB.
    constexpr std::size_t harmless = std::size_t{256} * 1024;
    const auto size = png_size(bytes);
    if (!size) return true;
    const std::optional<PngChunks> chunks = png_chunks(bytes);
    if (!chunks) return false;
    const std::string_view packed = chunks->pixels();
    if (packed.size() <= harmless) return true;
    const std::size_t room = unpacked_size(*size);
    if (room > std::numeric_limits<int>::max()) return false;
    std::vector<char> unpacked(room);
    return stbi_zlib_decode_buffer(unpacked.data(), static_cast<int>(unpacked.size()), packed.data(),
                                   static_cast<int>(packed.size())) >= 0;
}

}  // namespace slipface
