// Everything about a player's movement that a designer can change.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "slipface/base/result.h"
#include "slipface/base/types.h"

namespace slipface {

// A value of a setting that is an enum.
struct Choice {
    const char* name;     // "every_move", as in --set, files and scripts
    const char* meaning;  // what it does, after "Every move: "
};

enum class PushOut : int { off, iterative, analytic };
inline constexpr auto push_out_choices = std::to_array<Choice>({
    {"off", "the player can only move out"},
    {"iterative", "out of the deepest triangle first, several times"},
    {"analytic", "to the common point of up to three planes at once, which acute corners need"},
});

enum class StepForm : int { when_blocked, every_move };
inline constexpr auto step_form_choices = std::to_array<Choice>({
    {"when_blocked", "a move that hits a wall is repeated from higher up, and the better result is used"},
    {"every_move",
     "the lecture's form (MDK2), each move on the ground is lifted before and dropped after, so the player "
     "needs room for a step above its head wherever it walks"},
});

enum class LeaveMode : int { none, upward, horizontal, not_downward, all };
inline constexpr auto leave_mode_choices = std::to_array<Choice>({
    {"none", "nothing, the player leaves as if the ground stood still"},
    {"upward", "only an upward part, as from a catapult"},
    {"horizontal", "only its horizontal part, so that lifts change no jump's height"},
    {"not_downward", "all but a downward part, so that ground that sinks takes nothing from a jump's height"},
    {"all", "all of it, so that a jump is the same as on still ground, seen from the ground that was left"},
});

enum class AirJumpReset : int { ground, holds, walls };
inline constexpr auto air_jump_reset_choices = std::to_array<Choice>({
    {"ground", "only ground and a bounce give the air jumps back"},
    {"holds", "ladders and sticky surfaces do, too"},
    {"walls", "sliding down a wall and a jump off one do, too"},
});

enum class WallSlideForm : int { touching, pushing };
inline constexpr auto wall_slide_form_choices = std::to_array<Choice>({
    {"touching", "whatever the stick does, a wall that the player falls along slows it"},
    {"pushing", "only while the stick points into the wall, within 60 degrees"},
});

enum class WallJumpWalls : int { another, any };
inline constexpr auto wall_jump_walls_choices = std::to_array<Choice>({
    {"another",
     "not off a wall that faces as the one before, until something holds the player, so that one wall "
     "alone cannot be climbed"},
    {"any", "off the same wall again, too"},
});

enum class DashToward : int { stick, motion };
inline constexpr auto dash_toward_choices = std::to_array<Choice>({
    {"stick", "the stick, and with it at rest where the player moves"},
    {"motion", "where the player moves, and from rest the stick"},
});

enum class CrouchInAir : int { no, feet_up };
inline constexpr auto crouch_in_air_choices = std::to_array<Choice>({
    {"no", "the player keeps the body that it has"},
    {"feet_up",
     "the head stays and the feet are drawn up, so that a crouched jump clears edges that are higher by what "
     "the body lost"},
});

enum class LedgeForm : int { pushing, button };
inline constexpr auto ledge_form_choices = std::to_array<Choice>({
    {"pushing", "the stick points at the ledge, within 60 degrees"},
    {"button", "the grab button is held; to let it go is to let go"},
});

enum class LedgeClimb : int { stick, jump };
inline constexpr auto ledge_climb_choices = std::to_array<Choice>({
    {"stick", "the stick points at the ledge; a press of jump jumps up from it"},
    {"jump", "a press of jump, unless the stick points away"},
});

// The defaults are what players of 3D platformers expect: the preset "platformer".
struct MovementSettings {
    Vec3 radii{0.4, 0.9, 0.4};  // m, of the ellipsoid along X, Y and Z

    double gravity = 20.0;               // m/s2, downwards
    double walk_speed = 6.0;             // m/s
    double ground_acceleration = 60.0;   // m/s2
    double slippery_acceleration = 3.0;  // m/s2, on surfaces that keep energy
    double air_acceleration = 20.0;      // m/s2
    double terminal_speed = 50.0;        // m/s, of a fall
    double jump_speed = 8.0;             // m/s, upwards

    double skin = 0.002;                    // m, the distance that is kept from what was touched
    int max_slides = 3;                     // sweeps per move
    double max_slope = 0.8726646259971648;  // radians (50 degrees): the steepest ground to stand on

    bool static_friction = true;
    bool ground_velocity = true;
    double ground_speed = 1.0;  // m/s, the small downward speed while grounded
    bool straight_ahead = true;
    bool constant_slope_speed = false;  // walk_speed counts along the slope, not horizontally
    bool keep_energy = true;
    double keep_energy_limit = -0.5;  // a cosine: N.V / |V| must be above it
    bool surface_types = true;        // ladders, sticky, bouncy, conveyors act at all
    bool bounce = true;
    bool stick = true;
    PushOut push_out = PushOut::analytic;
    bool nudge = false;
    double nudge_distance = 0.1;  // m
    bool step_up = true;
    StepForm step_form = StepForm::when_blocked;
    double step_height = 0.4;  // m
    bool snap_down = true;
    double snap_distance = 0.4;  // m
    bool seam_filter = true;
    bool heightfield = true;
    bool platforms = true;
    LeaveMode leave_mode = LeaveMode::all;
    bool sectors = true;
    bool coyote = true;
    double coyote_time = 0.1;  // s
    bool jump_buffer = true;
    double jump_buffer_time = 0.1;  // s
    bool variable_jump = false;
    double jump_cut = 0.4;  // fraction of the upward speed that remains when the button is released
    bool air_control = true;
    bool keep_speed = true;
    bool air_jump = false;
    int air_jumps = 1;            // until something gives them back
    double air_jump_speed = 8.0;  // m/s, upwards
    AirJumpReset air_jump_reset = AirJumpReset::walls;
    bool wall_slide = false;
    double wall_slide_speed = 2.0;  // m/s, of the fall
    WallSlideForm wall_slide_form = WallSlideForm::pushing;
    bool wall_jump = false;
    double wall_jump_away = 6.0;   // m/s, along the wall's horizontal normal
    double wall_jump_up = 8.0;     // m/s
    double wall_jump_reach = 0.1;  // m, from the body to the wall
    double wall_jump_lock = 0.15;  // s, for which the stick does not steer
    WallJumpWalls wall_jump_walls = WallJumpWalls::any;
    bool dash = false;
    double dash_speed = 14.0;     // m/s, horizontal
    double dash_time = 0.2;       // s
    double dash_end_speed = 6.0;  // m/s, that remain after it
    int dashes = 1;               // in the air, until something gives them back
    DashToward dash_toward = DashToward::stick;
    bool crouch = false;
    double crouch_radius_y = 0.5;  // m
    double crouch_speed = 2.5;     // m/s
    CrouchInAir crouch_in_air = CrouchInAir::feet_up;
    bool ledge_grab = false;
    double ledge_hands = 0.7;                // m, above the centre
    double ledge_reach = 0.2;                // m, from the body to the wall
    double ledge_time = 0.5;                 // s, of the climb onto it
    double ledge_wall = 1.0471975511965976;  // radians (60 degrees): the least steep wall below a ledge
    LedgeForm ledge_form = LedgeForm::pushing;
    LedgeClimb ledge_climb = LedgeClimb::stick;
    bool drop_through = false;
    bool glide = false;
    double glide_speed = 2.0;  // m/s, of the fall
    double sub_step = 0.0;     // s, the longest part of a step that is moved at once; 0: the whole step

    friend bool operator==(const MovementSettings&, const MovementSettings&) = default;
};

// The values of settings that a file, tape or preset does not name: the hacks of the lecture without
// push-out. They stay as they are when the defaults above change. Demos and tests that show one hack alone
// begin with these settings.
MovementSettings basic_settings();

// A member that is an enum whose values are 0, 1, ... in the order of `choices`.
struct ChoiceMember {
    std::span<const Choice> choices;
    int (*get)(const MovementSettings&);
    void (*set)(MovementSettings&, int);
};
template <auto Member>
constexpr ChoiceMember choice(std::span<const Choice> choices) {
    using Enum = std::remove_cvref_t<decltype(std::declval<MovementSettings>().*Member)>;
    return {choices, [](const MovementSettings& s) { return static_cast<int>(s.*Member); },
            [](MovementSettings& s, int value) { s.*Member = static_cast<Enum>(value); }};
}

// One row per setting, from setting_rows.inc.
struct SettingInfo {
    const char* name;         // "max_slope", as in --set, files and scripts
    const char* label;        // "Maximum slope"
    const char* group;        // heading in the editor: "Body", "Speed", "Collision", "Hacks"
    const char* unit;         // as shown: "m/s", "deg", ""; angles are stored in radians and shown in degrees
    double minimum, maximum;  // as stored
    const char* meaning;      // without those of the choices: see meaning_of()
    const char* too_small;    // what goes wrong; empty for switches
    const char* too_large;
    const char* switch_name;  // the switch that this parameter belongs to, or empty
    std::variant<bool MovementSettings::*, int MovementSettings::*, double MovementSettings::*, ChoiceMember,
                 Vec3 MovementSettings::*>
        member;
    // In basic_settings(), where that is not the default. A setting that is added later has here the value
    // that changes nothing for old files.
    std::optional<double> basic{};
    int axis = -1;          // for a Vec3 member: which component this row is
    double smallest = 0.0;  // values between 0 and this are refused, while 0 itself switches it off; 0: none
};

std::span<const SettingInfo> settings_table();
const SettingInfo* find_setting(std::string_view name);
inline bool is_switch(const SettingInfo& info) {
    return std::holds_alternative<bool MovementSettings::*>(info.member);
}
inline bool is_choice(const SettingInfo& info) {
    return std::holds_alternative<ChoiceMember>(info.member);
}
// Empty for a setting that is no choice.
std::span<const Choice> choices_of(const SettingInfo& info);
// With the meaning of each choice.
std::string meaning_of(const SettingInfo& info);

// How a hack computes, from setting_rows.inc. slipface/sim/formula.h has its numbers in a tick.
struct FormulaInfo {
    const char* hack;     // the setting's name
    const char* lecture;  // the lecture's name for it, or empty
    const char* text;
};
std::span<const FormulaInfo> formula_table();
// Null for a setting without one.
const FormulaInfo* find_formula(std::string_view hack);

// Every switch on, or every switch off.
void set_switches(MovementSettings& settings, bool on);

// Whether all numbers are finite.
bool is_finite(const MovementSettings& settings);

// A setting as a number: switches 0 or 1, choices their index.
double get_setting(const MovementSettings& settings, const SettingInfo& info);
// Refuses values that are not finite or out of range; then `settings` is unchanged.
Status set_setting(MovementSettings& settings, const SettingInfo& info, double value);
// "name=value" with value a number, true/false/on/off, a choice's name, or, for an angle, degrees as in
// "50deg". Errors name the setting, what was found and what is allowed, and suggest the nearest name.
Status set_setting(MovementSettings& settings, std::string_view assignment);
// The value as set_setting reads it back without loss.
std::string setting_text(const MovementSettings& settings, const SettingInfo& info);

}  // namespace slipface
