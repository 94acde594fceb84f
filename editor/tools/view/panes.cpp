#include "tools/view/panes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "document/faces.h"
#include "slipface/level/find_start.h"
#include "tools/editor.h"

namespace slipface {

std::array<PaneRect, Panes::maximum> pane_rects(const Panes& panes) {
    std::array<PaneRect, Panes::maximum> rects;
    const double x = std::clamp(panes.across, 0.1, 0.9), y = std::clamp(panes.down, 0.1, 0.9);
    if (panes.maximised || panes.count == 1) {
        rects[panes.active] = {0.0, 0.0, 1.0, 1.0};
    } else if (panes.count == 2) {
        rects[0] = {0.0, 0.0, x, 1.0};
        rects[1] = {x, 0.0, 1.0 - x, 1.0};
    } else if (panes.count == 3) {
        rects[0] = {0.0, 0.0, x, 1.0};
        rects[1] = {x, 0.0, 1.0 - x, y};
        rects[2] = {x, y, 1.0 - x, 1.0 - y};
    } else {
        rects[0] = {0.0, 0.0, x, y};
        rects[1] = {x, 0.0, 1.0 - x, y};
        rects[2] = {0.0, y, x, 1.0 - y};
        rects[3] = {x, y, 1.0 - x, 1.0 - y};
    }
    return rects;
}

ViewCamera& pane_view(Editor& editor, std::size_t pane) {
    return pane == editor.panes.active ? editor.view : editor.panes.waiting[pane];
}
const ViewCamera& pane_view(const Editor& editor, std::size_t pane) {
    return pane == editor.panes.active ? editor.view : editor.panes.waiting[pane];
}

void set_pane_count(Editor& editor, std::size_t count) {
    Panes& panes = editor.panes;
    count = std::clamp<std::size_t>(count, 1, Panes::maximum);
    const Vec3 directions[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    for (std::size_t pane = std::max<std::size_t>(1, panes.count); pane < count; ++pane) {
        ViewCamera& view = panes.waiting[pane];
        view.orthographic = true;
        view.look_from(directions[pane]);
        frame_pane(editor, pane);
    }
    if (panes.active >= count) activate_pane(editor, 0);
    panes.count = count;
    panes.maximised = false;
}

namespace {

// The fraction of what a view shows that it shows from in front: from below a floor, or outside a closed
// building, nearly all that is drawn are dark backs.
double seen_from_front(const Editor& editor, const ViewCamera& view) {
    constexpr int across = 12, down = 8;
    const Camera camera = view.camera();
    const bool cull = !draws_back_faces(editor, camera);
    int front = 0, all = 0;
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const Ray ray = pixel_ray(camera, {(x + 0.5) / across * editor.view_aspect, (y + 0.5) / down},
                                      {editor.view_aspect, 1.0});
            const auto hit = editor.document->pick(ray.origin, ray.direction, cull);
            all += hit ? 1 : 0;
            front += hit && !hit->back_face ? 1 : 0;
        }
    return all > 0 ? static_cast<double>(front) / all : 0.0;
}

// From the standing player's eyes, towards the farthest view.
bool look_inside(const Editor& editor, ViewCamera& view) {
    const Level& level = editor.document->level();
    const TickScene scene = editor.lab.scene(*editor.document);
    const auto start = find_start(level, scene.at(0, 0.0), scene.offset(), level.movement);
    if (!start || !start->stands) return false;
    const Vec3 eye = start->position + Vec3(0.0, 0.5 * level.movement.radii.y(), 0.0);
    constexpr int directions = 16;
    constexpr double turn = 6.283185307179586 / directions;
    double farthest = 0.0;
    Vec3 target = eye;
    for (int i = 0; i < directions; ++i) {
        const Vec3 ahead{-std::sin(i * turn), 0.0, -std::cos(i * turn)};
        const auto hit = editor.document->pick(eye, ahead, false);
        const double distance = hit ? (hit->point - eye).norm() : 0.0;
        if (distance <= farthest) continue;
        farthest = distance;
        target = eye + ahead * distance;
    }
    if (farthest <= 0.0) return false;
    view.look_at(eye, target);
    return true;
}

// Keeps the view's direction if the level is seen from there, else takes the usual one, or goes inside.
void frame_level(const Editor& editor, ViewCamera& view, double aspect) {
    const auto whole = [&](double yaw, double pitch) {
        ViewCamera framed = view;
        framed.yaw = yaw;
        framed.pitch = pitch;
        framed.frame(shown_bounds(*editor.document), aspect);
        return framed;
    };
    const ViewCamera kept = whole(view.yaw, view.pitch);
    const ViewCamera usual = whole(view.yaw, ViewCamera().pitch);
    constexpr double enough = 0.5;
    constexpr double lowest_pitch = 0.25;  // radians; from lower, the nearest walls hide all else
    if (view.orthographic || (view.pitch >= lowest_pitch && seen_from_front(editor, kept) >= enough))
        view = kept;
    else if (seen_from_front(editor, usual) >= enough || !look_inside(editor, view))
        view = usual;
}

}  // namespace

void frame_pane(Editor& editor, std::size_t pane) {
    if (!editor.document) return;
    ViewCamera& view = pane_view(editor, pane);
    frame_level(editor, view, editor.view_aspect);
    editor.panes.framed[pane] = FramedView{view};
}

void frame_pane(Editor& editor, std::size_t pane, std::vector<Vec3> points) {
    ViewCamera& view = pane_view(editor, pane);
    view.frame(points, editor.view_aspect);
    editor.panes.framed[pane] = FramedView{view, std::move(points)};
}

void fit_framed_pane(Editor& editor, std::size_t pane, double aspect) {
    std::optional<FramedView>& framed = editor.panes.framed[pane];
    if (!framed || framed->aspect == aspect || !editor.document) return;
    ViewCamera& view = pane_view(editor, pane);
    if (view != framed->view) return framed.reset();
    if (framed->points.empty())
        frame_level(editor, view, aspect);
    else
        view.frame(framed->points, aspect);
    framed->view = view;
    framed->aspect = aspect;
}

void activate_pane(Editor& editor, std::size_t pane) {
    Panes& panes = editor.panes;
    if (pane >= panes.count || pane == panes.active) return;
    panes.waiting[panes.active] = editor.view;
    panes.active = pane;
    editor.view = panes.waiting[pane];
}

}  // namespace slipface
