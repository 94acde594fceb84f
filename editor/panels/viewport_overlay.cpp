// What is drawn into the level: the brush, the spawn point, the probe and its story, the player.
#include <algorithm>
#include <cmath>

#include "panels/viewport_panel.h"
#include "slipface/level/find_start.h"
#include "slipface/movement/step.h"
#include "slipface/render/trace_overlay.h"

namespace slipface {
namespace {

constexpr Color accent{0.945f, 0.690f, 0.330f, 1.0f};
constexpr Color quiet{0.85f, 0.88f, 0.92f, 0.9f};
constexpr Color spawn_color{0.45f, 0.78f, 0.545f, 1.0f};

Color faded(Color color, float alpha) {
    return {color.red, color.green, color.blue, color.alpha * alpha};
}

// The main spawn as the whole player, the others as the position of the feet.
void add_spawns(Overlay& overlay, const Document& document) {
    const Level& level = document.level();
    const double radius = level.movement.radii.x();
    const auto add = [&](const Vec3& position, double yaw, float strength) {
        const Vec3 feet = position - Vec3(0, level.movement.radii.y(), 0);
        overlay.disc(feet + Vec3(0, 0.01, 0), Vec3::UnitY(), radius, faded(spawn_color, 0.22f * strength),
                     faded(spawn_color, strength));
        const Vec3 ahead{-std::sin(yaw), 0.0, -std::cos(yaw)};
        overlay.arrow(feet + Vec3(0, 0.02, 0), feet + Vec3(0, 0.02, 0) + ahead * radius * 2.2,
                      faded(spawn_color, strength), 2.0f, false);
    };
    for (const Spawn& spawn : level.more_spawns)
        add(spawn.position, spawn.yaw, 0.6f);
    if (!has_spawn(level)) return;
    add(level.spawn, level.spawn_yaw, 1.0f);
    overlay.ellipsoid(level.spawn, level.movement.radii, faded(spawn_color, 0.0f), faded(spawn_color, 0.45f));
}

void add_brush(Overlay& overlay, const Editor& editor) {
    if (editor.hovered == no_id) return;
    double radius = 0.0;
    if (editor.tool == Tool::paint) radius = editor.brush_radius;
    if (editor.tool == Tool::select && editor.select_shape == SelectShape::brush)
        radius = editor.select_radius;
    if (radius <= 0.0) return;
    overlay.disc(editor.hovered_point + editor.hovered_normal * 0.01, editor.hovered_normal, radius,
                 faded(accent, 0.06f), accent);
}

void add_probe(Overlay& overlay, const Editor& editor, const Camera& camera, double viewport_height) {
    if (!editor.probe.placed || (editor.tool != Tool::probe && !editor.layout.shown(PanelId::probe))) return;
    const Document& document = *editor.document;
    const MovementSettings& settings = document.level().movement;
    const Probe& probe = editor.probe;
    const ProbeResult result = run_probe(probe, document.scene(), settings);
    draw_trace(overlay, first_sweeps(result.records, probe.shown_sweeps.value_or(result.records.size())),
               settings.radii);
    if (probe.move.isZero()) overlay.ellipsoid(probe.from, settings.radii, faded(accent, 0.14f), accent);
    if (editor.tool != Tool::probe) return;
    const Vec3 end = probe.from + probe.move;
    overlay.cross(probe.from, 6.0 * metres_per_pixel(camera, probe.from, viewport_height), quiet, 3.0f);
    overlay.cross(end, 6.0 * metres_per_pixel(camera, end, viewport_height), accent, 3.0f);
}

void add_player(Overlay& overlay, const Editor& editor) {
    const MovementSettings& settings = editor.document->level().movement;
    const Playtest& playtest = *editor.playtest;
    if (editor.show_trace) {
        std::vector<TraceRecord> contacts;
        for (const TraceRecord& record : playtest.last_trace())
            if (const auto* sweep = std::get_if<SweepRecord>(&record); sweep && sweep->contact)
                contacts.push_back(record);
        for (const TraceRecord& record : contacts) {
            const Contact& contact = *std::get<SweepRecord>(record).contact;
            overlay.disc(contact.point + contact.normal * 0.01, contact.normal, 0.16, faded(accent, 0.35f),
                         accent);
            overlay.arrow(contact.point, contact.point + contact.normal * 0.45, accent, 2.0f, true);
        }
    }
    if (playtest.first_person) return;
    const Vec3 centre = playtest.shown_position();
    overlay.ellipsoid(centre, body_radii(settings, playtest.state()), {0.36f, 0.60f, 0.86f, 0.75f},
                      {0.80f, 0.90f, 1.0f, 0.9f});
    const Vec3 velocity = motion_velocity(playtest.state());
    if (velocity.norm() > 0.1)
        overlay.arrow(centre, centre + velocity * 0.2, {1.0f, 1.0f, 1.0f, 0.9f}, 2.0f, true);
}

}  // namespace

double metres_per_pixel(const Camera& camera, const Vec3& point, double viewport_height) {
    if (camera.orthographic) return camera.ortho_height / std::max(1.0, viewport_height);
    const double depth = std::max(0.01, (point - camera.eye).dot((camera.target - camera.eye).normalized()));
    return 2.0 * depth * std::tan(0.5 * camera.fov_y) / std::max(1.0, viewport_height);
}

Overlay viewport_overlay(const Editor& editor, const Camera& camera, double height) {
    Overlay overlay;
    if (editor.playtest) {
        add_player(overlay, editor);
        return overlay;
    }
    add_spawns(overlay, *editor.document);
    add_brush(overlay, editor);
    add_probe(overlay, editor, camera, height);
    add_heat(overlay, editor);
    add_reach(overlay, editor);
    add_lab(overlay, editor);
    add_prop_handles(overlay, editor, camera, height);
    return overlay;
}

}  // namespace slipface
