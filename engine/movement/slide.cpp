// Collide and slide (lecture, "Sliding for player movement"): sweep, move to the contact, deflect the
// remainder, repeat. Deflecting the original displacement instead of the remainder would speed the player up.
#include <algorithm>

#include "mover.h"

namespace slipface {

Vec3 collide_and_slide(Mover& mover, Pass pass, const Vec3& move) {
    Corner corner;
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
        done += (1.0 - done) * swept.used;
        remainder *= 1.0 - swept.used;

        const SurfaceType& surface = surface_of(mover, swept.contact->surface);
        const Hit hit{.pass = pass,
                      .contact = *swept.contact,
                      .surface = surface,
                      .platform = swept.platform,
                      .walkable = is_walkable(mover, swept.contact->normal, surface) ||
                                  (pass == Pass::vertical && on_rim(mover, *swept.contact)),
                      .remainder = remainder,
                      .done = done};
        mover.met[static_cast<std::size_t>(mover.met_count++)] = {.point = hit.contact.point,
                                                                  .normal = hit.contact.normal,
                                                                  .triangle = swept.triangle,
                                                                  .platform = hit.platform,
                                                                  .walkable = hit.walkable};
        touch(mover, hit);
        const Vec3 velocity = mover.velocity;
        Deflection deflection = respond(mover, hit);
        respect_corner(corner, remainder, velocity, deflection);
        if (mover.trace != nullptr) {
            mover.trace->add(ResponseRecord{.rule = deflection.rule,
                                            .remainder_before = remainder,
                                            .remainder_after = deflection.remainder,
                                            .velocity_before = velocity,
                                            .velocity_after = deflection.velocity,
                                            .normal = swept.contact->normal,
                                            .surface = swept.contact->surface,
                                            .face = swept.contact->face});
        }
        remainder = deflection.remainder;
        mover.velocity = deflection.velocity;
        const auto slot = static_cast<std::size_t>(corner.count++);
        corner.planes[slot] = deflection.plane;
        corner.constrains_velocity[slot] = deflection.constrains_velocity;
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
