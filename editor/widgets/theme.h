// Colours, spacing and fonts. All sizes are in design pixels times scale.
#pragma once

#include <string>

#include "widgets/imgui_compat.h"

namespace slipface::ui {

// Colours for what panels draw themselves. The defaults are the dark theme's.
struct Palette {
    ImVec4 window{0.094f, 0.102f, 0.118f, 1.0f};  // behind everything
    ImVec4 panel{0.122f, 0.133f, 0.153f, 1.0f};
    ImVec4 popup{0.137f, 0.149f, 0.173f, 1.0f};
    ImVec4 raised{0.165f, 0.180f, 0.208f, 1.0f};  // frames, buttons
    ImVec4 hovered{0.208f, 0.227f, 0.263f, 1.0f};
    ImVec4 pressed{0.247f, 0.271f, 0.314f, 1.0f};
    ImVec4 border{0.067f, 0.073f, 0.086f, 1.0f};
    ImVec4 hairline{0.196f, 0.212f, 0.243f, 1.0f};
    ImVec4 text{0.875f, 0.890f, 0.914f, 1.0f};
    ImVec4 muted{0.545f, 0.580f, 0.635f, 1.0f};
    ImVec4 accent{0.945f, 0.690f, 0.330f, 1.0f};  // sand in the sun; for text and backgrounds
    ImVec4 on_accent{0.110f, 0.086f, 0.047f, 1.0f};
    ImVec4 bad{0.937f, 0.400f, 0.361f, 1.0f};
    ImVec4 good{0.451f, 0.780f, 0.545f, 1.0f};
    ImVec4 view_top{0.16f, 0.18f, 0.21f, 1.0f};  // behind the level
    ImVec4 view_bottom{0.09f, 0.10f, 0.12f, 1.0f};
    ImVec4 shade{0.02f, 0.02f, 0.03f, 0.55f};  // over the window while a dialog is open
};
const Palette& palette();  // of the current theme
void use_light_palette(bool light);
bool light_palette();

inline ImVec4 with_alpha(ImVec4 color, float alpha) {
    return {color.x, color.y, color.z, color.w * alpha};
}
inline ImU32 packed(const ImVec4& color) {
    return ImGui::ColorConvertFloat4ToU32(color);
}

// Sets all of the current ImGui context's style.
void apply_theme(float scale);

struct Fonts {
    Font regular;   // with icons
    Font semibold;  // with icons
    Font small;
    Font title;  // welcome screen
};
// Replaces the fonts in the current context's atlas by the embedded ones at `scale`. Call it only between
// frames; the renderer must then upload the atlas again.
void load_fonts(float scale);
const Fonts& fonts();
// The releases that decide an interface's pixels: "Dear ImGui 1.86, letters 5f1c09aa".
std::string interface_release();

}  // namespace slipface::ui
