// Flat overlays of the view: the playtest's numbers, the outline being drawn, the numbers of triangles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "panels/viewport_panel.h"
#include "slipface/base/counted.h"
#include "slipface/level/find_start.h"
#include "tools/commands/commands.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

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

}  // namespace

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
    if (player.hanging) stance = "hanging from " + ground;
    if (player.crouched) stance += player.wants_to_stand ? ", wants to stand" : ", crouched";
    ImDrawList& list = *ImGui::GetWindowDrawList();
    plate(list, {state.min.x + 14 * scale, state.min.y + 14 * scale},
          {fmt::format("{:.2f} m/s", editor.playtest->speed()), stance,
           fmt::format("{:.2f}, {:.2f}, {:.2f}", player.position.x(), player.position.y(),
                       player.position.z())});
    std::string help = "Esc: return to editing";
    // The start may be far from where the author was looking.
    if (const Command* const here = find_command("playtest.from_view"); here && !editor.began_in_view)
        help += " \u00b7 " + shortcut_text(editor, *here) + ": play from where you looked";
    const ImVec2 size = ImGui::CalcTextSize(help.c_str());
    const ImVec2 at{state.min.x + (state.size.x - size.x) * 0.5f,
                    state.min.y + state.size.y - size.y - 22 * scale};
    list.AddRectFilled({at.x - 12 * scale, at.y - 6 * scale},
                       {at.x + size.x + 12 * scale, at.y + size.y + 6 * scale},
                       ui::packed(ui::with_alpha(ui::palette().window, 0.82f)), 14 * scale);
    list.AddText(at, ui::packed(ui::palette().muted), help.c_str());
    ui::record_rect(editor.began_in_view ? "Walking" : "Walking elsewhere", at,
                    {at.x + size.x, at.y + size.y});
}

void draw_spawn_names(const Editor& editor, const ViewportState& state) {
    constexpr std::size_t max_names = 200;
    const std::vector<Spawn> spawns = all_spawns(editor.document->level());
    if (spawns.size() < 2) return;
    struct Label {
        const std::string* name;
        bool main;
        double depth;
        ImVec2 min, max;
    };
    const Camera camera = shown_camera(editor);
    const Vec2 size{static_cast<double>(state.size.x), static_cast<double>(state.size.y)};
    const ImVec2 pad{4 * ui::scale(), 2 * ui::scale()};
    std::vector<Label> labels;
    for (std::size_t i = 0; i < std::min(max_names, spawns.size()); ++i) {
        const Vec3 at = project(camera, spawns[i].position, size);
        if (at.z() <= 0.0 && !camera.orthographic) continue;
        const ImVec2 extent = ImGui::CalcTextSize(spawns[i].name.c_str());
        // Wholly in the view; what is wider than it is left out.
        const ImVec2 room{state.size.x - extent.x - 2 * pad.x, state.size.y - extent.y - 2 * pad.y};
        if (room.x < 0.0f || room.y < 0.0f) continue;
        const auto beside = [](double middle, float width, float space, float maximum) {
            return space + std::clamp(static_cast<float>(middle) - 0.5f * width - space, 0.0f, maximum);
        };
        const ImVec2 min{state.min.x + beside(at.x(), extent.x, pad.x, room.x),
                         state.min.y + beside(at.y(), extent.y, pad.y, room.y)};
        if (at.x() < 0.0 || at.y() < 0.0 || at.x() > size.x() || at.y() > size.y()) continue;
        labels.push_back({&spawns[i].name,
                          i == 0,
                          (spawns[i].position - camera.eye).norm(),
                          {min.x - pad.x, min.y - pad.y},
                          {min.x + extent.x + pad.x, min.y + extent.y + pad.y}});
    }
    // A map has dozens of spawns: the main one's name and the nearest ones' hide those behind them, or all of
    // them would hide the level.
    std::stable_sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) {
        return a.main != b.main ? a.main : a.depth < b.depth;
    });
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(state.min, {state.min.x + state.size.x, state.min.y + state.size.y}, true);
    std::vector<const Label*> drawn;
    for (const Label& label : labels) {
        const bool hidden = std::any_of(drawn.begin(), drawn.end(), [&](const Label* other) {
            return label.min.x < other->max.x && other->min.x < label.max.x && label.min.y < other->max.y &&
                   other->min.y < label.max.y;
        });
        if (hidden) continue;
        drawn.push_back(&label);
        list.AddRectFilled(label.min, label.max, ui::packed(ui::with_alpha(ui::palette().window, 0.75f)),
                           3 * ui::scale());
        list.AddText({label.min.x + pad.x, label.min.y + pad.y},
                     ui::packed(label.main ? ui::palette().text : ui::palette().muted), label.name->c_str());
        ui::record_rect("Spawn name/" + *label.name, label.min, label.max);
    }
    list.PopClipRect();
}

// A flood fill may reach much further than the face under the mouse suggests.
std::string tool_preview(const Editor& editor) {
    if (editor.tool != Tool::fill || !editor.document || editor.hovered == no_id) return {};
    const std::vector<SurfaceType>& surfaces = editor.document->level().surfaces;
    const std::size_t faces = tool_faces(editor).size();
    const bool typed = editor.brush && *editor.brush < surfaces.size();
    return fmt::format("{} {}{}", typed ? "Fill" : "Unset", counted(faces, "face"),
                       typed ? " with " + surfaces[*editor.brush].name : "");
}

void draw_tool_preview(const Editor& editor, const ViewportState& state) {
    const std::string text = tool_preview(editor);
    if (text.empty() || !state.hovered) return;
    const float scale = ui::scale();
    const ImVec2 mouse = ImGui::GetIO().MousePos, pad{8 * scale, 4 * scale};
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 whole{size.x + 2 * pad.x, size.y + 2 * pad.y};
    const ImVec2 min{std::round(std::max(
                         state.min.x, std::min(mouse.x + 16 * scale, state.min.x + state.size.x - whole.x))),
                     std::round(std::max(
                         state.min.y, std::min(mouse.y + 14 * scale, state.min.y + state.size.y - whole.y)))};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, {min.x + whole.x, min.y + whole.y},
                       ui::packed(ui::with_alpha(ui::palette().window, 0.86f)), 4 * scale);
    list.AddText({min.x + pad.x, min.y + pad.y}, ui::packed(ui::palette().text), text.c_str());
    ui::record_rect("Tool preview", min, {min.x + whole.x, min.y + whole.y});
}

void draw_outline(const ViewportState& state) {
    if (state.outline.size() < 2) return;
    std::vector<ImVec2> points;
    for (const Vec2& point : state.outline)
        points.push_back(
            {state.min.x + static_cast<float>(point.x()), state.min.y + static_cast<float>(point.y())});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const int count = static_cast<int>(points.size());
    const ImVec4 accent = ui::palette().accent;
    list.PushClipRect(state.min, {state.min.x + state.size.x, state.min.y + state.size.y}, true);
    // Filled only if it is certainly convex.
    if (count == 4) list.AddConvexPolyFilled(points.data(), count, ui::packed(ui::with_alpha(accent, 0.10f)));
    points.push_back(points.front());
    list.AddPolyline(points.data(), count + 1, IM_COL32(0, 0, 0, 140), 0, 3.0f * ui::scale());
    list.AddPolyline(points.data(), count + 1, ui::packed(accent), 0, 1.5f * ui::scale());
    list.PopClipRect();
}

namespace {

constexpr float ids_reach = 150.0f;  // design pixels around the mouse
constexpr std::size_t max_id_faces = 600;

// The faces around one, nearest first, counted in steps across edges.
std::vector<FaceId> faces_around(const FaceNeighbours& neighbours, FaceId start) {
    std::vector<FaceId> faces{start};
    std::set<FaceId> seen{start};
    for (std::size_t i = 0; i < faces.size() && faces.size() < max_id_faces; ++i)
        for (const FaceId next : neighbours.of(faces[i]))
            if (seen.insert(next).second) faces.push_back(next);
    return faces;
}

}  // namespace

void draw_triangle_ids(const Editor& editor, const ViewportState& state) {
    if (!editor.show_triangle_ids || editor.hovered == no_id) return;
    const Document& document = *editor.document;
    const FacePart& part = document.part_with(editor.hovered);
    const Mesh& mesh = *part.mesh;
    const Camera camera = shown_camera(editor);
    const Vec2 size{static_cast<double>(state.size.x), static_cast<double>(state.size.y)};
    const Vec2 mouse = project(camera, editor.hovered_point, size).head<2>();
    const double reach = static_cast<double>(ids_reach * ui::scale());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ui::Font& font = ui::fonts().small;
    for (const FaceId face : faces_around(part.neighbours, editor.hovered - part.first)) {
        if (document.is_hidden(face + part.first)) continue;
        for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
            std::array<Vec2, 3> corners;
            Vec3 centre = Vec3::Zero();
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 corner = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
                corners[i] = project(camera, corner, size).head<2>();
                centre += corner / 3.0;
            }
            const Vec3 at = project(camera, centre, size);
            if (at.z() <= 0.0 && !camera.orthographic) continue;
            if ((at.head<2>() - mouse).norm() > reach) continue;
            const std::string text = std::to_string(t + part.first_triangle);
            const ImVec2 extent = ui::text_size(font, text.c_str());
            // A number that does not fit its triangle would only hide the others.
            const Vec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
            const double area = 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
            if (area < 1.2 * static_cast<double>(extent.x * extent.y)) continue;
            const ImVec2 middle{state.min.x + static_cast<float>(at.x()),
                                state.min.y + static_cast<float>(at.y())};
            const ImVec2 min{middle.x - 0.5f * extent.x, middle.y - 0.5f * extent.y};
            list.AddRectFilled({min.x - 3, min.y - 1}, {min.x + extent.x + 3, min.y + extent.y + 1},
                               IM_COL32(14, 16, 20, 190), 3 * ui::scale());
            list.AddText(font.face, font.pixels, min,
                         face + part.first == editor.hovered ? ui::packed(ui::palette().accent)
                                                             : IM_COL32(235, 238, 242, 255),
                         text.c_str());
        }
    }
}

}  // namespace slipface
