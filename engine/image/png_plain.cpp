#include "png_plain.h"

#include <span>

#include "png_chunk.h"
#include "png_limit.h"
#include "png_rows.h"
#include "slipface/image/pack.h"

namespace slipface {

std::optional<Image> decode_plain_png(std::string_view bytes) {
    constexpr std::size_t header_chunk_end = 33;
    const std::optional<PngSize> size = png_size(bytes);
    if (!size || size->width == 0 || size->height == 0 || bytes.size() < header_chunk_end)
        return std::nullopt;
    const char bits = bytes[24], color_type = bytes[25], packing = bytes[26], filtering = bytes[27],
               interlaced = bytes[28];
    if (bits != 8 || (color_type != 2 && color_type != 6) || packing != 0 || filtering != 0 ||
        interlaced != 0)
        return std::nullopt;
    const std::optional<PngChunks> chunks = png_chunks(bytes);
    if (!chunks || !chunks->ended || chunks->transparent_color) return std::nullopt;

    const std::size_t step = color_type == 2 ? 3 : 4;
    const std::size_t row_bytes = step * size->width;
    std::optional<std::string> rows = unpack(chunks->pixels(), size->height * (row_bytes + 1));
    if (!rows) return std::nullopt;
    Image image{.width = static_cast<int>(size->width), .height = static_cast<int>(size->height), .rgba = {}};
    image.rgba.resize(4 * image.pixel_count());
    const std::string nothing(row_bytes, '\0');
    const auto* above = reinterpret_cast<const std::uint8_t*>(nothing.data());
    for (std::size_t y = 0; y < size->height; ++y) {
        auto* row = reinterpret_cast<std::uint8_t*>(rows->data()) + y * (row_bytes + 1);
        if (!png_unfilter_row(row[0], {row + 1, row_bytes}, {above, row_bytes}, step)) return std::nullopt;
        above = row + 1;
        std::uint8_t* out = image.rgba.data() + 4 * y * size->width;
        for (std::size_t x = 0; x < size->width; ++x, out += 4) {
            for (std::size_t c = 0; c < 3; ++c)
                out[c] = above[step * x + c];
            out[3] = step == 4 ? above[step * x + 3] : 255;
        }
    }
    return image;
}

}  // namespace slipface
