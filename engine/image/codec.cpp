#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>

#include "png_limit.h"
#include "png_plain.h"
#include "slipface/base/files.h"
#include "slipface/image/image.h"
#include "webp.h"

namespace slipface {
namespace {

constexpr std::size_t largest_file = std::size_t{512} << 20;

constexpr const char* formats_read = "PNG, JPEG, WebP, GIF, TGA or BMP";

// Formats that other programs use for textures, by the bytes at `at`: to name what is not read. Some stb
// would try; they are seldom tested.
struct OtherFormat {
    std::string_view name, bytes;
    std::size_t at = 0;
};
using namespace std::string_view_literals;
constexpr std::array others{OtherFormat{"TIFF", "II*\0"sv},
                            OtherFormat{"TIFF", "MM\0*"sv},
                            OtherFormat{"SGI", "\x01\xDA"sv},
                            OtherFormat{"DDS", "DDS "sv},
                            OtherFormat{"KTX", "\xABKTX"sv},
                            OtherFormat{"Photoshop", "8BPS"sv},
                            OtherFormat{"Softimage", "\x53\x80\xF6\x34"sv},
                            OtherFormat{"PNM", "P5"sv},
                            OtherFormat{"PNM", "P6"sv},
                            OtherFormat{"Radiance HDR", "#?"sv},
                            OtherFormat{"OpenEXR", "\x76\x2F\x31\x01"sv},
                            OtherFormat{"JPEG 2000", "\0\0\0\x0CjP"sv},
                            OtherFormat{"JPEG XL", "\0\0\0\x0CJXL"sv},
                            OtherFormat{"JPEG XL", "\xFF\x0A"sv},
                            OtherFormat{"AVIF", "ftypavif"sv, 4},
                            OtherFormat{"HEIF", "ftyphei"sv, 4},
                            OtherFormat{"HEIF", "ftypmif1"sv, 4},
                            OtherFormat{"SVG", "<svg"sv},
                            OtherFormat{"SVG", "<?xml"sv}};

const OtherFormat* other_format(std::string_view bytes) {
    const auto* const found = std::find_if(others.begin(), others.end(), [&](const OtherFormat& format) {
        return bytes.size() > format.at && bytes.substr(format.at).starts_with(format.bytes);
    });
    return found == others.end() ? nullptr : found;
}

std::string stb_reason() {
    const char* reason = stbi_failure_reason();
    return reason != nullptr ? reason : "unknown";
}

}  // namespace

bool is_webp(std::string_view bytes) {
    return bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP");
}

Status check_image_header(std::string_view bytes, const std::string& location, int max_side) {
    if (bytes.empty()) return Error{location, fmt::format("is empty; expected a {} image", formats_read)};
    if (bytes.size() > largest_file)
        return Error{location, fmt::format("has {} bytes; too many for an image", bytes.size())};
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());

    const auto too_large = [&](auto width, auto height) {
        return Error{location, fmt::format("is {} x {} pixels; at most {} x {} are read", width, height,
                                           max_side, max_side)};
    };
    const auto limit = static_cast<std::uint32_t>(std::max(max_side, 0));
    // stb refuses the largest headers without reporting their size.
    if (const auto header = png_size(bytes); header && (header->width > limit || header->height > limit)) {
        return too_large(header->width, header->height);
    }
    if (const OtherFormat* other = other_format(bytes))
        return Error{location, fmt::format("is a {} image, which is not read: save it as PNG", other->name)};
    int width = 0;
    int height = 0;
    int channels = 0;
    if (is_webp(bytes)) {
        const Result<WebpSize> webp = webp_size(bytes);
        if (!webp) return Error{location, webp.error().message};
        width = webp->width;
        height = webp->height;
    } else if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
        return Error{location, fmt::format("is no {} image", formats_read)};
    }
    if (width < 1 || height < 1 || width > max_side || height > max_side) return too_large(width, height);
    return {};
}

namespace {

Result<Image> decode(std::string_view bytes, const std::string& location, int max_side) {
    if (Status status = check_image_header(bytes, location, max_side); !status) return status.error();
    if (std::optional<Image> image = decode_plain_png(bytes)) return *std::move(image);
    if (!png_data_fits_header(bytes)) return Error{location, "is corrupt: its data do not fit its size"};
    if (is_webp(bytes)) {
        std::optional<Image> image = decode_webp(bytes, *webp_size(bytes));
        return image ? *std::move(image)
                     : Result<Image>(Error{location, "is corrupt: its WebP data are damaged"});
    }

    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
    if (!pixels) return Error{location, "is corrupt: " + stb_reason()};
    Image image{.width = width, .height = height, .rgba = {}};
    image.rgba.assign(pixels.get(), pixels.get() + 4 * image.pixel_count());
    return image;
}

}  // namespace

Result<Image> decode_image(std::string_view bytes, const std::string& location, int max_side) {
    try {
        return decode(bytes, location, max_side);
    } catch (const std::exception&) {
        return Error{location, "needs more memory than there is"};
    }
}

Result<Image> load_image(const std::filesystem::path& path, int max_side) {
    const auto bytes = read_file(path, largest_file);
    if (!bytes) return bytes.error();
    return decode_image(*bytes, path.string(), max_side);
}

}  // namespace slipface
