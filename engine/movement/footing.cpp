// Which contacts of a stair can be stood on.
//
// The round foot touches the rim of a step long before its centre is above it, and there the contact is as
// steep as a wall. On short treads the foot rests on a rim while its centre is still above a tread several
// steps below. So neither the slope of the contact nor its height above the ground below says whether it is a
// step. The ground between them does: from below the centre to the rim, and on behind the rim, it rises by no
// more than a step at once. In front of a cliff, a wall or a steep ramp it does not.
//
// Rays sample the ground. They begin inside the ellipsoid, which is free of geometry, so nothing overhead is
// taken for ground. Faces too steep to stand on are risers and are skipped.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// Samples of the ground between the centre and the touched point: treads from a sixteenth of a radius on.
constexpr int samples = 16;

// A rise of exactly the step height counts as a step although the corners of meshes are rounded to floats.
double with_rounding(double height, const Vec3& at) {
    return height * 1.001 + 2.4e-7 * at.cwiseAbs().maxCoeff();
}

// The height of the walkable ground below `from`, if it is not deeper than `depth`.
std::optional<double> ground_below(const Mover& mover, const Vec3& from, double depth) {
    std::optional<double> height;
    if (const auto hit = ray_in_scene(mover, from, Vec3(0.0, -depth, 0.0))) {
        if (std::abs(hit->normal.y()) < walkable_limit(mover, surface_of(mover, hit->surface)))
            return std::nullopt;
        height = from.y() - hit->t * depth;
    }
    const Heightfield* const field = mover.settings.heightfield ? mover.scene.heightfield : nullptr;
    if (field == nullptr) return height;
    const std::optional<TerrainPoint> terrain = terrain_at(*field, from.x(), from.z());
    if (!terrain || terrain->height > from.y() || terrain->height < from.y() - depth) return height;
    if (height && *height >= terrain->height) return height;
    return terrain->normal.y() >= mover.walkable_cosine ? std::optional(terrain->height) : std::nullopt;
}

// Follows the ground from below `from` to below `to`, both at the height of `from`. False if it rises by more
// than `step` at once. `height` is the ground's height at the beginning, and is set to that at the end.
bool climbs_by_steps(const Mover& mover, const Vec3& from, const Vec3& to, double step, double& height) {
    for (int i = 1; i < samples; ++i) {
        const Vec3 at = from + horizontal(to - from) * (static_cast<double>(i) / samples);
        const std::optional<double> ground = ground_below(mover, at, at.y() - height + step);
        if (!ground) continue;
        if (*ground - height > step) return false;
        height = *ground;
    }
    return true;
}

// The last sample between `from` and `to`, at the height of `from`.
Vec3 last_sample(const Vec3& from, const Vec3& to) {
    return from + horizontal(to - from) * (static_cast<double>(samples - 1) / samples);
}

// True if no sample between `from` and `to` finds ground as high as `height`.
bool is_lower(const Mover& mover, const Vec3& from, const Vec3& to, double height) {
    if (!mover.scene.platforms.empty() || mover.scene.heightfield != nullptr) return false;
    double least = mover.walkable_cosine;
    for (const SurfaceType& type : mover.scene.surfaces)
        least = std::min(least, walkable_limit(mover, type));
    return highest_below(mover.around.near, from, to, least) + with_rounding(1e-6, to) < height;
}

// Whether there is ground behind the touched point, seen from the centre: at most a step above the ground in
// front of it, and at most a step below the point.
bool goes_on_behind(const Mover& mover, const Contact& contact, double before, double step) {
    const Vec3& centre = mover.position;
    const Vec3 out = horizontal(contact.point - centre);
    const Vec3 ahead = direction_of(out);
    const double radius = std::max(mover.settings.radii.x(), mover.settings.radii.z());
    const std::array<double, 4> distances{mover.settings.skin, radius / 16.0, radius / 8.0, radius / 4.0};
    // A wall higher than the centre ends the search: rays that begin inside it would be wrong.
    const double length = out.norm() + distances.back();
    const std::optional<SceneRay> wall = ray_in_scene(mover, centre, ahead * length);
    const double clear = wall ? wall->t * length : length;
    const double depth = centre.y() - contact.point.y() + step;
    for (const double further : distances) {
        if (out.norm() + further > clear) break;
        const std::optional<double> ground = ground_below(mover, centre + out + ahead * further, depth);
        if (ground && *ground - before <= step) return true;
    }
    return false;
}

}  // namespace

bool on_rim(Mover& mover, const Contact& contact) {
    const MovementSettings& s = mover.settings;
    const double setting = std::max(s.step_up ? s.step_height : 0.0, s.snap_down ? s.snap_distance : 0.0);
    if (!(setting > 0.0) || !(contact.normal.y() > 1e-3)) return false;
    const double step = with_rounding(setting, contact.point);
    const auto say = [&](Decision of_step, Decision of_snap, double value) {
        decide(mover, s.step_up ? of_step : of_snap, {.value = value, .limit = setting}, contact.face);
        return of_step == Decision::step_rim;
    };
    const Vec3& centre = mover.position;
    const double above = centre.y() - contact.point.y();
    const std::optional<double> below = ground_below(mover, centre, above + samples * step);
    if (!below) return say(Decision::step_rim_no_ground, Decision::snap_rim_no_ground, samples * step);
    double height = *below;
    // Mostly nothing leads up to it. Why not is for a trace.
    if (const double needed = contact.point.y() - step;
        mover.trace == nullptr && height < needed &&
        is_lower(mover, centre, last_sample(centre, contact.point), needed))
        return false;
    if (contact.point.y() - height > step && !climbs_by_steps(mover, centre, contact.point, step, height))
        return say(Decision::step_rim_no_steps, Decision::snap_rim_no_steps, contact.point.y() - *below);
    const double rise = contact.point.y() - height;
    if (rise > step) return say(Decision::step_rim_too_high, Decision::snap_rim_too_high, rise);
    if (!goes_on_behind(mover, contact, height, step))
        return say(Decision::step_rim_blocked, Decision::snap_rim_blocked, 0.0);
    return say(Decision::step_rim, Decision::snap_rim, rise);
}

bool no_higher_than_steps(const Mover& mover, const Motion& begin, const Contact& contact, double highest) {
    const double step = with_rounding(highest, contact.point);
    double height = begin.position.y() - mover.settings.radii.y() + begin.support_rise;
    if (contact.point.y() - height <= step) return true;
    Vec3 from = begin.position;
    from.y() = std::max(from.y(), mover.position.y());
    // Mostly nothing leads up, and that is known without looking at every sample.
    const Vec3 lifted(mover.position.x(), from.y(), mover.position.z());
    const Vec3 last = last_sample(lifted, contact.point);
    const double needed = contact.point.y() - step;
    if (is_lower(mover, from, lifted, needed) && is_lower(mover, lifted, last, needed)) return false;
    for (const Vec3& to : {mover.position, contact.point}) {
        if (!climbs_by_steps(mover, from, to, step, height)) return false;
        from = Vec3(to.x(), from.y(), to.z());
        const std::optional<double> ground = ground_below(mover, from, from.y() - height + step);
        if (to == mover.position && ground) {
            if (*ground - height > step) return false;
            height = *ground;
        }
    }
    return contact.point.y() - height <= step;
}

bool no_deeper_than_steps(const Mover& mover, const Vec3& begin, const Contact& contact, double deepest) {
    const double step = with_rounding(deepest, contact.point);
    // Backwards: up from the contact to the ground that the player left.
    double height = contact.point.y();
    Vec3 from = contact.point;
    from.y() = begin.y();
    const std::optional<double> left = ground_below(mover, begin, begin.y() - height + step);
    return left && climbs_by_steps(mover, from, begin, step, height) && *left - height <= step;
}

}  // namespace slipface
