// The cube in a view's corner. It shows the direction of view, rotates the view when dragged, and jumps to
// the side, edge or corner that is clicked.
#include <algorithm>
#include <array>
#include <cmath>

#include "panels/viewport_panel.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr float half_side = 23.0f, margin = 54.0f;  // design pixels
constexpr double rim = 0.56;  // of half a side: beyond it a click means an edge or a corner

struct Side {
    const char* name;
    Vec3 out, right, up;  // as seen from outside
    ImU32 color;          // of its axis
};

constexpr ImU32 red = IM_COL32(222, 92, 88, 255), green = IM_COL32(116, 184, 92, 255),
                blue = IM_COL32(88, 142, 226, 255);

const std::array<Side, 6>& sides() {
    static const std::array<Side, 6> all{{{"Right", Vec3::UnitX(), -Vec3::UnitZ(), Vec3::UnitY(), red},
                                          {"Left", -Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY(), red},
                                          {"Top", Vec3::UnitY(), Vec3::UnitX(), -Vec3::UnitZ(), green},
                                          {"Bottom", -Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ(), green},
                                          {"Front", Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY(), blue},
                                          {"Back", -Vec3::UnitZ(), -Vec3::UnitX(), Vec3::UnitY(), blue}}};
    return all;
}

bool fits(const ViewportState& state) {
    return state.size.x >= 240 * ui::scale() && state.size.y >= 180 * ui::scale();
}

// The cube as seen in the view: an orthographic projection of the box from -1 to 1.
struct Placed {
    ImVec2 centre;
    float half;
    Eigen::Matrix3d view;  // view from world

    Placed(const Editor& editor, const ViewportState& state)
        : centre(state.min.x + state.size.x - margin * ui::scale(), state.min.y + margin * ui::scale()),
          half(half_side * ui::scale()),
          view(view_from_world(editor.view.camera()).block<3, 3>(0, 0)) {}

    ImVec2 pixel(const Vec3& point) const {
        const Vec3 seen = view * point;
        return {centre.x + half * static_cast<float>(seen.x()),
                centre.y - half * static_cast<float>(seen.y())};
    }
    bool shows(const Side& side) const { return (view * side.out).z() > 0.02; }

    // The direction that a click at `mouse` views from; nothing outside the cube.
    std::optional<Vec3> direction_at(ImVec2 mouse) const {
        const Vec2 p{static_cast<double>((mouse.x - centre.x) / half),
                     static_cast<double>((centre.y - mouse.y) / half)};
        for (const Side& side : sides()) {
            if (!shows(side)) continue;
            const Vec3 out = view * side.out, right = view * side.right, up = view * side.up;
            // p = out + u right + v up, in the two coordinates of the projection.
            const double determinant = right.x() * up.y() - right.y() * up.x();
            const Vec2 rest = p - out.head<2>();
            const double u = (rest.x() * up.y() - rest.y() * up.x()) / determinant;
            const double v = (right.x() * rest.y() - right.y() * rest.x()) / determinant;
            if (std::abs(u) > 1.0 || std::abs(v) > 1.0) continue;
            Vec3 direction = side.out;
            if (std::abs(u) > rim) direction += side.right * (u > 0.0 ? 1.0 : -1.0);
            if (std::abs(v) > rim) direction += side.up * (v > 0.0 ? 1.0 : -1.0);
            return direction;
        }
        return std::nullopt;
    }
};

void quad(ImDrawList& list, const Placed& cube, const Side& side, Vec2 low, Vec2 high, ImU32 color) {
    const auto corner = [&](double u, double v) {
        return cube.pixel(side.out + u * side.right + v * side.up);
    };
    list.AddQuadFilled(corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()),
                       corner(low.x(), high.y()), color);
}

// The part of this side that belongs to a direction, or nothing.
std::optional<std::pair<Vec2, Vec2>> part_of(const Side& side, const Vec3& direction) {
    if (direction.dot(side.out) < 0.5) return std::nullopt;
    const auto span = [](double along) {
        if (along > 0.5) return Vec2(rim, 1.0);
        return along < -0.5 ? Vec2(-1.0, -rim) : Vec2(-rim, rim);
    };
    const Vec2 u = span(direction.dot(side.right)), v = span(direction.dot(side.up));
    return std::pair{Vec2(u.x(), v.x()), Vec2(u.y(), v.y())};
}

// Letters lie in the side's plane, so that its rotation is visible.
void label(ImDrawList& list, const Placed& cube, const Side& side, ImU32 color) {
    const Vec3 right = cube.view * side.right, up = cube.view * side.up;
    const ui::Font& font = ui::fonts().small;
    const ImVec2 size = ui::text_size(font, side.name);
    const float shrink = 1.5f * cube.half / std::max(size.x, 1.4f * size.y);
    const ImVec2 middle = cube.pixel(side.out);
    // Text is written near its final position, because letters outside the view would be left out; then it is
    // projected onto the side.
    const ImVec2 from{middle.x - 0.5f * size.x, middle.y - 0.5f * size.y};
    const int first = list.VtxBuffer.Size;
    list.AddText(font.face, font.pixels, from, color, side.name);
    const float fit = std::min(1.0f, shrink);
    for (int i = first; i < list.VtxBuffer.Size; ++i) {
        ImVec2& at = list.VtxBuffer[i].pos;
        const float x = (at.x - middle.x) * fit, y = (middle.y - at.y) * fit;
        at = {middle.x + x * static_cast<float>(right.x()) + y * static_cast<float>(up.x()),
              middle.y - x * static_cast<float>(right.y()) - y * static_cast<float>(up.y())};
    }
}

}  // namespace

void view_cube(Editor& editor, ViewportState& state) {
    state.lit_cube.reset();
    if (!fits(state)) return;
    const ui::Scope scope("Cube");
    const Placed cube(editor, state);
    // Found by name: the sides that can be seen.
    const float reach = 5.0f * ui::scale();
    for (const Side& side : sides()) {
        if (!cube.shows(side)) continue;
        const ImVec2 at = cube.pixel(side.out);
        ImGui::SetCursorScreenPos({at.x - reach, at.y - reach});
        ImGui::Dummy({2 * reach, 2 * reach});
        ui::record_last_item(side.name);
        ui::mark_as_ground();
    }
    const float whole = 1.75f * cube.half;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const std::optional<Vec3> direction = cube.direction_at(mouse);
    ImGui::SetCursorScreenPos({cube.centre.x - whole, cube.centre.y - whole});
    if (!direction && !state.cube_held) return;  // outside the cube the mouse belongs to the view
    ImGui::InvisibleButton("cube", {2 * whole, 2 * whole});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) state.lit_cube = direction;
    state.cube_held = ImGui::IsItemActive();
    const bool dragging = ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left);
    if (dragging) {
        state.cube_dragged = true;
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        editor.view.orbit(Vec2(static_cast<double>(moved.x), static_cast<double>(moved.y)) /
                          static_cast<double>(ui::scale()));
    }
    if (ImGui::IsItemDeactivated()) {
        if (!state.cube_dragged && direction) editor.view.look_from(*direction);
        state.cube_dragged = false;
    }
}

void draw_view_cube(const Editor& editor, const ViewportState& state) {
    if (!fits(state)) return;
    const Placed cube(editor, state);
    const ui::Palette& p = ui::palette();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Side& side : sides()) {
        if (!cube.shows(side)) continue;
        const auto facing = static_cast<float>((cube.view * side.out).z());
        ImVec4 ground = p.raised;
        for (float* channel : {&ground.x, &ground.y, &ground.z})
            *channel *= 0.80f + 0.35f * facing;
        quad(list, cube, side, {-1, -1}, {1, 1}, ui::packed(ui::with_alpha(ground, 0.94f)));
        if (state.lit_cube)
            if (const auto part = part_of(side, *state.lit_cube))
                quad(list, cube, side, part->first, part->second,
                     ui::packed(ui::with_alpha(p.accent, 0.55f)));
        const auto corner = [&](double u, double v) {
            return cube.pixel(side.out + u * side.right + v * side.up);
        };
        list.AddQuad(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), ui::packed(p.border),
                     ui::scale());
        if (facing > 0.28f) label(list, cube, side, ui::packed(p.text));
    }
    // The axes from the corner they share, in their usual colours.
    const Vec3 origin{-1, -1, -1};
    for (const auto& [along, color] :
         {std::pair{Vec3(2, 0, 0), red}, std::pair{Vec3(0, 2, 0), green}, std::pair{Vec3(0, 0, 2), blue}}) {
        const bool behind = (cube.view * origin).z() < 0.0 && (cube.view * Vec3(origin + along)).z() < 0.0;
        list.AddLine(cube.pixel(origin), cube.pixel(origin + along),
                     behind ? (color & 0x00ffffffu) | 0x70000000u : color, 2.0f * ui::scale());
    }
}

}  // namespace slipface
