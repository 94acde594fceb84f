// What lies flat on the view: the playtest's numbers and the axes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "panels/viewport_panel.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double look_radians_per_pixel = 0.0028;

// A rounded plate with lines of text, its corner at `min`.
void plate(ImDrawList& list, ImVec2 min, const std::array<std::string, 3>& lines) {
    const float scale = ui::scale(), line = ImGui::GetTextLineHeight() + 3 * scale;
    float width = 0.0f;
    for (const std::string& text : lines)
        width = std::max(width, ImGui::CalcTextSize(text.c_str()).x);
    const ImVec2 padding{12 * scale, 9 * scale};
    list.AddRectFilled(min, {min.x + width + 2 * padding.x, min.y + 3 * line + 2 * padding.y - 3 * scale},
                       ui::packed(ui::with_alpha(ui::palette().window, 0.82f)), 6 * scale);
    for (std::size_t i = 0; i < lines.size(); ++i)
        list.AddText({min.x + padding.x, min.y + padding.y + static_cast<float>(i) * line},
                     ui::packed(i == 0 ? ui::palette().text : ui::palette().muted), lines[i].c_str());
}

constexpr float axis_dot = 9.0f, axis_reach = 30.0f, axis_margin = 52.0f;  // design pixels

struct Axis {
    const char* name;
    Vec3 direction;
    ImU32 color;
    double depth;
    ImVec2 tip;
};

bool axes_fit(const ViewportState& state) {
    return state.size.x >= 260 * ui::scale() && state.size.y >= 200 * ui::scale();
}

ImVec2 axis_centre(const ViewportState& state) {
    const float margin = axis_margin * ui::scale();
    return {state.min.x + state.size.x - margin, state.min.y + margin};
}

std::array<Axis, 6> axes_back_to_front(const Camera& camera, const ViewportState& state) {
    constexpr ImU32 red = IM_COL32(222, 92, 88, 255), green = IM_COL32(116, 184, 92, 255),
                    blue = IM_COL32(88, 142, 226, 255);
    std::array<Axis, 6> axes{{{"X", Vec3::UnitX(), red, 0, {}},
                              {"Y", Vec3::UnitY(), green, 0, {}},
                              {"Z", Vec3::UnitZ(), blue, 0, {}},
                              {"-X", -Vec3::UnitX(), red, 0, {}},
                              {"-Y", -Vec3::UnitY(), green, 0, {}},
                              {"-Z", -Vec3::UnitZ(), blue, 0, {}}}};
    const Mat4 view = view_from_world(camera);
    const float reach = axis_reach * ui::scale();
    const ImVec2 centre = axis_centre(state);
    for (Axis& axis : axes) {
        const Vec3 seen = view.block<3, 3>(0, 0) * axis.direction;
        axis.depth = seen.z();
        axis.tip = {centre.x + reach * static_cast<float>(seen.x()),
                    centre.y - reach * static_cast<float>(seen.y())};
    }
    std::stable_sort(axes.begin(), axes.end(),
                     [](const Axis& a, const Axis& b) { return a.depth < b.depth; });
    return axes;
}

}  // namespace

void playtest_frame(Editor& editor, FrameContext& frame) {
    Playtest& playtest = *editor.playtest;
    const HeldKeys& held = frame.held;
    PlaytestInput input;
    input.stick = Vec2((held.right ? 1.0 : 0.0) - (held.left ? 1.0 : 0.0),
                       (held.forward ? 1.0 : 0.0) - (held.back ? 1.0 : 0.0)) +
                  held.stick;
    if (input.stick.norm() > 1.0) input.stick.normalize();
    input.jump = held.jump;
    input.look = Vec2(held.look_pixels.x(), -held.look_pixels.y()) * look_radians_per_pixel +
                 held.look_stick * frame.seconds;
    const float wheel = ImGui::GetIO().MouseWheel;
    if (wheel != 0.0f)
        playtest.boom = std::clamp(playtest.boom * std::pow(0.88, static_cast<double>(wheel)), 1.0, 30.0);
    playtest.advance(editor.document->scene(), editor.document->level().movement, input, frame.seconds);
    frame.wants_cursor_capture = true;
    frame.animating = true;
}

void playtest_hud(const Editor& editor, const ViewportState& state) {
    const float scale = ui::scale();
    const PlayerState& player = editor.playtest->state();
    const auto& surfaces = editor.document->level().surfaces;
    const std::string ground =
        player.ground_surface < surfaces.size() ? surfaces[player.ground_surface].name : "default";
    std::string stance = "in the air";
    if (player.grounded) stance = "on " + ground;
    if (player.climbing) stance = "climbing " + ground;
    if (player.stuck) stance = "stuck to " + ground;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    plate(list, {state.min.x + 14 * scale, state.min.y + 14 * scale},
          {fmt::format("{:.2f} m/s", editor.playtest->speed()), stance,
           fmt::format("{:.2f}, {:.2f}, {:.2f}", player.position.x(), player.position.y(),
                       player.position.z())});
    const char* const help = "Esc: back to editing";
    const ImVec2 size = ImGui::CalcTextSize(help);
    const ImVec2 at{state.min.x + (state.size.x - size.x) * 0.5f,
                    state.min.y + state.size.y - size.y - 22 * scale};
    list.AddRectFilled({at.x - 12 * scale, at.y - 6 * scale},
                       {at.x + size.x + 12 * scale, at.y + size.y + 6 * scale},
                       ui::packed(ui::with_alpha(ui::palette().window, 0.82f)), 14 * scale);
    list.AddText(at, ui::packed(ui::palette().muted), help);
}

void axis_buttons(Editor& editor, ViewportState& state) {
    state.lit_axis = nullptr;
    const float dot = axis_dot * ui::scale();
    if (!axes_fit(state)) return;
    const ui::Scope scope("Axis");
    const std::array<Axis, 6> axes = axes_back_to_front(editor.view.camera(), state);
    // Items first come first served: the nearest tip gets the click.
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        ImGui::SetCursorScreenPos({axis->tip.x - dot, axis->tip.y - dot});
        const bool pressed = ImGui::InvisibleButton(axis->name, {2 * dot, 2 * dot});
        ui::record_last_item(axis->name);
        if (ImGui::IsItemHovered()) state.lit_axis = axis->name;
        if (pressed)
            editor.view.look_at(editor.view.pivot + axis->direction * editor.view.distance,
                                editor.view.pivot);
    }
}

void draw_axes(const Editor& editor, const ViewportState& state) {
    if (!axes_fit(state)) return;
    const float scale = ui::scale(), dot = axis_dot * scale;
    const ImVec2 centre = axis_centre(state);
    const ImFont* const font = ui::fonts().small;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Axis& axis : axes_back_to_front(editor.view.camera(), state)) {
        const bool positive = axis.name[0] != '-';
        const bool lit = state.lit_axis && std::string_view(state.lit_axis) == axis.name;
        const ImU32 color = positive || lit ? axis.color : (axis.color & 0x00ffffffu) | 0x66000000u;
        if (positive) list.AddLine(centre, axis.tip, color, 2.5f * scale);
        list.AddCircleFilled(axis.tip, positive || lit ? dot : dot * 0.62f, color, 20);
        if (!positive) continue;
        const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, axis.name);
        list.AddText(font, font->FontSize, {axis.tip.x - size.x * 0.5f, axis.tip.y - size.y * 0.5f},
                     IM_COL32(20, 22, 26, 255), axis.name);
    }
}

}  // namespace slipface
