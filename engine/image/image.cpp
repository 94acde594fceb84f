#include "slipface/image/image.h"

#include <algorithm>

namespace slipface {

Image make_image(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue,
                 std::uint8_t alpha) {
    Image image{.width = std::max(width, 0), .height = std::max(height, 0), .rgba = {}};
    image.rgba.resize(4 * image.pixel_count());
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        image.rgba[i] = red;
        image.rgba[i + 1] = green;
        image.rgba[i + 2] = blue;
        image.rgba[i + 3] = alpha;
    }
    return image;
}

}  // namespace slipface
