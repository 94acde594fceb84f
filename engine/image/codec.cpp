#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "png_limit.h"
#include "png_plain.h"
#include "slipface/base/files.h"
#include "slipface/image/image.h"

namespace slipface {
namespace {

constexpr std::size_t largest_file = std::size_t{512} << 20;

// stb would also try formats that are not supported here and seldom tested: GIF, PSD, PIC, PNM, Radiance.
bool promised_format(std::string_view bytes) {
    using namespace std::string_view_literals;
    for (const std::string_view other : {"GIF8"sv, "8BPS"sv, "\x53\x80\xF6\x34"sv, "P5"sv, "P6"sv, "#?"sv}) {
        if (bytes.starts_with(other)) return false;
    }
    return true;
}

std::string stb_reason() {
    const char* reason = stbi_failure_reason();
    return reason != nullptr ? reason : "unknown";
}

}  // namespace

Status check_image_header(std::string_view bytes, const std::string& location, int max_side) {
    if (bytes.empty()) return Error{location, "is empty; expected a PNG, JPEG, TGA or BMP image"};
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
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!promised_format(bytes) || stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
        return Error{location, "is no PNG, JPEG, TGA or BMP image"};
    }
    if (width < 1 || height < 1 || width > max_side || height > max_side) return too_large(width, height);
    return {};
}

namespace {

Result<Image> decode(std::string_view bytes, const std::string& location, int max_side) {
    if (Status status = check_image_header(bytes, location, max_side); !status) return status.error();
    if (std::optional<Image> image = decode_plain_png(bytes)) return *std::move(image);
    if (!png_data_fits_header(bytes)) return Error{location, "is corrupt: its data do not fit its size"};

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

Status check_image(const std::filesystem::path& path, int max_side) {
    const auto bytes = read_file(path, largest_file);
    return bytes ? check_image_header(*bytes, path.string(), max_side) : Status(bytes.error());
}

Result<Image> load_image(const std::filesystem::path& path, int max_side) {
    const auto bytes = read_file(path, largest_file);
    if (!bytes) return bytes.error();
    return decode_image(*bytes, path.string(), max_side);
}

}  // namespace slipface
