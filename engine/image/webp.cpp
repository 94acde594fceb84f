#include "webp.h"

#include <webp/decode.h>

namespace slipface {

Result<WebpSize> webp_size(std::string_view bytes) {
    WebPBitstreamFeatures found;
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (WebPGetFeatures(data, bytes.size(), &found) != VP8_STATUS_OK)
        return Error{"", "is a damaged WebP image"};
    if (found.has_animation != 0)
        return Error{"", "is an animated WebP image, which is not read: save one of its pictures"};
    return WebpSize{found.width, found.height};
}

std::optional<Image> decode_webp(std::string_view bytes, const WebpSize& size) {
    Image image = make_image(size.width, size.height, 0, 0, 0);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (WebPDecodeRGBAInto(data, bytes.size(), image.rgba.data(), image.rgba.size(), 4 * size.width) ==
        nullptr)
        return std::nullopt;
    return image;
}

}  // namespace slipface
