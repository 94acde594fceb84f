#include "png_limit.h"

#include <stb/stb_image.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "png_chunk.h"

namespace slipface {
namespace {

constexpr std::size_t signature_size = 8;
constexpr std::size_t chunk_overhead = 12;  // length, type and checksum

// Joins all IDAT chunks; stops where the file ends.
std::string pixel_data(std::string_view bytes) {
    std::string data;
    std::size_t at = signature_size;
    while (at < bytes.size() && bytes.size() - at >= chunk_overhead) {
        const std::size_t length = big_endian(bytes, at);
        if (length > bytes.size() - at - chunk_overhead) break;
        if (bytes.substr(at + 4, 4) == "IDAT") data += bytes.substr(at + 8, length);
        at += chunk_overhead + length;
    }
    return data;
}

// An upper bound of the bytes of all rows with their filter bytes. Interlacing adds at most a filter byte and
// a partial byte per row and pass.
std::size_t unpacked_size(const PngSize& size) {
    constexpr std::size_t largest_pixel = 8;
    constexpr std::size_t interlace_rows = 4;
    return size.height * (size.width * largest_pixel + interlace_rows) + 1024;
}

// True if every chunk up to the last lies within the file. A decoder allocates the length that a chunk
// declares before it reads the chunk.
bool chunks_fit(std::string_view bytes) {
    std::size_t at = signature_size;
    while (bytes.size() - at >= chunk_overhead) {
        const std::size_t length = big_endian(bytes, at);
        if (length > bytes.size() - at - chunk_overhead) return false;
        if (bytes.substr(at + 4, 4) == "IEND") return true;
        at += chunk_overhead + length;
    }
    return at == bytes.size();
}

}  // namespace

std::optional<PngSize> png_size(std::string_view bytes) {
    constexpr std::size_t header_end = signature_size + 8 + 13;
    if (bytes.size() < header_end || bytes.substr(0, signature_size) != "\x89PNG\r\n\x1a\n")
        return std::nullopt;
    return PngSize{.width = big_endian(bytes, 16), .height = big_endian(bytes, 20)};
}

bool png_data_fits_header(std::string_view bytes) {
    // Deflate reaches at most 1032 to 1, so data smaller than this cannot grow beyond about 256 MiB.
    constexpr std::size_t harmless = std::size_t{256} * 1024;
    const auto size = png_size(bytes);
    if (!size) return true;
    if (!chunks_fit(bytes)) return false;
    if (bytes.size() <= harmless) return true;

    const std::string packed = pixel_data(bytes);
    if (packed.size() <= harmless) return true;
    const std::size_t room = unpacked_size(*size);
    if (room > std::numeric_limits<int>::max()) return false;
    std::vector<char> unpacked(room);
    return stbi_zlib_decode_buffer(unpacked.data(), static_cast<int>(unpacked.size()), packed.data(),
                                   static_cast<int>(packed.size())) >= 0;
}

}  // namespace slipface
