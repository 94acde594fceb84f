// The audit's heat map, the map of what is reached, and the reach of jumps, in the view.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "panels/viewport_panel.h"
#include "slipface/sim/reach.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/reach_job.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t max_heat_triangles = 30000;
constexpr Color running_color{0.34f, 0.71f, 0.91f, 1.0f};
constexpr Color tapped_color{0.00f, 0.76f, 0.58f, 1.0f};
constexpr Color standing_color{0.80f, 0.47f, 0.65f, 1.0f};
constexpr Color coyote_color{0.945f, 0.690f, 0.330f, 1.0f};
constexpr Color wrong_color{0.937f, 0.400f, 0.361f, 1.0f};

// Violet for small values, orange, yellow for the largest: dark to light, so that it is readable without
// colour.
Color heat_color(float fraction) {
    const float s = std::clamp(fraction, 0.0f, 1.0f);
    const auto between = [&](float a, float b, float t) { return a + (b - a) * t; };
    if (s < 0.5f) {
        const float t = s * 2.0f;
        return {between(0.36f, 0.90f, t), between(0.10f, 0.36f, t), between(0.55f, 0.25f, t), 0.72f};
    }
    const float t = s * 2.0f - 1.0f;
    return {between(0.90f, 0.99f, t), between(0.36f, 0.91f, t), between(0.25f, 0.45f, t), 0.80f};
}

struct Stand {
    Vec3 feet;
    Vec3 heading;  // horizontal, unit
};

// Where the arcs start: at the player at the lab's cursor, else at the spawn point.
Stand reach_stand(const Editor& editor) {
    const Level& level = editor.document->level();
    Vec3 centre = level.spawn;
    Vec3 heading(-std::sin(level.spawn_yaw), 0.0, -std::cos(level.spawn_yaw));
    const Lab& lab = editor.lab;
    if (lab.has_tape()) {
        const TapeRun& run = lab.runs()[lab.explained()].run;
        if (lab.cursor() < run.samples().size()) {
            const TickSample& sample = run.samples()[lab.cursor()];
            centre = sample.position;
            const Vec3 level_velocity(sample.velocity.x(), 0.0, sample.velocity.z());
            if (level_velocity.norm() > 0.1) heading = level_velocity.normalized();
        }
    }
    return {centre - Vec3(0.0, level.movement.radii.y(), 0.0), heading};
}

const Reach& reach_of(const MovementSettings& settings) {
    static MovementSettings measured;
    static std::optional<Reach> reach;
    if (!reach || !(measured == settings)) {
        measured = settings;
        reach = measure_reach(settings, Playtest::tick_s);
    }
    return *reach;
}

void arc(Overlay& overlay, const Stand& stand, const Vec3& heading, const JumpArc& jump, Color color,
         float width) {
    Vec3 previous = stand.feet;
    for (const Vec2& point : jump.path) {
        const Vec3 here = stand.feet + heading * point.x() + Vec3(0.0, point.y(), 0.0);
        if (here != previous) overlay.line(previous, here, color, width);
        previous = here;
    }
}

void ring(Overlay& overlay, const Vec3& centre, double radius, Color color) {
    constexpr int parts = 72;
    for (int i = 0; i < parts; ++i) {
        const double a = 2.0 * std::numbers::pi * i / parts, b = 2.0 * std::numbers::pi * (i + 1) / parts;
        overlay.line(centre + Vec3(std::cos(a), 0.02, std::sin(a)).cwiseProduct(Vec3(radius, 1.0, radius)),
                     centre + Vec3(std::cos(b), 0.02, std::sin(b)).cwiseProduct(Vec3(radius, 1.0, radius)),
                     color, 1.5f);
    }
}

void add_face_heat(Overlay& overlay, const Mesh& mesh, const std::vector<float>& heat) {
    if (heat.size() != mesh.face_count()) return;
    std::size_t drawn = 0;
    for (FaceId face = 0; face < heat.size() && drawn < max_heat_triangles; ++face) {
        if (!(heat[face] > 0.0f)) continue;
        const Vec3 off = face_normal(mesh, face) * 0.003;
        for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1];
             ++t, ++drawn) {
            Vec3 corners[3];
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>() + off;
            overlay.triangle(corners[0], corners[1], corners[2], heat_color(heat[face]));
        }
    }
}

bool shows_reach_map(const Editor& editor) {
    return editor.reach && editor.reach->show && editor.reach->report() &&
           editor.reach->fits(*editor.document);
}

// "0", the middle of the colours, and the most; `text_of` a fraction of the strip.
float heat_bar(ImDrawList& draw, const ImVec2& corner, float width,
               const std::function<std::string(float)>& text_of) {
    const float scale = ui::scale(), bar = 10 * scale, gap = 3 * scale;
    const auto at = [&](float fraction) { return corner.x + width * fraction; };
    const ImU32 ink = ImGui::GetColorU32(ui::palette().muted);
    constexpr int parts = 32;
    for (int i = 0; i < parts; ++i) {
        const float begin = static_cast<float>(i) / parts, end = static_cast<float>(i + 1) / parts;
        const Color color = heat_color(0.5f * (begin + end));
        draw.AddRectFilled({at(begin), corner.y}, {at(end), corner.y + bar},
                           ImGui::GetColorU32(ImVec4(color.red, color.green, color.blue, 1.0f)));
    }
    // Labels: "0", a quarter of the maximum in the middle of the colours, and the maximum.
    float free_until = corner.x + width;
    for (const float fraction : {1.0f, 0.0f, 0.5f}) {
        const std::string text = fraction == 0.0f ? std::string("0") : text_of(fraction);
        const float size = ImGui::CalcTextSize(text.c_str()).x, left = at(fraction) - fraction * size;
        if (fraction == 0.5f && left + size + gap > free_until) continue;
        if (fraction == 1.0f) free_until = left;
        draw.AddText({left, corner.y + bar + gap}, ink, text.c_str());
    }
    return bar + gap + ImGui::GetTextLineHeight();
}

// In the view's lower right corner; the legend of the types has the other one.
void legend_card(const ViewportState& state, const char* title,
                 const std::function<void(ImDrawList&, const ImVec2&, float)>& bar) {
    const float scale = ui::scale(), pad = 8 * scale, width = 320 * scale;
    if (state.size.x < 640 * scale)
        return;  // no room next to the legend of the types; the panel shows the bar, too
    const float height = 2 * ImGui::GetTextLineHeight() + 17 * scale;
    const ImVec2 corner(state.min.x + state.size.x - width - 3 * pad,
                        state.min.y + state.size.y - height - 3 * pad);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + width + 2 * pad, corner.y + height + 2 * pad},
                       ImGui::GetColorU32(ui::with_alpha(ui::palette().raised, 0.92f)), 4 * scale);
    draw.AddText({corner.x + pad, corner.y + pad}, ImGui::GetColorU32(ui::palette().text), title);
    bar(draw, {corner.x + pad, corner.y + pad + ImGui::GetTextLineHeight() + 4 * scale}, width);
}

}  // namespace

void add_heat(Overlay& overlay, const Editor& editor) {
    if (shows_reach_map(editor)) {
        add_face_heat(overlay, editor.document->mesh(), editor.reach->heat());
        for (const ReachReport::Exit& exit : editor.reach->report()->exits)
            overlay.cross(exit.hole, 0.4, wrong_color, 3.0f);
    }
    if (editor.layout.shown(PanelId::reach))
        for (const Goal& goal : editor.document->level().goals)
            ring(overlay, goal.position, goal.radius,
                 goal.kind == GoalKind::never ? wrong_color : running_color);
    if (!editor.audit || !editor.audit->show_heat || !editor.audit->report()) return;
    add_face_heat(overlay, editor.document->mesh(), editor.audit->heat(*editor.document, editor.audit->kind));
    if (!editor.audit->opened) return;
    const AuditFinding& finding = editor.audit->report()->findings[*editor.audit->opened];
    overlay.cross(finding.position, 0.4, wrong_color, 4.0f);
}

float draw_heat_bar(ImDrawList& draw, const ImVec2& corner, float width, const AuditJob& job) {
    // A quarter of the most stands where half of the colours lie.
    return heat_bar(draw, corner, width,
                    [&](float fraction) { return heat_text(job.kind, job.value_at(job.kind, fraction)); });
}

float draw_heat_bar(ImDrawList& draw, const ImVec2& corner, float width, const ReachJob& job) {
    return heat_bar(draw, corner, width, [&](float fraction) {
        return fmt::format("{:.1f} s", static_cast<double>(fraction * fraction) * job.slowest_s());
    });
}

void heat_legend(const Editor& editor, const ViewportState& state) {
    if (editor.playtest) return;
    if (shows_reach_map(editor) && editor.reach->view == ReachView::time) {
        legend_card(state, reach_view_names[0], [&](ImDrawList& draw, const ImVec2& corner, float width) {
            draw_heat_bar(draw, corner, width, *editor.reach);
        });
        return;
    }
    if (!editor.audit || !editor.audit->show_heat || !editor.audit->report()) return;
    const AuditJob& job = *editor.audit;
    if (!job.fits(*editor.document) || job.kind == HeatKind::unreached || !(job.worst(job.kind) > 0.0))
        return;
    legend_card(state, heat_names[static_cast<std::size_t>(job.kind)],
                [&](ImDrawList& draw, const ImVec2& corner, float width) {
                    draw_heat_bar(draw, corner, width, job);
                });
}

void add_reach(Overlay& overlay, const Editor& editor) {
    if (!editor.lab.show_reach) return;
    const Reach& reach = reach_of(editor.document->level().movement);
    const Stand stand = reach_stand(editor);
    arc(overlay, stand, stand.heading, reach.running, running_color, 3.5f);
    if (std::abs(reach.tapped.height_m - reach.running.height_m) > 0.01)
        arc(overlay, stand, stand.heading, reach.tapped, tapped_color, 2.5f);
    arc(overlay, stand, stand.heading, reach.standing, standing_color, 2.5f);
    constexpr int directions = 12;
    for (int i = 1; i < directions; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / directions;
        const Vec3 heading(stand.heading.x() * std::cos(turn) - stand.heading.z() * std::sin(turn), 0.0,
                           stand.heading.x() * std::sin(turn) + stand.heading.z() * std::cos(turn));
        Color quiet = running_color;
        quiet.alpha = 0.25f;
        arc(overlay, stand, heading, reach.running, quiet, 1.5f);
    }
    ring(overlay, stand.feet, reach.running.distance_m, running_color);
    if (reach.coyote_m > 0.0)
        overlay.line(stand.feet + Vec3(0, 0.03, 0),
                     stand.feet + Vec3(0, 0.03, 0) + stand.heading * reach.coyote_m, coyote_color, 7.0f,
                     true);
}

void reach_labels(const Editor& editor, const ViewportState& state) {
    if (!editor.lab.show_reach || editor.playtest) return;
    const Reach& reach = reach_of(editor.document->level().movement);
    const Stand stand = reach_stand(editor);
    const Camera camera = editor.view.camera();
    const auto plate = [&](const Vec3& at, const std::string& text, Color color) {
        view_label(state, camera, at, text, {color.red, color.green, color.blue, 1.0f});
    };
    const auto top = std::max_element(reach.running.path.begin(), reach.running.path.end(),
                                      [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
    if (top != reach.running.path.end())
        plate(stand.feet + stand.heading * top->x() + Vec3(0.0, top->y(), 0.0),
              fmt::format("{:.2f} m high", reach.running.height_m), running_color);
    plate(stand.feet + stand.heading * reach.running.distance_m,
          fmt::format("{:.2f} m far, {:.2f} s", reach.running.distance_m, reach.running.duration_s),
          running_color);
    if (std::abs(reach.tapped.height_m - reach.running.height_m) > 0.01)
        plate(stand.feet + stand.heading * reach.tapped.distance_m + Vec3(0, 0.5, 0),
              fmt::format("Tapped: {:.2f} m high", reach.tapped.height_m), tapped_color);
    if (reach.coyote_ticks > 0)
        plate(stand.feet + stand.heading * (0.5 * reach.coyote_m) - Vec3(0, 0.35, 0),
              fmt::format("Coyote: {} ticks, {:.2f} m", reach.coyote_ticks, reach.coyote_m), coyote_color);
}

}  // namespace slipface
