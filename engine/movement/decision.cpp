#include "slipface/movement/decision.h"

#include <array>
#include <cstddef>

namespace slipface {

namespace {

// In the order of the enum. A sentence names what was decided first, then the numbers that decided.
constexpr auto make_decisions() {
    using enum Decision;
    using enum Outcome;
    using enum DecisionUnit;
    return std::to_array<DecisionInfo>({
        // Push-out, nudge and the last word
        {push_out_off, "push_out", switched_off, no_unit, "Began inside geometry: Push-out is off"},
        {push_out_needless, "push_out", refused, no_unit, "Not inside geometry: no push-out needed"},
        {nudge_off, "nudge", switched_off, no_unit, "Inside geometry: Nudge is off"},
        {nudge_needless, "nudge", refused, no_unit, "Not inside geometry: no nudge needed"},
        {nudged, "nudge", acted, metres, "Nudged free by {value} (at most {limit})"},
        {nudge_failed, "nudge", refused, metres, "Trapped: no free position within {value}"},
        {never_inside, "never_inside", acted, metres,
         "Moved back by {value}: the step would have ended inside geometry"},
        {pushed_off, "skin", acted, metres, "Pushed away by {value} to restore the skin of {limit}"},
        {pushed_off_halfway, "skin", acted, metres,
         "Pushed away by {value}, half of the distance to the next face (skin {limit})"},
        {slides_used_up, "max_slides", acted, metres, "Dropped the last {value} of the move: no slides left"},
        // Platforms, conveyors and sectors
        {platform_carried, "platforms", acted, metres, "Carried {value} by the platform"},
        {platform_pushed, "platforms", acted, metres, "Pushed {value} by a platform"},
        {platform_off, "platforms", switched_off, no_unit,
         "Not carried by the platform: Moving platforms is off"},
        {platform_crushed, "platforms", refused, no_unit, "Crushed by a platform: no room to move away"},
        {platform_velocity_kept, "platforms", acted, speed, "Left the platform with its velocity of {value}"},
        {surface_carried, "surface_types", acted, metres, "Carried {value} by the surface"},
        {surface_velocity_kept, "surface_types", acted, speed,
         "Left the surface with its velocity of {value}"},
        {surface_types_off, "surface_types", switched_off, no_unit,
         "Counted as plain ground: Surface types is off"},
        {hazard_touched, "surface_types", acted, no_unit, "Touched a hazard"},
        {sector_kept, "sectors", acted, metres,
         "Stayed in its sector, {value} from its centre (border at {limit})"},
        {sector_entered, "sectors", acted, metres,
         "Entered another sector, {value} from its centre (border at {limit})"},
        // Standing, slopes and walls
        {stood, "static_friction", acted, slope, "Flat enough to stand on: {value} (limit {limit})"},
        {too_steep_to_stand, "static_friction", refused, slope,
         "Too steep to stand on: {value} (limit {limit})"},
        {no_hold_on_ice, "static_friction", refused, no_unit, "No static friction: the surface keeps energy"},
        {wedged, "static_friction", acted, metres,
         "Wedged between steep faces: fell only {value}, which counts as standing"},
        {whole_move_on_ice, "static_friction", refused, no_unit,
         "The whole move slides: the surface keeps energy"},
        {static_friction_off, "static_friction", switched_off, no_unit,
         "The whole move slides: Static friction is off"},
        {wall, "max_slope", acted, slope, "Too steep to walk up: {value} (limit {limit})"},
        {straight_ahead, "straight_ahead", acted, slope,
         "Continued straight ahead up the ramp of {value} (limit {limit})"},
        {straight_ahead_off, "straight_ahead", switched_off, slope,
         "Deflected sideways by the ramp of {value}: Straight ahead on ramps is off"},
        {pressed_down, "ground_velocity", acted, speed, "Pressed down at {value} (at least {limit})"},
        {pressed_down_off, "ground_velocity", switched_off, no_unit,
         "Not pressed down: Ground velocity is off"},
        {coasted, "ground_acceleration", acted, speed,
         "Coasted: slowed from {value} to {limit} by the height gained"},
        {friction_held, "surface_types", acted, speed,
         "Held on the slope: it pulls by {value} in this tick, the surface's friction holds {limit}"},
        {friction_slid, "surface_types", acted, speed,
         "Slid down the slope: it pulls by {value} in this tick, the surface's friction holds {limit}"},
        {slope_speed_kept, "constant_slope_speed", acted, metres,
         "Moved {value} along the slope, as far as on flat ground"},
        {slope_speed_off, "constant_slope_speed", switched_off, metres,
         "Moved {value} along the slope instead of {limit}: Constant speed on slopes is off"},
        // Steps and edges
        {step_up_off, "step_up", switched_off, no_unit, "Did not step up: Step up is off"},
        {step_up_in_air, "step_up", refused, no_unit, "Did not step up: the player was in the air"},
        {step_up_no_room, "step_up", refused, metres, "Did not step up: only {value} free overhead"},
        {step_up_held, "step_up", refused, no_unit, "Did not step up: the upper surface holds the player"},
        {step_up_no_further, "step_up", refused, metres,
         "Did not step up: it would advance {value} (needs {limit})"},
        {step_up_no_ground, "step_up", refused, metres, "Did not step up: no ground within {value} below"},
        {step_up_too_high, "step_up", refused, metres,
         "Did not step up: {value} is too high (limit {limit})"},
        {step_up_own_response, "step_up", refused, no_unit,
         "Did not step up: the upper surface is sticky or bouncy"},
        {step_up_too_steep, "step_up", refused, slope,
         "Did not step up: the upper surface is too steep, {value} (limit {limit})"},
        {stepped_up, "step_up", acted, metres, "Stepped up {value} (at most {limit})"},
        {step_every_move, "step_up", acted, metres, "Lifted, moved and dropped: {value} higher than before"},
        {step_rim, "step_up", acted, metres,
         "On the rim of a step, {value} above the ground (at most {limit})"},
        {step_rim_no_ground, "step_up", refused, metres,
         "Not the rim of a step: no ground within {value} below"},
        {step_rim_no_steps, "step_up", refused, metres,
         "Not the rim of a step: no steps climb {value} to it"},
        {step_rim_too_high, "step_up", refused, metres,
         "Not the rim of a step: {value} above the ground (limit {limit})"},
        {step_rim_blocked, "step_up", refused, no_unit, "Not the rim of a step: no ground behind it"},
        {snap_rim, "snap_down", acted, metres,
         "On the rim of a step, {value} above the ground (at most {limit})"},
        {snap_rim_no_ground, "snap_down", refused, metres,
         "Not the rim of a step: no ground within {value} below"},
        {snap_rim_no_steps, "snap_down", refused, metres,
         "Not the rim of a step: no steps climb {value} to it"},
        {snap_rim_too_high, "snap_down", refused, metres,
         "Not the rim of a step: {value} above the ground (limit {limit})"},
        {snap_rim_blocked, "snap_down", refused, no_unit, "Not the rim of a step: no ground behind it"},
        {snap_off, "snap_down", switched_off, no_unit, "Left the ground: Snap to floor is off"},
        {snap_no_floor, "snap_down", refused, metres, "Left the ground: no floor within {value} below"},
        {snap_too_deep, "snap_down", refused, metres,
         "Left the ground: the floor is {value} below (limit {limit})"},
        {snap_own_response, "snap_down", refused, no_unit,
         "Left the ground: the floor below is sticky, bouncy or keeps energy"},
        {snap_too_steep, "snap_down", refused, slope,
         "Left the ground: too steep below, {value} (limit {limit})"},
        {snapped, "snap_down", acted, metres, "Snapped {value} down to the floor (at most {limit})"},
        {seam_off, "seam_filter", switched_off, no_unit, "The edge counts as an edge: Seam filter is off"},
        {seam_stands_out, "seam_filter", refused, no_unit,
         "The edge is real: no neighbouring face rises above it"},
        {seam_filtered, "seam_filter", acted, lift,
         "Ignored an edge inside a surface: used its face, which rises {value} above the contact"},
        // Surfaces with a response of their own
        {bounced, "bounce", acted, speed, "Bounced off at {value}"},
        {bounce_scraped, "bounce", acted, speed, "Lost {value} along the surface by its friction"},
        {bounce_off, "bounce", switched_off, no_unit, "Did not bounce: Bounce is off"},
        {bounce_walked, "bounce", refused, no_unit, "Did not bounce: the player walked onto it"},
        {bounce_too_slow, "bounce", refused, speed, "Did not bounce: {value} is too slow (limit {limit})"},
        {energy_kept, "keep_energy", acted, lift, "Kept the speed: hit at {value} (limit {limit})"},
        {energy_head_on, "keep_energy", refused, lift, "Lost speed: hit head-on at {value} (limit {limit})"},
        {energy_off, "keep_energy", switched_off, lift, "Lost speed: hit at {value}, and Keep energy is off"},
        {energy_capped, "keep_energy", acted, speed,
         "Slowed from {value} to {limit}, the maximum for this height"},
        {energy_within, "keep_energy", refused, speed,
         "Not slowed: {value} is below the maximum for this height, {limit}"},
        {stuck, "stick", acted, no_unit, "Stuck to it, until a jump"},
        {still_stuck, "stick", acted, no_unit, "Held by the sticky surface, until a jump"},
        {stick_off, "stick", switched_off, no_unit, "Did not stick: Stick is off"},
        {ladder_grabbed, "surface_types", acted, no_unit, "Grabbed the ladder"},
        {ladder_overhead, "surface_types", refused, slope,
         "Not climbed: {value} is too far overhead (limit {limit})"},
        {ladder_passed, "surface_types", refused, angle,
         "Did not grab the ladder: the stick points {value} away from it (limit {limit})"},
        {ladder_climbed, "surface_types", acted, speed, "Moved on the ladder at {value} (at most {limit})"},
        {ladder_ended, "surface_types", refused, no_unit, "Left the ladder: its face ended"},
        {ladder_top, "surface_types", refused, no_unit, "Left the ladder at its top"},
        {ladder_beside, "surface_types", refused, no_unit, "Left the ladder at its side"},
        {ladder_ground, "surface_types", refused, no_unit, "Left the ladder onto the ground"},
        {ladder_wall_above, "surface_types", refused, no_unit,
         "Stopped at the end of the ladder: the wall above cannot be climbed"},
        // Jumping, and in the air
        {jumped, "jump_speed", acted, speed, "Jumped at {value}"},
        {jumped_off, "jump_speed", acted, speed, "Jumped off along the normal at {value}"},
        {coyote_jump, "coyote", acted, seconds, "Coyote jump: {value} before the end of the window"},
        {coyote_over, "coyote", refused, no_unit, "No jump: no ground or ladder to jump from"},
        {coyote_off, "coyote", switched_off, no_unit, "No jump: in the air, and Coyote time is off"},
        {jump_buffered, "jump_buffer", acted, seconds,
         "Jumped from a buffered press, {value} before it expired"},
        {jump_remembered, "jump_buffer", refused, seconds,
         "In the air: the jump press is buffered for another {value}"},
        {jump_buffer_off, "jump_buffer", switched_off, no_unit,
         "Jump press in the air ignored: Jump buffer is off"},
        {jump_cut, "variable_jump", acted, speed,
         "Cut the jump short: button released while rising at {value}"},
        {jump_cut_off, "variable_jump", switched_off, speed,
         "Jump not cut at {value}: Variable jump height is off"},
        {steered_in_air, "air_control", acted, percent, "Steered in the air with the stick at {value}"},
        {air_control_off, "air_control", switched_off, percent,
         "Stick at {value} ignored in the air: Air control is off"},
        {fell_at_terminal_speed, "terminal_speed", acted, speed,
         "Fall slowed from {value} to {limit}, the terminal speed"},
        // Terrain
        {terrain_off, "heightfield", switched_off, metres,
         "The feet are {value} below the terrain: Heightfield is off"},
        {terrain_stood, "heightfield", acted, metres, "Lifted {value} and stood on the terrain"},
        {terrain_slid, "heightfield", acted, metres, "Lifted {value} and slid on steep terrain"},
        {terrain_above, "heightfield", refused, metres, "Above the terrain by {value}"},
        {terrain_wall, "heightfield", acted, slope, "Stopped by steep terrain: {value} (limit {limit})"},
        {terrain_no_room, "heightfield", refused, metres, "Not lifted {value} onto the terrain: no room"},
    });
}
constexpr auto decisions = make_decisions();

constexpr bool in_order() {
    for (std::size_t i = 0; i < decisions.size(); ++i)
        if (static_cast<std::size_t>(decisions[i].kind) != i) return false;
    return true;
}
static_assert(in_order());

}  // namespace

std::span<const DecisionInfo> decision_table() {
    return decisions;
}

const DecisionInfo& decision_info(Decision kind) {
    return decisions[static_cast<std::size_t>(kind)];
}

}  // namespace slipface
