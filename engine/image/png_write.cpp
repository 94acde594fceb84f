// Writing PNG files. Images without transparency are written with three bytes per pixel.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#include "png_chunk.h"
#include "png_rows.h"
#include "slipface/base/files.h"
#include "slipface/image/image.h"
#include "slipface/image/pack.h"

namespace slipface {

namespace {

constexpr std::size_t largest_written = std::size_t{1} << 30;

bool opaque(const Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return false;
    return true;
}

// The bytes of the image as stored in the file, rows from the top.
struct Raw {
    std::size_t bytes_per_pixel = 4, row_bytes = 0, rows = 0;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint8_t> nothing;  // the row above the first

    std::span<const std::uint8_t> row(std::size_t y) const {
        return std::span(bytes).subspan(y * row_bytes, row_bytes);
    }
    std::span<const std::uint8_t> above(std::size_t y) const {
        return y == 0 ? std::span<const std::uint8_t>(nothing) : row(y - 1);
    }
};

Raw raw_bytes(const Image& image) {
    Raw raw;
    raw.rows = static_cast<std::size_t>(image.height);
    raw.bytes_per_pixel = opaque(image) ? 3 : 4;
    raw.row_bytes = raw.bytes_per_pixel * static_cast<std::size_t>(image.width);
    raw.nothing.assign(raw.row_bytes, 0);
    if (raw.bytes_per_pixel == 4) {
        raw.bytes = image.rgba;
        return raw;
    }
    raw.bytes.resize(raw.row_bytes * raw.rows);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            raw.bytes[3 * i + c] = image.rgba[4 * i + c];
    }
    return raw;
}

// Estimates how well a filtered row will compress; less is better.
using Cost = std::size_t (*)(std::span<const std::uint8_t> row);

// Bytes near zero compress well.
std::size_t sum_of_sizes(std::span<const std::uint8_t> row) {
    std::size_t sum = 0;
    for (const std::uint8_t byte : row)
        sum += static_cast<std::size_t>(std::abs(static_cast<int>(static_cast<std::int8_t>(byte))));
    return sum;
}

// Repeated pairs compress well.
std::size_t different_pairs(std::span<const std::uint8_t> row) {
    static thread_local std::vector<std::uint64_t> seen(65536 / 64);
    std::fill(seen.begin(), seen.end(), 0);
    std::size_t count = 0;
    for (std::size_t i = 1; i < row.size(); ++i) {
        const std::size_t pair = static_cast<std::size_t>(row[i - 1]) << 8U | row[i];
        const std::uint64_t bit = std::uint64_t{1} << (pair % 64);
        if ((seen[pair / 64] & bit) != 0) continue;
        seen[pair / 64] |= bit;
        ++count;
    }
    return count;
}

std::string filtered(const Raw& raw, int filter) {
    std::string out(raw.rows * (raw.row_bytes + 1), '\0');
    auto* to = reinterpret_cast<std::uint8_t*>(out.data());
    for (std::size_t y = 0; y < raw.rows; ++y, to += raw.row_bytes + 1) {
        *to = static_cast<std::uint8_t>(filter);
        png_filter_row(filter, raw.row(y), raw.above(y), raw.bytes_per_pixel, to + 1);
    }
    return out;
}

// Filters each row with the filter of the lowest cost.
std::string filtered(const Raw& raw, Cost cost) {
    std::string out(raw.rows * (raw.row_bytes + 1), '\0');
    auto* to = reinterpret_cast<std::uint8_t*>(out.data());
    std::vector<std::uint8_t> tried(raw.row_bytes);
    for (std::size_t y = 0; y < raw.rows; ++y, to += raw.row_bytes + 1) {
        std::size_t best = std::numeric_limits<std::size_t>::max();
        for (int filter = 0; filter < png_filters; ++filter) {
            png_filter_row(filter, raw.row(y), raw.above(y), raw.bytes_per_pixel, tried.data());
            const std::size_t found = cost(tried);
            if (found >= best) continue;
            best = found;
            *to = static_cast<std::uint8_t>(filter);
            std::copy(tried.begin(), tried.end(), to + 1);
        }
    }
    return out;
}

std::string smallest_packing(const Raw& raw) {
    std::string best, best_packed;
    const auto consider = [&](std::string candidate) {
        std::string packed = pack(candidate, pack_usual);
        if (!best.empty() && packed.size() >= best_packed.size()) return;
        best = std::move(candidate);
        best_packed = std::move(packed);
    };
    for (int filter = 0; filter < png_filters; ++filter)
        consider(filtered(raw, filter));
    consider(filtered(raw, sum_of_sizes));
    consider(filtered(raw, different_pairs));
    return pack(best, pack_smallest);
}

}  // namespace

Result<std::string> encode_png(const Image& image, PngEffort effort) try {
    if (image.width < 1 || image.height < 1 || image.rgba.size() != 4 * image.pixel_count() ||
        image.rgba.size() > largest_written) {
        return Error{"picture", fmt::format("cannot hold an image of {} x {} pixels and {} bytes",
                                            image.width, image.height, image.rgba.size())};
    }
    const Raw raw = raw_bytes(image);
    return png_file(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), 8,
                    raw.bytes_per_pixel == 3 ? 2 : 6,
                    effort == PngEffort::small ? smallest_packing(raw) : pack(filtered(raw, 2), pack_fast));
} catch (const std::bad_alloc&) {
    return Error{"picture", "needs more memory than there is"};
}

Status save_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
    const Result<std::string> bytes = encode_png(image, effort);
    if (!bytes) return Error{path.string(), bytes.error().message};
    return write_file_atomic(path, *bytes);
}

}  // namespace slipface
