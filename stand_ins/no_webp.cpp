// Instead of the reader of WebP, which needs libwebp.
#include "webp.h"

namespace slipface {

Result<WebpSize> webp_size(std::string_view) {
    return Error{"", "is a WebP image, which only Slipface with libwebp reads (on Linux): save it as PNG"};
}

std::optional<Image> decode_webp(std::string_view, const WebpSize&) {
    return std::nullopt;
}

}  // namespace slipface
