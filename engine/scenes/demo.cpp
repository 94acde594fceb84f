#include "slipface/scenes/demo.h"

#include "demos.h"

namespace slipface {

// To add a demo, write one function in a file of demos and add one row here.
std::span<const DemoInfo> demo_table() {
    static const std::array<DemoInfo, 20> table{{
        {"static-friction", "static_friction", "Static friction",
         "Off: a player on the 30 degree ramp creeps down. On: the player stands still.",
         demo_static_friction},
        {"ground-velocity", "ground_velocity", "Ground velocity",
         "Off: the player hops down the ramp. On: the path follows the ramp.", demo_ground_velocity},
        {"straight-ahead", "straight_ahead", "Straight ahead on ramps",
         "Off: the ramp deflects the path from the stripe. On: the path continues along it.",
         demo_straight_ahead},
        {"keep-energy", "keep_energy", "Keep energy",
         "Off: the player loses speed at every face of the half-pipe and does not reach the far rim. On: the "
         "player reaches it.",
         demo_keep_energy},
        {"push-out", "push_out", "Push-out",
         "Off: a player who starts inside both walls of the wedge and pushes across it stays there. On: the "
         "player is pushed out at once and walks on.",
         demo_push_out},
        {"nudge", "nudge", "Nudge",
         "Off: a player who spawns between posts that are too close cannot leave. On: the player is moved "
         "beside them and walks on.",
         demo_nudge},
        {"step-up", "step_up", "Step up", "Off: the stairs act as a wall. On: the player climbs them.",
         demo_step_up},
        {"heightfield", "heightfield", "Heightfield",
         "Off: the player falls through the terrain. On: the player walks on it.", demo_heightfield},
        {"sectors", "sectors", "Sectors",
         "A million metres from the origin. Off: coordinates are 6 cm apart, and rounding has moved the "
         "posts of the gate too close. On: the player walks through as at the origin.",
         demo_sectors},
        {"bounce", "bounce", "Bounce",
         "Off: the pad acts as a floor. On: each rebound has 0.8 times the impact speed.", demo_bounce},
        {"sticky", "stick", "Sticky",
         "Off: the player slides down the wall. On: the player hangs on it, with or without the stick.",
         demo_sticky},
        {"snap-down", "snap_down", "Snap to floor",
         "Off: the player leaves the ground at every step downwards. On: the path follows the stairs.",
         demo_snap_down},
        {"seam-filter", "seam_filter", "Seam filter",
         "A floor rises into the player. Off: the edges of its triangles stop the player. On: the player "
         "walks on.",
         demo_seam_filter},
        {"coyote", "coyote", "Coyote time",
         "Jump is pressed 3 ticks after the ledge. Off: the player falls into the gap. On: the player "
         "reaches the other side.",
         demo_coyote},
        {"jump-buffer", "jump_buffer", "Jump buffer",
         "Jump is pressed 4 ticks before landing. Off: the press is ignored. On: the jump starts on landing.",
         demo_jump_buffer},
        {"variable-jump", "variable_jump", "Variable jump height",
         "The button is held for 6 ticks only. Off: the jump has its full height. On: a short hop under the "
         "beam.",
         demo_variable_jump},
        {"air-control", "air_control", "Air control",
         "The stick changes direction in mid-air. Off: the player flies past the pillar's top. On: the "
         "player lands on it.",
         demo_air_control},
        {"moving-platforms", "platforms", "Moving platforms",
         "Off: the raft slides away under the feet. On: it carries the player across the gap.",
         demo_platforms},
        {"turntable", "platforms", "Turntable",
         "Off: the turntable rotates under the feet. On: the player rotates with it.", demo_turntable},
        {"surface-types", "surface_types", "Surface types",
         "Off: the ladder acts as a wall. On: the player climbs it, and the conveyor above carries the "
         "player on.",
         demo_surface_types},
    }};
    return table;
}

const DemoInfo* find_demo(std::string_view name) {
    for (const DemoInfo& info : demo_table()) {
        if (name == info.name) return &info;
    }
    return nullptr;
}

Demo make_demo(const DemoInfo& info) {
    Demo demo = info.build();
    const std::string name = info.name;
    demo.level.mesh_path = name + ".obj";
    demo.level.file_path = name + ".slipface.json";
    demo.off = demo.on;
    const SettingInfo& row = *find_setting(info.hack);
    // Off is always in the range of a switch, so this cannot fail.
    static_cast<void>(set_setting(demo.off, row, 0.0).ok());
    demo.level.movement = demo.on;
    demo.camera.name = info.title;
    demo.level.cameras = {demo.camera};
    demo.tape.level_name = name + ".obj";
    demo.tape.level_fingerprint = demo.level.mesh->fingerprint;
    return demo;
}

}  // namespace slipface
