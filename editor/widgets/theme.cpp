#include "widgets/theme.h"

#include <algorithm>

namespace slipface::ui {

namespace {

// Warm paper instead of night; all text has a contrast of at least 4.5:1 with its background.
const Palette light_colors{
    .window{0.875f, 0.867f, 0.847f, 1.0f},
    .panel{0.957f, 0.953f, 0.941f, 1.0f},
    .popup{0.988f, 0.984f, 0.976f, 1.0f},
    .raised{0.894f, 0.886f, 0.867f, 1.0f},
    .hovered{0.847f, 0.835f, 0.808f, 1.0f},
    .pressed{0.788f, 0.773f, 0.741f, 1.0f},
    .border{0.745f, 0.733f, 0.706f, 1.0f},
    .hairline{0.812f, 0.800f, 0.773f, 1.0f},
    .text{0.129f, 0.137f, 0.157f, 1.0f},
    .muted{0.349f, 0.369f, 0.408f, 1.0f},
    .accent{0.588f, 0.318f, 0.016f, 1.0f},
    .on_accent{1.0f, 0.984f, 0.957f, 1.0f},
    .bad{0.722f, 0.133f, 0.110f, 1.0f},
    .good{0.086f, 0.420f, 0.196f, 1.0f},
    .view_top{0.804f, 0.835f, 0.867f, 1.0f},
    .view_bottom{0.655f, 0.682f, 0.714f, 1.0f},
    .shade{0.20f, 0.19f, 0.17f, 0.40f},
};
const Palette dark_colors{};
const Palette* colors_in_use = &dark_colors;

}  // namespace

const Palette& palette() {
    return *colors_in_use;
}
void use_light_palette(bool light) {
    colors_in_use = light ? &light_colors : &dark_colors;
}
bool light_palette() {
    return colors_in_use == &light_colors;
}

void apply_theme(float scale) {
    const Palette& p = palette();
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);

    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 5};
    style.CellPadding = {6, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 16;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.TabBorderSize = 0;
    style.WindowRounding = 6;
    style.ChildRounding = 0;
    style.FrameRounding = 5;
    style.PopupRounding = 6;
    style.ScrollbarRounding = 6;
    style.GrabRounding = 4;
    style.TabRounding = 5;
    style.WindowTitleAlign = {0.0f, 0.5f};
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.DisabledAlpha = 0.42f;
    style.DisplayWindowPadding = {8, 8};
    style.DisplaySafeAreaPadding = {0, 0};
    style.ScaleAllSizes(scale);
    style.PopupBorderSize = std::max(1.0f, scale);

    ImVec4* color = style.Colors;
    const ImVec4 clear{0, 0, 0, 0};
    color[ImGuiCol_Text] = p.text;
    color[ImGuiCol_TextDisabled] = p.muted;
    color[ImGuiCol_WindowBg] = p.panel;
    color[ImGuiCol_ChildBg] = clear;
    color[ImGuiCol_PopupBg] = p.popup;
    color[ImGuiCol_Border] = p.hairline;
    color[ImGuiCol_BorderShadow] = clear;
    color[ImGuiCol_FrameBg] = p.raised;
    color[ImGuiCol_FrameBgHovered] = p.hovered;
    color[ImGuiCol_FrameBgActive] = p.pressed;
    color[ImGuiCol_TitleBg] = p.panel;
    color[ImGuiCol_TitleBgActive] = p.raised;
    color[ImGuiCol_TitleBgCollapsed] = p.panel;
    color[ImGuiCol_MenuBarBg] = p.window;
    color[ImGuiCol_ScrollbarBg] = clear;
    color[ImGuiCol_ScrollbarGrab] = p.hovered;
    color[ImGuiCol_ScrollbarGrabHovered] = p.pressed;
    color[ImGuiCol_ScrollbarGrabActive] = p.muted;
    color[ImGuiCol_CheckMark] = p.accent;
    color[ImGuiCol_SliderGrab] =
        with_alpha(p.accent, 0.42f);  // transparent, so that the value behind it can be read
    color[ImGuiCol_SliderGrabActive] = with_alpha(p.accent, 0.7f);
    color[ImGuiCol_Button] = p.raised;
    color[ImGuiCol_ButtonHovered] = p.hovered;
    color[ImGuiCol_ButtonActive] = p.pressed;
    color[ImGuiCol_Header] = with_alpha(p.accent, 0.20f);
    color[ImGuiCol_HeaderHovered] = p.hovered;
    color[ImGuiCol_HeaderActive] = p.pressed;
    color[ImGuiCol_Separator] = p.hairline;
    color[ImGuiCol_SeparatorHovered] = p.accent;
    color[ImGuiCol_SeparatorActive] = p.accent;
    color[ImGuiCol_ResizeGrip] = clear;
    color[ImGuiCol_ResizeGripHovered] = p.pressed;
    color[ImGuiCol_ResizeGripActive] = p.accent;
    color[ImGuiCol_Tab] = clear;
    color[ImGuiCol_TabHovered] = p.hovered;
    color[ImGuiCol_TabActive] = p.raised;
    color[ImGuiCol_TabUnfocused] = clear;
    color[ImGuiCol_TabUnfocusedActive] = p.raised;
    color[ImGuiCol_TableHeaderBg] = p.panel;
    color[ImGuiCol_TableBorderStrong] = p.hairline;
    color[ImGuiCol_TableBorderLight] = with_alpha(p.hairline, 0.6f);
    color[ImGuiCol_TableRowBgAlt] = with_alpha(p.text, 0.025f);
    color[ImGuiCol_TextSelectedBg] = with_alpha(p.accent, 0.30f);
    color[ImGuiCol_DragDropTarget] = p.accent;
    color[ImGuiCol_NavHighlight] = with_alpha(p.accent, 0.8f);
    color[ImGuiCol_NavWindowingHighlight] = p.accent;
    color[ImGuiCol_NavWindowingDimBg] = {0, 0, 0, 0.35f};
    color[ImGuiCol_ModalWindowDimBg] = p.shade;
    color[ImGuiCol_PlotHistogram] = with_alpha(p.accent, 0.75f);
    ImGui::GetStyle() = style;
}

}  // namespace slipface::ui
