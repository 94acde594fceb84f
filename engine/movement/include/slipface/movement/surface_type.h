// Surface types are data: the response code reads these parameters and never a name.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "slipface/base/types.h"
#include "slipface/collision/collision_world.h"

namespace slipface {

// How the overlay draws a type, so that types are distinguished without colour.
enum class Hatch : std::uint8_t { none, diagonal, cross, dots, horizontal, vertical, checker, rings };
inline constexpr std::array<const char*, 8> hatch_names{"none",       "diagonal", "cross",   "dots",
                                                        "horizontal", "vertical", "checker", "rings"};

inline constexpr double max_friction = 10.0;

struct SurfaceType {
    std::string name = "default";
    std::array<float, 3> color{0.62f, 0.64f, 0.67f};  // sRGB, 0..1
    Hatch hatch = Hatch::none;
    int hotkey = 0;  // 1..9, 0: none

    double friction = 1.0;      // how well the ground holds, 0..max_friction: 1 as plain ground, 0 slides
    double restitution = 0.0;   // fraction of the perpendicular velocity given back, 0..1
    bool keeps_energy = false;  // slides without loss: ice, half-pipes
    bool climbable = false;
    double climb_speed = 3.0;         // m/s along the ladder's plane
    bool sticky = false;              // holds a player that touches it until a jump
    Vec3 velocity = Vec3::Zero();     // m/s, world space: what stands on it is carried (conveyor)
    double angular_velocity = 0.0;    // rad/s about +Y through `spin_centre` (turntable)
    Vec3 spin_centre = Vec3::Zero();  // metres, world space
    bool one_sided = false;
    bool solid = true;
    bool hazardous = false;                          // touching it respawns
    bool grabbable = true;                           // hands hold its edges, where the settings allow it
    std::optional<double> max_slope = std::nullopt;  // radians, instead of MovementSettings::max_slope

    friend bool operator==(const SurfaceType&, const SurfaceType&) = default;
};

using SurfaceTable = std::span<const SurfaceType>;  // [SurfaceId]; entry 0 is `default`

// The types every new level starts with, in this order: default, ice, ladder, sticky, bouncy, conveyor,
// turntable, hazard. Colours are safe for colour-blind users (Okabe and Ito, 2008).
std::vector<SurfaceType> preset_surface_types();

// What collision needs to know of the types.
void apply_surface_rules(CollisionWorld& world, SurfaceTable surfaces);

// One row per parameter: feeds the palette editor, its tooltips, the level file and the docs.
struct SurfaceField {
    const char* name;  // as in the level file
    const char* label;
    const char* unit;
    double minimum, maximum;
    const char* meaning;
    std::variant<bool SurfaceType::*, double SurfaceType::*, Vec3 SurfaceType::*,
                 std::optional<double> SurfaceType::*>
        member;
};
std::span<const SurfaceField> surface_fields();

}  // namespace slipface
