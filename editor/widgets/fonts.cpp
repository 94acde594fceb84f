#include <algorithm>
#include <cmath>

#include "widgets/own_icons.h"
#include "widgets/theme.h"

// Embedded by the assembler from the files that CMake found.
extern "C" {
extern const unsigned char slipface_font_regular[], slipface_font_regular_end[];
extern const unsigned char slipface_font_semibold[], slipface_font_semibold_end[];
extern const unsigned char slipface_font_icons[], slipface_font_icons_end[];
}

namespace slipface::ui {
namespace {

Fonts loaded;

// Latin with its extensions, Greek letters of formulas, punctuation, arrows, mathematical signs, geometric
// shapes.
const ImWchar text_ranges[] = {0x0020, 0x00ff, 0x0100, 0x017f, 0x0391, 0x03c9, 0x2010, 0x205e, 0x20ac,
                               0x20ac, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
const ImWchar icon_ranges[] = {0xf000, 0xf2e0, 0};

void add(const unsigned char* begin, const unsigned char* end, float pixels, const ImWchar* ranges,
         bool merge, ImFont** font) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    config.OversampleV = 1;
    config.RasterizerMultiply =
        light_palette() ? 1.0f : 1.12f;  // light text on a dark background looks thinner than it is
    config.MergeMode = merge;
    if (merge) {
        config.GlyphMinAdvanceX = std::round(pixels * 1.15f);  // icons of one width line up in menus
        config.GlyphOffset.y = std::round(pixels * 0.06f);
        config.PixelSnapH = true;
    }
    ImFont* const result = ImGui::GetIO().Fonts->AddFontFromMemoryTTF(
        const_cast<unsigned char*>(begin), static_cast<int>(end - begin), pixels, &config, ranges);
    if (font) *font = result;
}

}  // namespace

void load_fonts(float scale) {
    const auto pixels = [scale](float design) { return std::max(6.0f, std::round(design * scale)); };
    loaded = {};
    ImGui::GetIO().Fonts->Clear();
    add(slipface_font_regular, slipface_font_regular_end, pixels(16), text_ranges, false, &loaded.regular);
    add(slipface_font_icons, slipface_font_icons_end, pixels(14), icon_ranges, true, nullptr);
    add(slipface_font_semibold, slipface_font_semibold_end, pixels(16), text_ranges, false, &loaded.semibold);
    add(slipface_font_icons, slipface_font_icons_end, pixels(14), icon_ranges, true, nullptr);
    add(slipface_font_regular, slipface_font_regular_end, pixels(14), text_ranges, false, &loaded.small);
    add(slipface_font_semibold, slipface_font_semibold_end, pixels(30), text_ranges, false, &loaded.title);
    ImGui::GetIO().FontDefault = loaded.regular;
    draw_own_icons(*ImGui::GetIO().Fonts, {loaded.regular, loaded.semibold}, pixels(14));
}

const Fonts& fonts() {
    return loaded;
}

}  // namespace slipface::ui
