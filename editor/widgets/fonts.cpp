#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "slipface/base/hash.h"
#include "widgets/own_icons.h"
#include "widgets/theme.h"

// Embedded by the assembler from the files that CMake found.
extern "C" {
extern const unsigned char slipface_font_regular[], slipface_font_regular_end[];
extern const unsigned char slipface_font_semibold[], slipface_font_semibold_end[];
extern const unsigned char slipface_font_icons[], slipface_font_icons_end[];
#ifdef SLIPFACE_OLD_ICONS
extern const unsigned char slipface_font_old_icons[], slipface_font_old_icons_end[];
#endif
}

namespace slipface::ui {
namespace {

Fonts loaded;

// Latin with its extensions, Greek letters of formulas, punctuation, arrows, mathematical signs, geometric
// shapes.
const ImWchar text_ranges[] = {0x0020, 0x00ff, 0x0100, 0x017f, 0x0391, 0x03c9, 0x2010, 0x205e, 0x20ac,
                               0x20ac, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
const ImWchar icon_ranges[] = {0xf000, 0xf2e0, 0};

// Private letters of a text font would hide icons and icons of our own.
const ImWchar private_ranges[] = {0xe000, 0xf8ff, 0};

ImFont* add(const unsigned char* begin, const unsigned char* end, float pixels, const ImWchar* ranges,
            bool merge) {
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
    } else {
        exclude_glyphs(config, private_ranges);
    }
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(begin),
                                                      static_cast<int>(end - begin), pixels, &config, ranges);
}

Font add_text(bool semibold, float pixels) {
    return {semibold ? add(slipface_font_semibold, slipface_font_semibold_end, pixels, text_ranges, false)
                     : add(slipface_font_regular, slipface_font_regular_end, pixels, text_ranges, false),
            pixels};
}

Font add_text_and_icons(bool semibold, float pixels, float icon_pixels) {
    const Font font = add_text(semibold, pixels);
    add(slipface_font_icons, slipface_font_icons_end, icon_pixels, icon_ranges, true);
#ifdef SLIPFACE_OLD_ICONS
    add(slipface_font_old_icons, slipface_font_old_icons_end, icon_pixels, icon_ranges, true);
#endif
    make_room_for_drawn_glyphs(font);
    return font;
}

}  // namespace

void load_fonts(float scale) {
    const auto pixels = [scale](float design) { return std::max(6.0f, std::round(design * scale)); };
    ImGui::GetIO().Fonts->Clear();
    loaded.regular = add_text_and_icons(false, pixels(16), pixels(14));
    loaded.semibold = add_text_and_icons(true, pixels(16), pixels(14));
    loaded.small = add_text(false, pixels(14));
    loaded.title = add_text(true, pixels(30));
    use_default_font(loaded.regular);
    draw_own_icons({loaded.regular, loaded.semibold}, pixels(14));
}

const Fonts& fonts() {
    return loaded;
}

std::string interface_release() {
    Hasher letters;
    letters.bytes(slipface_font_regular,
                  static_cast<std::size_t>(slipface_font_regular_end - slipface_font_regular));
    letters.bytes(slipface_font_semibold,
                  static_cast<std::size_t>(slipface_font_semibold_end - slipface_font_semibold));
    letters.bytes(slipface_font_icons,
                  static_cast<std::size_t>(slipface_font_icons_end - slipface_font_icons));
    return fmt::format("Dear ImGui {}, letters {:08x}", IMGUI_VERSION,
                       static_cast<std::uint32_t>(letters.value()));
}

}  // namespace slipface::ui
