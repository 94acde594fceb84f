// The lab in the view: the runs' ribbons and ghosts, where they diverge, and the highlighted record.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "panels/lab_track.h"
#include "panels/viewport_panel.h"
#include "slipface/render/trace_overlay.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t max_segments = 2500;  // of one ribbon

Color to_color(const ImVec4& c, float alpha) {
    return {c.x, c.y, c.z, alpha};
}

// The path of the feet, brighter up to the cursor's time.
void ribbon(Overlay& overlay, const TapeRun& run, double until_s, const Color& color) {
    const auto samples = run.samples();
    const Vec3 down(0.0, 0.02 - run.settings().radii.y(), 0.0);
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / max_segments);
    Vec3 previous = run.start() + down;
    for (std::size_t tick = 0; tick < samples.size(); tick += stride) {
        const Vec3 here = samples[tick].position + down;
        const bool past = static_cast<double>(tick) * run.dt() <= until_s;
        Color tint = color;
        tint.alpha *= past ? 0.95f : 0.35f;
        bool jumped = false;
        for (std::size_t i = tick + 1 - std::min(tick + 1, stride); i <= tick; ++i)
            jumped = jumped || samples[i].respawned;
        if (!jumped && here != previous) overlay.line(previous, here, tint, past ? 3.0f : 2.0f);
        previous = here;
    }
}

void ghost(Overlay& overlay, const TapeRun& run, double time_s, const Color& color, bool explained) {
    const auto samples = run.samples();
    const auto tick = static_cast<std::size_t>(std::llround(time_s / run.dt()));
    if (samples.empty()) return;
    const TickSample& sample = samples[std::min(tick, samples.size() - 1)];
    Color fill = color, outline = color;
    fill.alpha = explained ? 0.30f : 0.14f;
    outline.alpha = 0.95f;
    overlay.ellipsoid(sample.position, body_radii(run.settings(), {.crouched = sample.crouched}), fill,
                      outline);
    if (const Vec3 motion = sample.motion(); explained && motion.norm() > 0.1)
        overlay.arrow(sample.position, sample.position + motion * 0.2, color, 2.5f, true);
}

// Where the other controller's player went, dashed, and where it is at the cursor.
void imported(Overlay& overlay, const ImportedRun& imported, double until_s) {
    if (!imported.run) return;
    const std::vector<RecordedTick>& ticks = imported.run->ticks;
    const Color color = to_color(ui::palette().bad, 0.95f);
    const std::size_t stride = std::max<std::size_t>(1, ticks.size() / max_segments);
    const Vec3 up(0.0, 0.03, 0.0);
    for (std::size_t i = stride; i < ticks.size(); i += stride)
        if (i / stride % 3 != 0) overlay.line(ticks[i - stride].feet + up, ticks[i].feet + up, color, 2.5f);
    Color fill = color;
    fill.alpha = 0.14f;
    const RecordedTick& now = ticks[imported.tick_at(until_s)];
    overlay.ellipsoid(now.feet + Vec3(0.0, 0.5 * imported.run->height, 0.0),
                      {imported.run->radius, 0.5 * imported.run->height, imported.run->radius}, fill, color);
}

void partings(Overlay& overlay, const Lab& lab) {
    const Color color = to_color(parting_color(), 1.0f);
    for (std::size_t i = 1; i < lab.runs().size(); ++i) {
        const auto& divergence = lab.divergence(i);
        if (!lab.runs()[i].shown || !divergence) continue;
        const Vec3 at = lab.runs()[i].run.samples()[divergence->first].position;
        const Vec3 top = at + Vec3(0.0, lab.runs()[i].settings.radii.y() + 0.7, 0.0);
        overlay.line(at, top, color, 2.5f, true);
        overlay.cross(at, 0.25, color, 3.0f);
    }
}

void lit_record(Overlay& overlay, const Editor& editor, const StoryLine& line) {
    const CollisionWorld& world = editor.document->collision();
    const Color lit = to_color(lit_color(), 1.0f);
    const auto fill = [&](TriangleId triangle, float alpha) {
        auto corners = world.triangle(triangle);
        const Vec3 off = (line.normal.isZero() ? world.triangle_normal(triangle) : line.normal) * 0.004;
        for (Vec3& corner : corners)
            corner += off;
        Color tint = lit;
        tint.alpha = alpha;
        overlay.triangle(corners[0], corners[1], corners[2], tint);
        for (std::size_t i = 0; i < 3; ++i)
            overlay.line(corners[i], corners[(i + 1) % 3], lit, 2.0f, true);
    };
    if (line.triangle != no_id && line.triangle < world.triangle_count()) fill(line.triangle, 0.40f);
    if (!line.position) return;
    if (!line.normal.isZero()) {
        Color plane = lit;
        plane.alpha = 0.12f;
        overlay.disc(*line.position + line.normal * 0.006, line.normal, 0.45, plane, lit);
        overlay.arrow(*line.position, *line.position + line.normal * 0.6, lit, 3.0f, true);
    }
    overlay.line(*line.position, *line.position, {0.10f, 0.09f, 0.04f, 1.0f}, 13.0f, true);
    overlay.line(*line.position, *line.position, lit, 9.0f, true);
}

}  // namespace

void add_lab(Overlay& overlay, const Editor& editor) {
    const Lab& lab = editor.lab;
    if (!lab.has_tape()) return;
    const Document& document = *editor.document;
    const double time_s = static_cast<double>(lab.cursor()) * lab.tape().dt;
    if (lab.show_rates) {
        const std::vector<RateRow>& rows = lab.rates(document);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Color color = to_color(run_color(i), 1.0f);
            // The last tick that ends no later than the tape's.
            const double own_end = time_s + lab.tape().dt;
            ribbon(overlay, rows[i].run, time_s, color);
            ghost(overlay, rows[i].run, own_end - rows[i].run.dt(), color, false);
        }
        return;
    }
    for (std::size_t i = lab.runs().size(); i-- > 0;) {
        if (!lab.runs()[i].shown) continue;
        const Color color = to_color(run_color(i), 1.0f);
        ribbon(overlay, lab.runs()[i].run, time_s, color);
        ghost(overlay, lab.runs()[i].run, time_s, color, i == lab.explained());
    }
    imported(overlay, editor.imported, time_s + lab.tape().dt);
    partings(overlay, lab);
    draw_trace(overlay, lab.trace(document).records, lab.runs()[lab.explained()].settings.radii,
               {.ghosts = false, .contacts = true, .planes = true, .remainders = false, .opacity = 0.9f});
    const std::vector<StoryLine>& story = lab.story(document);
    if (lab.lit_line && *lab.lit_line < story.size()) lit_record(overlay, editor, story[*lab.lit_line]);
}

namespace {

struct LabelPosition {
    ImVec2 min, max;
};
std::vector<LabelPosition>& labels_of_frame() {
    static std::vector<LabelPosition> places;
    static int frame = -1;
    if (std::exchange(frame, ImGui::GetFrameCount()) != ImGui::GetFrameCount()) places.clear();
    return places;
}

}  // namespace

void view_label(const ViewportState& state, const Camera& camera, const Vec3& position,
                const std::string& text, const ImVec4& color) {
    const Vec3 pixel =
        project(camera, position, Vec2(static_cast<double>(state.size.x), static_cast<double>(state.size.y)));
    if (!(pixel.z() > 0.0)) return;
    const float scale = ui::scale();
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const ImVec2 tip{state.min.x + static_cast<float>(pixel.x()),
                     state.min.y + static_cast<float>(pixel.y())};
    ImVec2 min{tip.x - 0.5f * extent.x - 7 * scale, tip.y - extent.y - 10 * scale};
    ImVec2 max{tip.x + 0.5f * extent.x + 7 * scale, tip.y - 4 * scale};
    // Completely inside the view's sides, and above the labels that are there already.
    if (tip.x >= state.min.x && tip.x <= state.min.x + state.size.x) {
        const float right = std::min(0.0f, state.min.x + state.size.x - max.x);
        const float moved = std::max(right, state.min.x - min.x);
        if (min.x < state.min.x || right < 0.0f) min.x += moved, max.x += moved;
    }
    std::vector<LabelPosition>& placed = labels_of_frame();
    const auto in_the_way = [&](const LabelPosition& other) {
        return min.x < other.max.x && max.x > other.min.x && min.y < other.max.y && max.y > other.min.y;
    };
    for (auto other = placed.begin();
         (other = std::find_if(placed.begin(), placed.end(), in_the_way)) != placed.end();) {
        const float up = max.y - other->min.y + 2 * scale;
        min.y -= up;
        max.y -= up;
    }
    placed.push_back({min, max});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(state.min, {state.min.x + state.size.x, state.min.y + state.size.y}, true);
    list.AddRectFilled(min, max, ui::packed(ui::with_alpha(ui::palette().window, 0.82f)), 5 * scale);
    list.AddText({min.x + 7 * scale, min.y + 3 * scale}, ui::packed(color), text.c_str());
    list.PopClipRect();
}

void lab_labels(const Editor& editor, const ViewportState& state) {
    const Lab& lab = editor.lab;
    if (!lab.has_tape() || lab.show_rates || editor.playtest) return;
    const Camera camera = editor.view.camera();
    if (editor.imported.run) {
        const double time_s = static_cast<double>(lab.cursor() + 1) * lab.tape().dt;
        const RecordedTick& now = editor.imported.run->ticks[editor.imported.tick_at(time_s)];
        view_label(state, camera, now.feet + Vec3(0.0, editor.imported.run->height + 0.1, 0.0),
                   editor.imported.name, ui::palette().bad);
    }
    for (std::size_t i = 1; i < lab.runs().size(); ++i) {
        const LabRun& run = lab.runs()[i];
        const auto& divergence = lab.divergence(i);
        if (!run.shown || !divergence) continue;
        const Vec3 at = run.run.samples()[divergence->first].position;
        view_label(state, camera, at + Vec3(0.0, run.settings.radii.y() + 0.7, 0.0),
                   fmt::format("Diverges at tick {}", divergence->first), ui::palette().bad);
    }
    for (std::size_t i = 0; i < lab.runs().size(); ++i) {
        const LabRun& run = lab.runs()[i];
        const auto samples = run.run.samples();
        if (!run.shown || lab.cursor() >= samples.size()) continue;
        if (i != lab.explained() && !lab.divergence(i)) continue;  // it coincides with the selected run's
        view_label(state, camera,
                   samples[lab.cursor()].position + Vec3(0.0, run.settings.radii.y() + 0.1, 0.0), run.name,
                   run_color(i));
    }
}

}  // namespace slipface
