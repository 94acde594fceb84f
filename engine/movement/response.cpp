// What a contact does: first what it means for the state, then how it turns the move.
#include "mover.h"

namespace slipface {

namespace {

using Response = std::optional<Turn> (*)(Mover&, const Hit&);

// In the order in which they are asked. A new response is a file with one such function and one name here.
constexpr std::array<Response, 7> responses{stick,       grab_ladder,   hold_by_static_friction, bounce,
                                            keep_energy, slide_at_wall, go_straight_ahead};

}  // namespace

void touch(Mover& mover, const Hit& hit) {
    if (hit.surface.hazardous && !mover.hazard)
        decide(mover, "surface_types", true, "hazardous", 1.0, 0.0, "touches a hazard", hit.contact.face);
    mover.hazard = mover.hazard || hit.surface.hazardous;
    if (!mover.settings.surface_types && hit.contact.surface != default_surface) {
        decide(mover, "surface_types", false, "type", hit.contact.surface, default_surface,
               "switched off: plain ground", hit.contact.face);
    }
    // The horizontal part of a move meets ramps that the vertical part may then leave; only the latter knows
    // the ground.
    const bool ground = hit.walkable && hit.pass != Pass::horizontal;
    if (mover.grounded && !ground) return;
    mover.grounded = mover.grounded || ground;
    // A rim is stood on as if it were level.
    const bool rim = ground && !is_walkable(mover, hit.contact.normal, hit.surface);
    mover.support_normal = rim ? Vec3(Vec3::UnitY()) : hit.contact.normal;
    mover.support_face = hit.contact.face;
    mover.support_surface = hit.contact.surface;
    mover.support_platform = hit.platform;
}

Turn respond(Mover& mover, const Hit& hit) {
    for (const Response response : responses) {
        if (const std::optional<Turn> turn = response(mover, hit)) return *turn;
    }
    const Vec3& normal = hit.contact.normal;
    return {.rule = Rule::slide,
            .leftover = slide_along(hit.leftover, normal),
            .velocity = slide_along(mover.velocity, normal),
            .plane = normal};
}

}  // namespace slipface
