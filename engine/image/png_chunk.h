// The chunks of PNG files (PNG specification, section 5).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

// The four bytes at `at`, the most significant first. The caller checks that they exist.
inline std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

struct PngChunks {
    std::string_view first;          // the data of the first IDAT
    std::string joined;              // of all, if there are several
    bool transparent_color = false;  // a tRNS chunk
    bool ended = false;              // by IEND, not by the end of the file

    std::string_view pixels() const { return joined.empty() ? first : joined; }
};
// Nothing if a chunk does not lie within the file: a decoder allocates the length that a chunk declares
// before it reads the chunk. `bytes` begin with the signature.
std::optional<PngChunks> png_chunks(std::string_view bytes);

// A PNG file of one IDAT with the compressed rows `pixels`.
std::string png_file(std::uint32_t width, std::uint32_t height, char bits, char color_type,
                     std::string_view pixels);

}  // namespace slipface
