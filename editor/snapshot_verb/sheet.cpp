#include "snapshot_verb/sheet.h"

#include <fmt/format.h>
#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>

extern "C" {
extern const unsigned char slipface_font_regular[];
}

namespace slipface {

namespace {

constexpr int gap = 12, caption = 26;
constexpr float caption_size = 17.0f;
constexpr int text_grey = 225;

// Each pixel is the mean of the pixels that it covers; images are never enlarged.
Image shrunk(const Image& image, int width, int height) {
    const double scale =
        std::min({1.0, static_cast<double>(width) / image.width, static_cast<double>(height) / image.height});
    if (scale >= 1.0) return image;
    const int to_width = std::max(1, static_cast<int>(image.width * scale)),
              to_height = std::max(1, static_cast<int>(image.height * scale));
    Image small = make_image(to_width, to_height, 0, 0, 0);
    for (int y = 0; y < to_height; ++y) {
        const int top = y * image.height / to_height,
                  bottom = std::max(top + 1, (y + 1) * image.height / to_height);
        for (int x = 0; x < to_width; ++x) {
            const int left = x * image.width / to_width,
                      right = std::max(left + 1, (x + 1) * image.width / to_width);
            int sum[3] = {0, 0, 0};
            for (int from_y = top; from_y < bottom; ++from_y)
                for (int from_x = left; from_x < right; ++from_x)
                    for (int c = 0; c < 3; ++c)
                        sum[c] += image.pixel(from_x, from_y)[c];
            const int count = (bottom - top) * (right - left);
            for (int c = 0; c < 3; ++c)
                small.pixel(x, y)[c] = static_cast<std::uint8_t>(sum[c] / count);
        }
    }
    return small;
}

void paste(Image& sheet, const Image& image, int left, int top) {
    for (int y = 0; y < std::min(image.height, sheet.height - top); ++y)
        std::copy_n(image.pixel(0, y), 4 * std::min(image.width, sheet.width - left),
                    sheet.pixel(left, top + y));
}

}  // namespace

void draw_text(Image& image, int x, int y, int right, const std::string& text, float pixels) {
    stbtt_fontinfo font;
    if (stbtt_InitFont(&font, slipface_font_regular, stbtt_GetFontOffsetForIndex(slipface_font_regular, 0)) ==
        0)
        return;
    const float scale = stbtt_ScaleForPixelHeight(&font, pixels);
    float pen = static_cast<float>(x);
    for (const char c : text) {
        int advance = 0, bearing = 0, left = 0, top = 0, width = 0, height = 0;
        const int letter = static_cast<unsigned char>(c) < 0x7f ? c : '?';
        stbtt_GetCodepointHMetrics(&font, letter, &advance, &bearing);
        unsigned char* const bitmap =
            stbtt_GetCodepointBitmap(&font, scale, scale, letter, &width, &height, &left, &top);
        const int start = static_cast<int>(std::lround(pen)) + left;
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                const int px = start + column, py = y + top + row;
                if (px < 0 || py < 0 || px >= std::min(right, image.width) || py >= image.height) continue;
                const int ink = bitmap[row * width + column];
                for (int channel = 0; channel < 3; ++channel) {
                    std::uint8_t& value = image.pixel(px, py)[channel];
                    value = static_cast<std::uint8_t>(value + (text_grey - value) * ink / 255);
                }
            }
        }
        stbtt_FreeBitmap(bitmap, nullptr);
        pen += static_cast<float>(advance) * scale;
    }
}

Result<std::vector<std::filesystem::path>> write_sheets(
    const std::vector<std::pair<std::string, std::filesystem::path>>& images,
    const std::filesystem::path& out, const SheetOptions& options) {
    const int columns = std::max(1, options.columns);
    const int cell_width = (options.width - gap) / columns - gap;
    const int cell_height = cell_width * 9 / 16;
    const int rows = std::max(1, (options.height - gap) / (cell_height + caption + gap));
    const auto per_sheet = static_cast<std::size_t>(columns * rows);
    std::vector<std::filesystem::path> files;
    for (std::size_t first = 0; first < images.size(); first += per_sheet) {
        const auto count = static_cast<int>(std::min(per_sheet, images.size() - first));
        const int used_rows = (count + columns - 1) / columns;
        Image sheet = make_image(options.width, gap + used_rows * (cell_height + caption + gap), 34, 37, 43);
        for (int i = 0; i < count; ++i) {
            const auto& [name, file] = images[first + static_cast<std::size_t>(i)];
            const int left = gap + i % columns * (cell_width + gap),
                      top = gap + i / columns * (cell_height + caption + gap);
            draw_text(sheet, left, top + 18, left + cell_width, name, caption_size);
            const Result<Image> image = load_image(file);
            if (!image) {
                draw_text(sheet, left, top + caption + 24, left + cell_width, image.error().text(),
                          caption_size);
                continue;
            }
            paste(sheet, shrunk(*image, cell_width, cell_height), left, top + caption);
        }
        const std::filesystem::path path = out / fmt::format("sheet-{:02}.png", files.size() + 1);
        if (Status status = save_png(path, sheet); !status) return status.error();
        files.push_back(path);
    }
    return files;
}

}  // namespace slipface
