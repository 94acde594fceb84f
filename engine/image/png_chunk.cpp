#include "png_chunk.h"

#include <libdeflate.h>

namespace slipface {
namespace {

constexpr std::size_t overhead = 12;  // length, type and checksum

void append_big_endian(std::string& out, std::uint32_t value) {
    for (const unsigned shift : {24U, 16U, 8U, 0U})
        out += static_cast<char>(value >> shift & 0xffU);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
    append_big_endian(out, static_cast<std::uint32_t>(data.size()));
    std::uint32_t crc = 0;
    for (const std::string_view part : {type, data}) {
        out += part;
        crc = libdeflate_crc32(crc, part.data(), part.size());
    }
    append_big_endian(out, crc);
}

}  // namespace

std::optional<PngChunks> png_chunks(std::string_view bytes) {
    PngChunks chunks;
    std::size_t at = png_signature.size();
    while (!chunks.ended && bytes.size() - at >= overhead) {
        const std::size_t length = big_endian(bytes, at);
        if (length > bytes.size() - at - overhead) return std::nullopt;
        const std::string_view type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
        if (type == "tRNS") chunks.transparent_color = true;
        if (type == "IEND") chunks.ended = true;
        if (type == "IDAT") {
            const bool another = chunks.first.data() != nullptr;
            if (another && chunks.joined.empty()) chunks.joined = chunks.first;
            another ? void(chunks.joined += data) : void(chunks.first = data);
        }
        at += overhead + length;
    }
    if (!chunks.ended && at != bytes.size()) return std::nullopt;
    return chunks;
}

std::string png_file(std::uint32_t width, std::uint32_t height, char bits, char color_type,
                     std::string_view pixels) {
    std::string header;
    append_big_endian(header, width);
    append_big_endian(header, height);
    header += {bits, color_type, 0, 0, 0};  // compression, filters, not interlaced
    std::string file(png_signature);
    append_chunk(file, "IHDR", header);
    append_chunk(file, "IDAT", pixels);
    append_chunk(file, "IEND", "");
    return file;
}

}  // namespace slipface
