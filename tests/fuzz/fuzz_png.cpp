// Any bytes as a picture: an error, or one of the size that it says.
#include <cstdlib>
#include <string_view>

#include "slipface/image/image.h"

using namespace slipface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto image = decode_image({reinterpret_cast<const char*>(data), size}, "picture", 512);
    if (image && image->rgba.size() != 4 * image->pixel_count()) std::abort();
    return 0;
}
