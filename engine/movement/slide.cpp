// Collide and slide (lecture, "Sliding for player movement"): sweep, move to the contact, deflect the
// remainder, repeat. Deflecting the original displacement instead of the remainder would speed the player up.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

Hit hit_of(Mover& mover, Pass pass, const Swept& swept, const Vec3& remainder, double done) {
    const Contact& contact = *swept.contact;
    const SurfaceType& surface = surface_of(mover, contact.surface);
    return {.pass = pass,
            .contact = contact,
            .surface = surface,
            .platform = swept.platform,
            .walkable = is_walkable(mover, contact.normal, surface) ||
                        (pass == Pass::vertical && on_rim(mover, contact)),
            .remainder = remainder,
            .done = done};
}

void trace_response(const Mover& mover, const Hit& hit, const Deflection& deflection) {
    if (mover.trace == nullptr) return;
    mover.trace->add(ResponseRecord{.rule = deflection.rule,
                                    .remainder_before = hit.remainder,
                                    .remainder_after = deflection.remainder,
                                    .velocity_before = mover.velocity,
                                    .velocity_after = deflection.velocity,
                                    .normal = hit.contact.normal,
                                    .surface = hit.contact.surface,
                                    .face = hit.contact.face});
}

// The walls that stop a walking player take nothing from what the ground can do for it along them: what could
// not change its velocity into them changes it towards what of the asked one they leave. Otherwise most of
// the effort would go into the walls, and a player would swing to and fro in a wide corner like a pendulum.
void walk_along(const Mover& mover, const Corner& corner, Deflection& deflection) {
    if (mover.asked.velocity.isZero(0.0) || !deflection.slides || !deflection.constrains_velocity ||
        mover.bounced || mover.kept_energy)
        return;
    const double spare = mover.asked.change - nearest_in_corner(corner, mover.asked.changed).norm();
    const Vec3 missing =
        horizontal(nearest_in_corner(corner, mover.asked.velocity)) - horizontal(deflection.velocity);
    const double length = missing.norm();
    if (spare > 0.0) deflection.velocity += missing * (length > spare ? spare / length : 1.0);
}

}  // namespace

std::optional<TouchDown> touch_down(Mover& mover, const Vec3& move, const Vec3& last) {
    const Swept swept = sweep_with_skin(mover, Pass::slide, 0, move - last);
    if (!swept.contact) {
        mover.position = swept.reached;
        return TouchDown{.flies = true};
    }
    const SurfaceType& surface = surface_of(mover, swept.contact->surface);
    if (!is_walkable(mover, swept.contact->normal, surface) && !(restitution_of(mover, surface) > 0.0))
        return std::nullopt;
    ++mover.contacts;
    mover.position = swept.reached;
    const double done = swept.used * (move - last).norm() / move.norm();
    const Vec3 rest = (move - last) * (1.0 - swept.used) + last;
    const Hit hit = hit_of(mover, Pass::vertical, swept, rest, done);
    touch(mover, hit);
    Deflection deflection = respond(mover, hit);
    const bool stands = mover.grounded && deflection.rule == Rule::stop;
    if (stands) deflection.remainder = horizontal(hit.remainder);
    trace_response(mover, hit, deflection);
    mover.velocity = deflection.velocity;
    return TouchDown{.left = 1.0 - done, .remainder = deflection.remainder, .stands = stands};
}

Vec3 collide_and_slide(Mover& mover, Pass pass, const Vec3& move) {
    Corner corner(pass, move, mover.velocity);
    // What carries on of an earlier speed is no wish of a player that walks.
    if (!mover.asked.velocity.isZero(0.0) && pass != Pass::vertical) {
        corner.wish = mover.asked.velocity * mover.dt;
        corner.wished_velocity = mover.asked.velocity;
    }
    Vec3 remainder = move;
    double done = 0.0;
    mover.met_count = 0;
    const int slides = std::clamp(mover.settings.max_slides, 1, slide_capacity);
    const double negligible = 1e-9 * mover.settings.skin;
    for (int i = 0; i < slides; ++i) {
        if (!(remainder.norm() > negligible)) return Vec3::Zero();
        const Swept swept = sweep_with_skin(mover, pass, i, remainder);
        mover.position = swept.reached;
        if (!swept.contact) return Vec3::Zero();
        ++mover.contacts;
        if (swept.used * remainder.norm() > mover.settings.skin) {
            corner.led = remainder / (1.0 - done);
            corner.led_velocity = mover.velocity;
        }
        done += (1.0 - done) * swept.used;
        remainder *= 1.0 - swept.used;

        const Hit hit = hit_of(mover, pass, swept, remainder, done);
        mover.meet({.point = hit.contact.point,
                    .normal = hit.contact.normal,
                    .triangle = swept.triangle,
                    .platform = hit.platform,
                    .walkable = hit.walkable});
        touch(mover, hit);
        Deflection deflection = respond(mover, hit);
        // Hardly any way is left, or a swing of an earlier speed: the player may be in a corner.
        const Vec3& along = deflection.remainder;
        if (deflection.slides && (along.norm() < 8.0 * mover.settings.skin || along.dot(corner.wish) < 0.0))
            meet_others(mover, hit, corner);
        respect_corner(corner, 1.0 - done, deflection);
        walk_along(mover, corner, deflection);
        trace_response(mover, hit, deflection);
        remainder = deflection.remainder;
        mover.velocity = deflection.velocity;
    }
    if (remainder.norm() > negligible) {
        decide(mover, Decision::slides_used_up, {.value = remainder.norm()}, mover.support.face);
    }
    return remainder;
}

SlideResult slide_move(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                       const Vec3& move, TraceSink* trace) {
    if (!from.allFinite() || !move.allFinite()) return {.position = from, .remainder = Vec3::Zero()};
    const PlayerState before{.position = from};
    const Surroundings around(scene, settings, from, move.norm());
    Mover mover({.scene = scene, .settings = settings, .state = before, .trace = trace, .dt = 1.0}, around);
    mover.velocity = move;
    mover.velocity_before = move;
    const Vec3 remainder = collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    return {.position = mover.position, .remainder = remainder, .contacts = mover.contacts};
}

}  // namespace slipface
