// The one description of every setting. Editor widgets, tooltips, --set, files and docs read it.
#include <array>

#include "slipface/movement/settings.h"

namespace slipface {

namespace {

using S = MovementSettings;

constexpr double radians_per_degree = 0.017453292519943295;

const auto table = std::to_array<SettingInfo>({
    {"radius_x", "Radius X", "Body", "m", 0.05, 5.0,
     "Half the width of the player's ellipsoid along X. With a radius Z that differs, movement depends on "
     "the "
     "direction in the world.",
     "Slips into cracks between props and perches on rails and edges.",
     "Does not fit through doors and touches walls that look out of reach.", "", &S::radii, 0},
    {"radius_y", "Radius Y", "Body", "m", 0.05, 5.0,
     "Half the height of the player's ellipsoid. The position of the player is its centre, so the feet are "
     "this far "
     "below.",
     "Crawls under things that look too low.",
     "Bumps its head on ceilings, and the round foot makes high kerbs climbable.", "", &S::radii, 1},
    {"radius_z", "Radius Z", "Body", "m", 0.05, 5.0, "Half the width of the player's ellipsoid along Z.",
     "Slips into cracks between props and perches on rails and edges.",
     "Does not fit through doors and touches walls that look out of reach.", "", &S::radii, 2},

    {"gravity", "Gravity", "Speed", "m/s2", 0.0, 100.0,
     "Downward acceleration. Platformers use two to three times the real 9.81: a jump of speed v rises "
     "v*v/(2g) and "
     "lasts 2v/g.",
     "Jumps float and the player has no weight.", "Jumps snap back before they can be steered.", "",
     &S::gravity},
    {"walk_speed", "Walking speed", "Speed", "m/s", 0.0, 100.0,
     "Horizontal speed with the stick fully pushed.", "Levels feel long and dull.",
     "Corners are overshot, and gaps meant to need a run are jumped by accident.", "", &S::walk_speed},
    {"ground_acceleration", "Ground acceleration", "Speed", "m/s2", 0.0, 1000.0,
     "How fast the horizontal velocity follows the stick on the ground; also the deceleration when the stick "
     "is released.",
     "Every floor feels like ice.", "Starts and stops in one tick, like a cursor.", "",
     &S::ground_acceleration},
    {"slippery_acceleration", "Slippery acceleration", "Speed", "m/s2", 0.0, 1000.0,
     "Acceleration by the stick on surfaces that keep energy. These never brake.",
     "Ice cannot be left without a slope or a push.", "Ice is steered like any floor.", "",
     &S::slippery_acceleration},
    {"air_acceleration", "Air acceleration", "Speed", "m/s2", 0.0, 500.0,
     "How fast the horizontal velocity follows the stick in the air. A released stick "
     "does not brake.",
     "A jump cannot be corrected after take-off.", "The player turns round in mid-air and hugs walls.", "",
     &S::air_acceleration},
    {"terminal_speed", "Terminal speed", "Speed", "m/s", 1.0, 500.0, "Maximum falling speed.",
     "Long falls look like parachuting.", "Long falls cannot be followed by the camera or steered.", "",
     &S::terminal_speed},
    {"jump_speed", "Jump speed", "Speed", "m/s", 0.0, 50.0,
     "Upward speed at the start of a jump; along the surface's normal from a ladder or a sticky surface. The "
     "height is "
     "speed*speed/(2*gravity).",
     "Ledges meant to be reached are not.", "Skips parts of the level.", "", &S::jump_speed},

    {"skin", "Skin", "Collision", "m", 1e-4, 0.05,
     "Distance to every touched surface after a move. It makes rounding errors harmless: the next sweep "
     "starts clearly outside.",
     "Rounding errors far from the origin exceed it; the player catches on seams.",
     "A visible gap under the feet, and narrow passages close.", "", &S::skin},
    {"max_slides", "Slides", "Collision", "", 1.0, 8.0,
     "Maximum number of surfaces that one move can hit. Each one deflects the remainder of the move; the "
     "remainder after the last is dropped.",
     "With 1 the player sticks to every wall; with 2 the player gets stuck in concave corners.",
     "Costs sweeps without effect: three planes form a corner that stops any motion.", "", &S::max_slides},
    {"max_slope", "Maximum slope", "Collision", "deg", 0.0, 89.0 * radians_per_degree,
     "The steepest ground on which the player can walk and stand. Steeper faces act as walls, and the player "
     "slides down them.",
     "Slides off ramps that look walkable.", "Walks up cliffs.", "", &S::max_slope},
    {"sub_step", "Sub-step", "Collision", "s", 0.0, 0.25,
     "Maximum duration of one move; a longer tick is split into equal parts. 0: no splitting; otherwise at "
     "least 0.001 s. 1/720 s makes 30, 60, 120, 240 and 360 Hz run through the same parts.",
     "Costs a whole move for each part.", "Routes differ by centimetres between frame rates.", "",
     &S::sub_step, -1, 0.001},

    {"static_friction", "Static friction", "Hacks", "", 0.0, 1.0,
     "Splits the move into a horizontal part, which slides, and a vertical part: a single sweep that decides "
     "whether the player is grounded. Off: the whole move slides, and gravity makes the player creep down "
     "every slope.",
     "", "", "", &S::static_friction},
    {"ground_velocity", "Ground velocity", "Hacks", "", 0.0, 1.0,
     "Presses a grounded player down slightly instead of setting the vertical velocity to 0. Off: the player "
     "hops down ramps, and is in the air half of the time, when it cannot jump. Acts with static friction.",
     "", "", "", &S::ground_velocity},
    {"ground_speed", "Ground speed", "Hacks", "m/s", 0.0, 20.0,
     "Minimum downward speed of a grounded player. Down a slope it is increased so that the player stays on "
     "the ground.",
     "Leaves the ground at every crest.", "Drops off ledges as if pulled.", "ground_velocity",
     &S::ground_speed},
    {"straight_ahead", "Straight ahead on ramps", "Hacks", "", 0.0, 1.0,
     "A horizontal move that hits a ramp continues up the ramp in the same direction. Off: the ramp deflects "
     "the player sideways.",
     "", "", "", &S::straight_ahead},
    {"constant_slope_speed", "Constant speed on slopes", "Hacks", "", 0.0, 1.0,
     "On walkable slopes the speed along the slope is the walking speed. Off: downhill the horizontal speed "
     "is the walking speed, so the player moves faster along the slope; uphill the player is slower. Acts "
     "with static friction.",
     "", "", "", &S::constant_slope_speed},
    {"keep_energy", "Keep energy", "Hacks", "", 0.0, 1.0,
     "On surfaces that keep energy a glancing contact deflects the velocity without reducing the speed. Off: "
     "a half-pipe made of flat faces takes speed away at each of them.",
     "", "", "", &S::keep_energy},
    {"keep_energy_limit", "Keep energy limit", "Hacks", "", -1.0, 0.0,
     "Only hits with N.V / |V| above this keep their speed; more direct hits lose it. -0.5 is a deflection "
     "of 30 degrees.",
     "Running into an icy wall shoots the player along it at full speed.",
     "Half-pipes of few faces brake again.", "keep_energy", &S::keep_energy_limit},
    {"surface_types", "Surface types", "Hacks", "", 0.0, 1.0,
     "Ladders, ice, sticky, bouncy and moving surfaces and hazards have their effect. Off: every face is "
     "plain ground.",
     "", "", "", &S::surface_types},
    {"bounce", "Bounce", "Hacks", "", 0.0, 1.0,
     "Bouncy surfaces return a fraction of the impact speed. Off: they are landed on like any other.", "", "",
     "", &S::bounce},
    {"stick", "Stick", "Hacks", "", 0.0, 1.0,
     "Sticky surfaces, also walls and ceilings, hold a player who touches them until a jump. Off: they are "
     "plain ground.",
     "", "", "", &S::stick},
    {"push_out", "Push-out", "Hacks", "", 0.0, 2.0,
     "What happens to a player who is inside geometry at the start of a step, because of a bad spawn point "
     "or a moved wall. Off: the player can only move out. Iterative: out of the deepest triangle first, "
     "several times. Analytic: to the common point of up to three planes at once, which acute corners need.",
     "", "", "", choice<&S::push_out>(push_out_names)},
    {"nudge", "Nudge", "Hacks", "", 0.0, 1.0,
     "A player who is still inside geometry is moved by a small offset along an axis, the nearest free one. "
     "Off: a player who spawns inside a wall stays there.",
     "", "", "", &S::nudge},
    {"nudge_distance", "Nudge distance", "Hacks", "m", 0.0, 2.0, "Maximum offset.",
     "Real overlaps are deeper, and the player stays trapped.",
     "The player jumps visibly to the other side of things.", "nudge", &S::nudge_distance},
    {"step_up", "Step up", "Hacks", "", 0.0, 1.0,
     "A move that is stopped by a low obstacle is repeated from higher up, then lowered by the same amount. "
     "Off: stairs are walls.",
     "", "", "", &S::step_up},
    {"step_form", "Step form", "Hacks", "", 0.0, 1.0,
     "When a step is tried. When blocked: a move that hits a wall is repeated from higher up, and the better "
     "result is used. Every move: the lecture's form (MDK2), each move on the ground is lifted before and "
     "dropped after, so the player needs room for a step above its head wherever it walks.",
     "", "", "step_up", choice<&S::step_form>(step_form_names)},
    {"step_height", "Step height", "Hacks", "m", 0.0, 2.0, "The highest step that is climbed.",
     "Stops at kerbs and door sills.", "Walks up onto tables and over railings.", "step_up", &S::step_height},
    {"snap_down", "Snap to floor", "Hacks", "", 0.0, 1.0,
     "Puts a player who walked off a step or over a crest back onto the ground below. Off: the player leaves "
     "the ground at every step downwards and cannot jump there.",
     "", "", "", &S::snap_down},
    {"snap_distance", "Snap distance", "Hacks", "m", 0.0, 2.0,
     "How far below the feet the player searches for a floor.",
     "Leaves the ground at steps that are higher than this.",
     "Ledges pull the player down instead of releasing it.", "snap_down", &S::snap_distance},
    {"seam_filter", "Seam filter", "Hacks", "", 0.0, 1.0,
     "A contact with an edge inside a flat or concave surface counts as a contact with the face. Off: a "
     "player slightly inside a floor is stopped by invisible triangle edges.",
     "", "", "", &S::seam_filter},
    {"heightfield", "Heightfield", "Hacks", "", 0.0, 1.0,
     "Keeps the feet at or above the level's terrain: y = max(y, terrain(x, z)). Off: the "
     "player falls through terrain without triangles.",
     "", "", "", &S::heightfield},
    {"platforms", "Moving platforms", "Hacks", "", 0.0, 1.0,
     "Platforms carry players that stand on them, push players out of their path, and pass their velocity to "
     "players that leave them. Off: they slide away under the feet and run into the player.",
     "", "", "", &S::platforms},
    {"sectors", "Sectors", "Hacks", "", 0.0, 1.0,
     "Computes in the coordinates of the player's sector. Off: far from the origin positions are imprecise, "
     "and the player jitters and gets stuck. Only for levels with sectors.",
     "", "", "", &S::sectors},

    {"coyote", "Coyote time", "Jump", "", 0.0, 1.0,
     "A jump pressed just after running off a ledge still counts. Off: a player who presses one tick late "
     "falls.",
     "", "", "", &S::coyote},
    {"coyote_time", "Coyote window", "Jump", "s", 0.0, 0.5,
     "How long after leaving the ground a jump still starts.",
     "Jumps fail although the player pressed in time.", "Jumps start in mid-air, visibly off the ledge.",
     "coyote", &S::coyote_time},
    {"jump_buffer", "Jump buffer", "Jump", "", 0.0, 1.0,
     "A jump pressed just before landing starts on landing. Off: a press one tick early is lost.", "", "", "",
     &S::jump_buffer},
    {"jump_buffer_time", "Jump buffer window", "Jump", "s", 0.0, 0.5, "How long a jump press is stored.",
     "Quick successive jumps fail at random.", "The player jumps from an old press.", "jump_buffer",
     &S::jump_buffer_time},
    {"variable_jump", "Variable jump height", "Jump", "", 0.0, 1.0,
     "Releasing the button while rising cuts the jump short. Off: every jump has the full height.", "", "",
     "", &S::variable_jump},
    {"jump_cut", "Jump cut", "Jump", "", 0.0, 1.0,
     "Fraction of the upward speed that remains when the button is released. The remaining height is the "
     "square of it.",
     "A short press stops the jump dead in the air.", "Short and long presses jump alike.", "variable_jump",
     &S::jump_cut},
    {"air_control", "Air control", "Jump", "", 0.0, 1.0,
     "The stick steers in the air, as fast as the air acceleration allows. Off: a jump cannot be steered.",
     "", "", "", &S::air_control},
});

}  // namespace

std::span<const SettingInfo> settings_table() {
    return table;
}

}  // namespace slipface
