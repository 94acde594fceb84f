// WebP through libwebp, where there is one.
#pragma once

#include <optional>
#include <string_view>

#include "slipface/base/result.h"
#include "slipface/image/image.h"

namespace slipface {

bool is_webp(std::string_view bytes);

struct WebpSize {
    int width = 0, height = 0;
};
// Errors, without a location: damaged, with several pictures, or a build without libwebp.
Result<WebpSize> webp_size(std::string_view bytes);
std::optional<Image> decode_webp(std::string_view bytes, const WebpSize& size);  // nothing: damaged

}  // namespace slipface
