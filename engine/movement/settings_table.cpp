// The one description of every setting. Editor widgets, tooltips, --set, files and docs read it.
#include <array>

#include "slipface/movement/settings.h"

namespace slipface {

namespace {

using S = MovementSettings;

constexpr double radians_per_degree = 0.017453292519943295;

const auto table = std::to_array<SettingInfo>({
    {"radius_x", "Radius X", "Body", "m", 0.05, 5.0,
     "Half the width of the player's ellipsoid along X. Keep it equal to radius Z, or turning the world "
     "turns the player "
     "too.",
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
     "How fast the horizontal velocity follows the stick on the ground; also the braking when it is let go.",
     "Every floor feels like ice.", "Starts and stops in one tick, like a cursor.", "",
     &S::ground_acceleration},
    {"slippery_acceleration", "Slippery acceleration", "Speed", "m/s2", 0.0, 1000.0,
     "How fast walking speeds up on surfaces that keep energy. They never brake.",
     "Ice cannot be left without a slope or a push.", "Ice is steered like any floor.", "",
     &S::slippery_acceleration},
    {"air_acceleration", "Air acceleration", "Speed", "m/s2", 0.0, 500.0,
     "How fast the horizontal velocity follows the stick in the air. With the stick let go the flight goes "
     "on.",
     "A jump cannot be corrected after take-off.", "The player turns round in mid-air and hugs walls.", "",
     &S::air_acceleration},
    {"terminal_speed", "Terminal speed", "Speed", "m/s", 1.0, 500.0, "Falling gets no faster than this.",
     "Long falls look like parachuting.", "Long falls cannot be followed by the camera or steered.", "",
     &S::terminal_speed},
    {"jump_speed", "Jump speed", "Speed", "m/s", 0.0, 50.0,
     "Upward speed at the start of a jump; along the surface's normal from a ladder or a sticky surface. The "
     "height is "
     "speed*speed/(2*gravity).",
     "Ledges meant to be reached are not.", "Skips parts of the level.", "", &S::jump_speed},

    {"skin", "Skin", "Collision", "m", 1e-4, 0.05,
     "Distance kept from every surface that was touched. It is what makes rounding harmless: the next sweep "
     "starts "
     "clearly outside.",
     "Rounding far from the origin uses it up; the player catches on seams.",
     "A visible gap under the feet, and narrow passages close.", "", &S::skin},
    {"max_slides", "Slides", "Collision", "", 1.0, 8.0,
     "How many surfaces one move may meet. The rest of the move is turned at each of them; what is left "
     "after the last "
     "is given up.",
     "With 1 the player sticks to every wall; with 2 inner corners swallow movement.",
     "Costs sweeps and changes nothing: three planes are a corner that nothing leaves.", "", &S::max_slides},
    {"max_slope", "Maximum slope", "Collision", "deg", 0.0, 89.0 * radians_per_degree,
     "The steepest ground that is walked and stood on. Steeper faces are walls for walking, and the player "
     "slides down "
     "them.",
     "Slides off ramps that look walkable.", "Walks up cliffs.", "", &S::max_slope},
    {"sub_step", "Sub-step", "Collision", "s", 0.0, 0.25,
     "Longest part of a tick that is moved at once; a longer tick is cut into equal parts. 0 moves the whole "
     "tick, and anything else is at least 0.001 s. 1/720 s makes 30, 60, 120, 240 and 360 Hz run through "
     "the same parts.",
     "Costs a whole move for each part.", "Routes differ by centimetres between frame rates.", "",
     &S::sub_step, -1, 0.001},

    {"static_friction", "Static friction", "Hacks", "", 0.0, 1.0,
     "Splits the move into a horizontal part, which slides, and a vertical part, which gets one sweep and "
     "decides whether "
     "the player is grounded. Off: the whole move slides, and gravity makes the player creep down every "
     "slope.",
     "", "", "", &S::static_friction},
    {"ground_velocity", "Ground velocity", "Hacks", "", 0.0, 1.0,
     "Presses a grounded player down a little instead of setting the vertical velocity to 0. Off: the player "
     "hops down "
     "ramps and cannot jump half of the time. Acts with static friction.",
     "", "", "", &S::ground_velocity},
    {"ground_speed", "Ground speed", "Hacks", "m/s", 0.0, 20.0,
     "The least downward speed of a grounded player. Going down a slope it is raised to what the slope "
     "needs.",
     "Leaves the ground at every crest.", "Drops off ledges as if pulled.", "ground_velocity",
     &S::ground_speed},
    {"straight_ahead", "Straight ahead on ramps", "Hacks", "", 0.0, 1.0,
     "A horizontal move that meets a ramp goes up it in the direction it was heading. Off: the ramp turns "
     "the player "
     "sideways.",
     "", "", "", &S::straight_ahead},
    {"constant_slope_speed", "Constant speed on slopes", "Hacks", "", 0.0, 1.0,
     "On slopes that can be walked the walking speed is the speed along the slope, up and down. Off: down a "
     "slope the map is crossed at walking speed, which is faster along the slope, and up a slope slower. "
     "Acts with static friction.",
     "", "", "", &S::constant_slope_speed},
    {"keep_energy", "Keep energy", "Hacks", "", 0.0, 1.0,
     "On surfaces that keep energy a glancing contact turns the velocity without shortening it. Off: a "
     "half-pipe made of "
     "flat faces takes speed away at each of them.",
     "", "", "", &S::keep_energy},
    {"keep_energy_limit", "Keep energy limit", "Hacks", "", -1.0, 0.0,
     "Only hits with N.V / |V| above this keep their speed; steeper ones are head-on and lose it. -0.5 is a "
     "turn of 30 "
     "degrees.",
     "Running into an icy wall shoots the player along it at full speed.",
     "Half-pipes of few faces brake again.", "keep_energy", &S::keep_energy_limit},
    {"surface_types", "Surface types", "Hacks", "", 0.0, 1.0,
     "Ladders, ice, sticky, bouncy and moving surfaces and hazards act. Off: every face is plain ground.", "",
     "", "", &S::surface_types},
    {"bounce", "Bounce", "Hacks", "", 0.0, 1.0,
     "Bouncy surfaces give back a share of the speed that hits them. Off: they are landed on like any other.",
     "", "", "", &S::bounce},
    {"stick", "Stick", "Hacks", "", 0.0, 1.0,
     "Sticky surfaces hold whoever touches them, walls and ceilings too, until a jump. Off: they are plain "
     "ground.",
     "", "", "", &S::stick},
    {"push_out", "Push-out", "Hacks", "", 0.0, 2.0,
     "What happens to a player who is inside geometry at the start of a step, by a bad spawn point or a "
     "moved wall. Off: "
     "only moves that lead out are free. Iterative: out of the deepest triangle first, several times. "
     "Analytic: to the "
     "common point of up to three planes at once, which acute corners need.",
     "", "", "", choice<&S::push_out>(push_out_names)},
    {"nudge", "Nudge", "Hacks", "", 0.0, 1.0,
     "A player who is still inside geometry tries small offsets along the axes; the nearest free one wins. "
     "Off: "
     "who spawns inside a wall stays there.",
     "", "", "", &S::nudge},
    {"nudge_distance", "Nudge distance", "Hacks", "m", 0.0, 2.0, "The farthest offset that is tried.",
     "Real overlaps are deeper than that, and the player is reported as trapped.",
     "The player jumps visibly to the other side of things.", "nudge", &S::nudge_distance},
    {"step_up", "Step up", "Hacks", "", 0.0, 1.0,
     "A move that is stopped by something low is tried again from higher up, then dropped by the same "
     "amount. "
     "Off: stairs are walls.",
     "", "", "", &S::step_up},
    {"step_form", "Step form", "Hacks", "", 0.0, 1.0,
     "When a step is tried. When blocked: a move that hits a wall is tried again from higher up, and the "
     "better of both counts. Every move: the lecture's form (MDK2), each move on the ground is lifted before "
     "and dropped after, so the player needs room for a step above its head wherever it walks.",
     "", "", "step_up", choice<&S::step_form>(step_form_names)},
    {"step_height", "Step height", "Hacks", "m", 0.0, 2.0, "The highest step that is climbed.",
     "Stops at kerbs and door sills.", "Walks up onto tables and over railings.", "step_up", &S::step_height},
    {"snap_down", "Snap to floor", "Hacks", "", 0.0, 1.0,
     "Puts a player who walked off a step or over a crest back onto the ground below. Off: flies off every "
     "stair "
     "on the way down and cannot jump there.",
     "", "", "", &S::snap_down},
    {"snap_distance", "Snap distance", "Hacks", "m", 0.0, 2.0,
     "How far below the feet the floor is looked for.",
     "Leaves the ground at steps that are higher than this.",
     "Ledges pull the player down instead of letting go.", "snap_down", &S::snap_distance},
    {"seam_filter", "Seam filter", "Hacks", "", 0.0, 1.0,
     "A touch of an edge inside a flat or hollow surface counts as a touch of the face. Off: who stands a "
     "hair "
     "inside a floor is stopped by its triangle edges, which nobody sees.",
     "", "", "", &S::seam_filter},
    {"heightfield", "Heightfield", "Hacks", "", 0.0, 1.0,
     "Keeps the feet at or above the level's terrain: y = max(y, terrain(x, z)). Off: terrain without "
     "triangles "
     "is fallen through.",
     "", "", "", &S::heightfield},
    {"platforms", "Moving platforms", "Hacks", "", 0.0, 1.0,
     "Platforms carry who stands on them, push who is in their way, and give their velocity to who leaves. "
     "Off: "
     "they slide away under the feet and run into the player.",
     "", "", "", &S::platforms},
    {"sectors", "Sectors", "Hacks", "", 0.0, 1.0,
     "Calculates in the coordinates of the sector that the player is in. Off: far from the origin positions "
     "are "
     "coarse, and the player jitters and sticks. Acts in levels that have sectors.",
     "", "", "", &S::sectors},

    {"coyote", "Coyote time", "Jump", "", 0.0, 1.0,
     "A jump pressed just after running off a ledge still counts. Off: a press one tick late falls.", "", "",
     "", &S::coyote},
    {"coyote_time", "Coyote window", "Jump", "s", 0.0, 0.5,
     "How long after leaving the ground a jump still starts.", "Players swear that they pressed in time.",
     "Jumps start in mid-air, visibly off the ledge.", "coyote", &S::coyote_time},
    {"jump_buffer", "Jump buffer", "Jump", "", 0.0, 1.0,
     "A jump pressed just before landing starts on landing. Off: a press one tick early is lost.", "", "", "",
     &S::jump_buffer},
    {"jump_buffer_time", "Jump buffer window", "Jump", "s", 0.0, 0.5,
     "How long a press of jump is remembered.", "Quick successive jumps fail at random.",
     "A press long forgotten makes the player jump.", "jump_buffer", &S::jump_buffer_time},
    {"variable_jump", "Variable jump height", "Jump", "", 0.0, 1.0,
     "Letting the button go while rising cuts the jump short. Off: every jump is as high as the highest.", "",
     "", "", &S::variable_jump},
    {"jump_cut", "Jump cut", "Jump", "", 0.0, 1.0,
     "Share of the upward speed that is kept when the button is let go; the height left is its square.",
     "A short press stops the jump dead in the air.", "Short and long presses jump alike.", "variable_jump",
     &S::jump_cut},
    {"air_control", "Air control", "Jump", "", 0.0, 1.0,
     "The stick steers in the air, as fast as the air acceleration allows. Off: a jump goes where it was "
     "headed.",
     "", "", "", &S::air_control},
});

}  // namespace

std::span<const SettingInfo> settings_table() {
    return table;
}

}  // namespace slipface
