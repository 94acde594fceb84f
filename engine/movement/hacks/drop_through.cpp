// Problem: a one-sided floor is entered from below and cannot be left again but over its rim. Hack: with drop
// held no sweep sees one-sided faces; once the body cuts one, it is let through whatever the button does.
#include "mover.h"

namespace slipface {

void drop_through(Mover& mover) {
    const bool asks = mover.buttons.has(Button::drop);
    if (!asks && !mover.state.dropping) return;
    if (!mover.settings.drop_through) {
        const bool stands =
            mover.state.grounded &&
            world_of(mover, mover.state.ground_platform).surface_rule(mover.state.ground_surface).one_sided;
        if (stands) decide(mover, Decision::drop_through_off, mover.state.ground_face);
        return;
    }
    mover.dropping = true;
    decide(mover, Decision::dropped_through, mover.state.ground_face);
}

std::optional<Contact> sweep_dropping(const Mover& mover, std::uint32_t platform, const Vec3& from,
                                      const Vec3& move) {
    QueryFilter two_sided;
    for (std::size_t i = 0; i < mover.scene.surfaces.size() && i < two_sided.ignored.size(); ++i)
        two_sided.ignored[i] = mover.scene.surfaces[i].one_sided;
    return sweep_ellipsoid(world_of(mover, platform), mover.settings.radii, from, move, two_sided);
}

bool drops_on(const Mover& mover) {
    if (!mover.dropping) return false;
    return mover.buttons.has(Button::drop) || !is_free(mover, mover.position);
}

}  // namespace slipface
