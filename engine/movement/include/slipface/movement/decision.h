// What a hack or rule can decide, one sentence each. The one table from which the story of a tick is written.
#pragma once

#include <cstdint>
#include <span>

namespace slipface {

enum class Decision : std::uint8_t {
    // Push-out, nudge and the last word
    push_out_off,
    push_out_needless,
    nudge_off,
    nudge_needless,
    nudged,
    nudge_failed,
    never_inside,
    pushed_off,
    pushed_off_halfway,
    slides_used_up,
    // Platforms, conveyors and sectors
    platform_carried,
    platform_pushed,
    platform_off,
    platform_crushed,
    platform_velocity_kept,
    surface_carried,
    surface_velocity_kept,
    surface_types_off,
    hazard_touched,
    sector_kept,
    sector_entered,
    // Standing, slopes and walls
    stood,
    too_steep_to_stand,
    no_hold_on_ice,
    wedged,
    whole_move_on_ice,
    static_friction_off,
    wall,
    straight_ahead,
    straight_ahead_off,
    pressed_down,
    pressed_down_off,
    coasted,
    friction_held,
    friction_slid,
    slope_speed_kept,
    slope_speed_off,
    // Steps and edges
    step_up_off,
    step_up_in_air,
    step_up_no_room,
    step_up_held,
    step_up_no_further,
    step_up_no_ground,
    step_up_too_high,
    step_up_own_response,
    step_up_too_steep,
    stepped_up,
    step_every_move,
    step_rim,
    step_rim_no_ground,
    step_rim_no_steps,
    step_rim_too_high,
    step_rim_blocked,
    snap_rim,
    snap_rim_no_ground,
    snap_rim_no_steps,
    snap_rim_too_high,
    snap_rim_blocked,
    snap_off,
    snap_no_floor,
    snap_too_deep,
    snap_own_response,
    snap_too_steep,
    snapped,
    seam_off,
    seam_stands_out,
    seam_filtered,
    // Surfaces with a response of their own
    bounced,
    bounce_scraped,
    bounce_off,
    bounce_walked,
    bounce_too_slow,
    energy_kept,
    energy_head_on,
    energy_off,
    energy_capped,
    energy_within,
    stuck,
    still_stuck,
    stick_off,
    ladder_grabbed,
    ladder_overhead,
    ladder_passed,
    ladder_climbed,
    ladder_ended,
    ladder_top,
    ladder_beside,
    ladder_ground,
    ladder_wall_above,
    // Jumping, and in the air
    jumped,
    jumped_off,
    coyote_jump,
    coyote_over,
    coyote_off,
    jump_buffered,
    jump_remembered,
    jump_buffer_off,
    jump_cut,
    jump_cut_off,
    steered_in_air,
    air_control_off,
    fell_at_terminal_speed,
    // Terrain
    terrain_off,
    terrain_stood,
    terrain_slid,
    terrain_above,
    terrain_wall,
    terrain_no_room,
};

enum class Outcome : std::uint8_t { acted, refused, switched_off };

// What a decision's numbers are. Movement has no inverse cosine; its angles come as cosines and sines.
enum class DecisionUnit : std::uint8_t {
    no_unit,
    metres,
    speed,  // m/s
    seconds,
    percent,  // as a fraction, 0..1
    slope,    // N.y, the cosine of a slope; shown in degrees from the horizontal, 90 is a wall, more an
              // overhang
    angle,    // the cosine of an angle
    lift,     // the sine of an angle between a direction and a plane
};

struct DecisionInfo {
    Decision kind;
    const char* hack;  // the setting's name in settings_table(), or "never_inside"
    Outcome outcome;
    DecisionUnit unit;
    const char* sentence;  // with {value} and {limit} where the numbers stand; without full stop
};

std::span<const DecisionInfo> decision_table();
const DecisionInfo& decision_info(Decision kind);

}  // namespace slipface
