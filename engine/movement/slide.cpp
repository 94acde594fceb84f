// Collide and slide (lecture, "Sliding for player movement"): sweep, move to the contact, turn what is left,
// repeat. Only the leftover is turned, never the original displacement, which would speed the player up.
#include <algorithm>

#include "mover.h"

namespace slipface {

Vec3 collide_and_slide(Mover& mover, Pass pass, const Vec3& move) {
    Corner corner;
    Vec3 leftover = move;
    double done = 0.0;
    const int slides = std::clamp(mover.settings.max_slides, 1, Corner::capacity);
    const double negligible = 1e-9 * mover.settings.skin;
    for (int i = 0; i < slides; ++i) {
        if (!(leftover.norm() > negligible)) return Vec3::Zero();
        const Swept swept = sweep_with_skin(mover, pass, i, leftover);
        mover.position = swept.reached;
        if (!swept.contact) return Vec3::Zero();
        ++mover.contacts;
        done += (1.0 - done) * swept.used;
        leftover *= 1.0 - swept.used;

        const SurfaceType& surface = surface_of(mover, swept.contact->surface);
        const Hit hit{.pass = pass,
                      .contact = *swept.contact,
                      .surface = surface,
                      .platform = swept.platform,
                      .walkable = is_walkable(mover, swept.contact->normal, surface) ||
                                  (pass == Pass::vertical && on_rim(mover, *swept.contact)),
                      .leftover = leftover,
                      .done = done};
        touch(mover, hit);
        const Vec3 velocity = mover.velocity;
        Turn turn = respond(mover, hit);
        respect_corner(corner, leftover, velocity, turn);
        if (mover.trace != nullptr) {
            mover.trace->add(ResponseRecord{.rule = turn.rule,
                                            .leftover_before = leftover,
                                            .leftover_after = turn.leftover,
                                            .velocity_before = velocity,
                                            .velocity_after = turn.velocity,
                                            .normal = swept.contact->normal,
                                            .surface = swept.contact->surface,
                                            .face = swept.contact->face});
        }
        leftover = turn.leftover;
        mover.velocity = turn.velocity;
        const auto slot = static_cast<std::size_t>(corner.count++);
        corner.planes[slot] = turn.plane;
        corner.constrains_velocity[slot] = turn.constrains_velocity;
    }
    if (leftover.norm() > negligible) {
        decide(mover, Decision::slides_used_up, {.value = leftover.norm()}, mover.support_face);
    }
    return leftover;
}

SlideResult slide_move(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                       const Vec3& move, TraceSink* trace) {
    if (!from.allFinite() || !move.allFinite()) return {.position = from, .leftover = Vec3::Zero()};
    Mover mover(scene, settings, trace, 1.0, from, reach_of_step(settings, move.norm()));
    mover.walkable_cosine = slope_cosine(settings.max_slope);
    mover.velocity = move;
    mover.velocity_before = move;
    const Vec3 leftover = collide_and_slide(mover, move.y() == 0.0 ? Pass::horizontal : Pass::slide, move);
    return {.position = mover.position, .leftover = leftover, .contacts = mover.contacts};
}

}  // namespace slipface
