#include "slipface/movement/surface_type.h"

#include <algorithm>

namespace slipface {

std::vector<SurfaceType> preset_surface_types() {
    std::vector<SurfaceType> types(8);
    types[0] = {.hotkey = 1};
    types[1] = {.name = "ice",
                .color = {0.34f, 0.71f, 0.91f},
                .hatch = Hatch::diagonal,
                .hotkey = 2,
                .keeps_energy = true};
    types[2] = {.name = "ladder",
                .color = {0.90f, 0.62f, 0.00f},
                .hatch = Hatch::horizontal,
                .hotkey = 3,
                .climbable = true};
    types[3] = {
        .name = "sticky", .color = {0.80f, 0.47f, 0.65f}, .hatch = Hatch::dots, .hotkey = 4, .sticky = true};
    types[4] = {.name = "bouncy",
                .color = {0.00f, 0.62f, 0.45f},
                .hatch = Hatch::rings,
                .hotkey = 5,
                .restitution = 0.8};
    types[5] = {.name = "conveyor",
                .color = {0.94f, 0.89f, 0.26f},
                .hatch = Hatch::vertical,
                .hotkey = 6,
                .velocity = Vec3(0.0, 0.0, -2.0)};
    types[6] = {.name = "turntable",
                .color = {0.00f, 0.45f, 0.70f},
                .hatch = Hatch::checker,
                .hotkey = 7,
                .angular_velocity = 1.0};
    types[7] = {.name = "hazard",
                .color = {0.84f, 0.37f, 0.00f},
                .hatch = Hatch::cross,
                .hotkey = 8,
                .hazardous = true};
    return types;
}

void apply_surface_rules(CollisionWorld& world, SurfaceTable surfaces) {
    const std::size_t count = std::min(surfaces.size(), max_surface_types);
    for (std::size_t i = 0; i < count; ++i) {
        world.set_surface_rule(static_cast<SurfaceId>(i),
                               {.solid = surfaces[i].solid, .one_sided = surfaces[i].one_sided});
    }
}

std::span<const SurfaceField> surface_fields() {
    using T = SurfaceType;
    static const auto fields = std::to_array<SurfaceField>({
        {"friction", "Friction", "", 0.0, max_friction,
         "How well the ground holds: 1 as plain ground, 0 slides, more starts and stops faster. Multiplies "
         "acceleration and braking; below 1 slopes pull; above 1 a bounce loses speed along the surface.",
         &T::friction},
        {"restitution", "Restitution", "", 0.0, 1.0,
         "Fraction of the velocity into the surface that a bounce returns: 0 slides, 1 bounces for ever. A "
         "fall from h bounces to restitution*restitution*h.",
         &T::restitution},
        {"keeps_energy", "Keeps energy", "", 0.0, 1.0,
         "Slides without loss and without static friction: ice, half-pipes.", &T::keeps_energy},
        {"climbable", "Climbable", "", 0.0, 1.0, "A ladder: climbed along its plane, without gravity.",
         &T::climbable},
        {"climb_speed", "Climb speed", "m/s", 0.0, 50.0, "Speed along the plane of a climbable surface.",
         &T::climb_speed},
        {"sticky", "Sticky", "", 0.0, 1.0,
         "Holds a player who touches it until a jump; also on walls and ceilings.", &T::sticky},
        {"velocity", "Velocity", "m/s", -50.0, 50.0,
         "Carries what stands on it: a conveyor belt. World space.", &T::velocity},
        {"angular_velocity", "Angular velocity", "rad/s", -50.0, 50.0,
         "Rotates the player that stands on it about the vertical axis through the spin centre, "
         "counter-clockwise seen from above.",
         &T::angular_velocity},
        {"spin_centre", "Spin centre", "m", -1e6, 1e6,
         "A point of the turntable's axis of rotation. World space.", &T::spin_centre},
        {"one_sided", "One-sided", "", 0.0, 1.0,
         "Solid from the front only; the player passes through from behind.", &T::one_sided},
        {"solid", "Solid", "", 0.0, 1.0, "Off: nothing collides with it.", &T::solid},
        {"hazardous", "Hazardous", "", 0.0, 1.0, "A player who touches it returns to the spawn point.",
         &T::hazardous},
        {"max_slope", "Maximum slope", "deg", 0.0, 1.5533430342749532,
         "Maximum walkable slope of this surface, instead of the player's setting.", &T::max_slope},
        {"grabbable", "Grabbable", "", 0.0, 1.0,
         "Off: no ledge of it is grabbed, neither its top nor the wall below.", &T::grabbable},
    });
    return fields;
}

}  // namespace slipface
