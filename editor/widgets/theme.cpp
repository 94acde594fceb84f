#include "widgets/theme.h"

#include <algorithm>

namespace slipface::ui {

const Palette& palette() {
    static const Palette colors;
    return colors;
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
    color[ImGuiCol_PopupBg] = {0.137f, 0.149f, 0.173f, 1.0f};
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
    color[ImGuiCol_SliderGrab] = with_alpha(p.accent, 0.42f);  // the value is read through it
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
    color[ImGuiCol_TableRowBgAlt] = {1, 1, 1, 0.025f};
    color[ImGuiCol_TextSelectedBg] = with_alpha(p.accent, 0.30f);
    color[ImGuiCol_DragDropTarget] = p.accent;
    color[ImGuiCol_NavHighlight] = with_alpha(p.accent, 0.8f);
    color[ImGuiCol_NavWindowingHighlight] = p.accent;
    color[ImGuiCol_NavWindowingDimBg] = {0, 0, 0, 0.35f};
    color[ImGuiCol_ModalWindowDimBg] = {0.02f, 0.02f, 0.03f, 0.55f};
    ImGui::GetStyle() = style;
}

}  // namespace slipface::ui
