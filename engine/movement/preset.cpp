#include "slipface/movement/preset.h"

namespace slipface {

namespace {

MovementSettings everything() {
    MovementSettings s;
    s.nudge = true;
    s.step_height = s.snap_distance = 0.35;
    return s;
}

// The demo of the lecture: its hacks and no others.
MovementSettings lecture() {
    MovementSettings s = basic_settings();
    s.push_out = PushOut::analytic;
    return s;
}

MovementSettings precise_platformer() {
    MovementSettings s = everything();
    s.walk_speed = 7.0;
    s.ground_acceleration = 140.0;
    s.air_acceleration = 90.0;
    s.gravity = 32.0;
    s.jump_speed = 11.5;
    s.variable_jump = true;
    s.sub_step = 1.0 / 120.0;
    return s;
}

MovementSettings momentum() {
    MovementSettings s = everything();
    s.walk_speed = 9.0;
    s.ground_acceleration = 14.0;
    s.air_acceleration = 8.0;
    s.slippery_acceleration = 5.0;
    s.terminal_speed = 90.0;
    s.jump_speed = 9.0;
    s.keep_energy_limit = -0.7;
    s.snap_down = false;
    return s;
}

// Every hack off: what remains is sweep and slide.
MovementSettings simulation() {
    MovementSettings s = basic_settings();
    set_switches(s, false);
    s.gravity = 9.81;
    return s;
}

}  // namespace

const std::vector<ShippedPreset>& shipped_presets() {
    static const std::vector<ShippedPreset> presets{
        {"platformer",
         {"Platformer", "What players of 3D platformers expect; the default of a level without a level file.",
          MovementSettings{}}},
        {"lecture", {"Lecture", "The hacks of the lecture, as its demo has them.", lecture()}},
        {"precise-platformer",
         {"Precise platformer", "Starts and stops at once, forgives late jumps, climbs stairs.",
          precise_platformer()}},
        {"momentum",
         {"Momentum", "Slopes give speed and ice preserves it; the stick steers little.", momentum()}},
        {"simulation",
         {"Simulation",
          "Every switch off: only sweeps and slides. The player falls through terrain without triangles.",
          simulation()}}};
    return presets;
}

PresetMatch nearest_preset(const MovementSettings& settings) {
    PresetMatch nearest;
    for (const ShippedPreset& shipped : shipped_presets()) {
        PresetMatch match{&shipped, {}};
        for (const SettingInfo& info : settings_table())
            if (get_setting(settings, info) != get_setting(shipped.preset.settings, info))
                match.changed.push_back(&info);
        if (nearest.preset == nullptr || match.changed.size() < nearest.changed.size())
            nearest = std::move(match);
    }
    return nearest;
}

}  // namespace slipface
