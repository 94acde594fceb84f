// Problem: a step of 30 cm stops a player like a wall.
// Hack (lecture, "Case study: MDK2"): lift the player, move, and drop by the same amount, unless something is
// there. Tried only where a wall stopped the plain move, and kept only where it led further: along a wall
// both lead as far, so nobody gains speed there.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// The way gained must be worth it, as a share of the move.
constexpr double worth = 1e-3;

}  // namespace

// The round foot meets the rim of a step long before its centre is above it, and the touch is as steep as a
// wall's. It is a step all the same where the ground below the centre lies no deeper than a step.
bool on_rim(Mover& mover, const Contact& contact) {
    const MovementSettings& s = mover.settings;
    const double deepest = std::max(s.step_up ? s.step_height : 0.0, s.snap_down ? s.snap_distance : 0.0);
    if (!(deepest > 0.0) || contact.feature == Feature::interior || !(contact.normal.y() > 0.05))
        return false;
    const double reach = mover.position.y() - contact.point.y() + deepest;
    const std::optional<RayHit> ground = ray_in_scene(mover, mover.position, Vec3(0.0, -reach, 0.0));
    const bool rim = ground && std::abs(ground->normal.y()) >= mover.walkable_cosine;
    decide(mover, s.step_up ? "step_up" : "snap_down", rim, "rim above ground, m",
           ground ? ground->t * reach - (mover.position.y() - contact.point.y()) : deepest, deepest,
           rim ? "stands on the rim of a step" : "refused: no ground a step below the rim", contact.face);
    return rim;
}

bool step_up(Mover& mover, const Motion& before, const Vec3& level) {
    const double height = mover.settings.step_height;
    const Motion plain = mover;
    const auto refuse = [&](const char* quantity, double value, double limit, const char* why) {
        decide(mover, "step_up", false, quantity, value, limit, why, plain.support_face);
        mover.motion() = plain;
        return false;
    };
    if (!mover.settings.step_up)
        return refuse("", 0.0, 0.0, "switched off: whatever is in the way is a wall");
    if (!mover.was_grounded) return refuse("grounded", 0.0, 1.0, "refused: steps up from the ground only");
    mover.motion() = before;
    mover.position = sweep_with_skin(mover, Pass::step, 0, Vec3(0.0, height, 0.0)).reached;
    const double lifted = mover.position.y() - before.position.y();
    if (!(lifted > mover.settings.skin))
        return refuse("lifted, m", lifted, mover.settings.skin, "refused: no room overhead");

    collide_and_slide(mover, Pass::horizontal, level);
    if (mover.stuck || mover.climbing) return refuse("held", 1.0, 0.0, "refused: held by a surface up there");
    const Vec3 heading = direction_of(level);
    const double gained = (mover.position - plain.position).dot(heading);
    const double least = worth * level.norm();
    if (!(gained > least)) return refuse("gained, m", gained, least, "refused: leads no further");

    const double drop = lifted + press_down(mover, Vec3::UnitY(), Vec3::Zero());
    const Swept landing = sweep_with_skin(mover, Pass::step, 1, Vec3(0.0, -drop, 0.0));
    if (!landing.contact) return refuse("dropped, m", drop, drop, "refused: no ground up there");
    const Contact& contact = *landing.contact;
    const SurfaceType& surface = surface_of(mover, contact.surface);
    if (sticks(mover, surface) || restitution_of(mover, surface) > 0.0)
        return refuse("plain ground", 0.0, 1.0, "refused: the surface up there has its own response");
    mover.position = landing.reached;
    const bool walkable = is_walkable(mover, contact.normal, surface);
    if (!walkable && !on_rim(mover, contact)) {
        return refuse("N.y", contact.normal.y(), walkable_limit(mover, surface),
                      "refused: too steep up there");
    }
    mover.grounded = true;
    mover.hazard = mover.hazard || surface.hazardous;
    mover.support_normal = walkable ? contact.normal : Vec3(Vec3::UnitY());
    mover.support_face = contact.face;
    mover.support_surface = contact.surface;
    mover.support_platform = landing.platform;
    decide(mover, "step_up", true, "climbed, m", mover.position.y() - before.position.y(), height, "steps up",
           contact.face);
    return true;
}

}  // namespace slipface
