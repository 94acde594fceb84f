#include "slipface/scenes/demo.h"

#include "demos.h"

namespace slipface {

// To add a demo, write one function in a file of demos and add one row here.
std::span<const DemoInfo> demo_table() {
    static const std::array<DemoInfo, 20> table{{
        {"static-friction", "static_friction", "Static friction",
         "Off: who stands on the 30 degree ramp creeps down it. On: stands still.", demo_static_friction},
        {"ground-velocity", "ground_velocity", "Ground velocity",
         "Off: running down the ramp is a row of hops. On: the path follows the ramp.", demo_ground_velocity},
        {"straight-ahead", "straight_ahead", "Straight ahead on ramps",
         "Off: the ramp turns the path off the stripe. On: it goes on along it.", demo_straight_ahead},
        {"keep-energy", "keep_energy", "Keep energy",
         "Off: the half-pipe takes speed at every face, and the far rim is not reached. On: it is.",
         demo_keep_energy},
        {"push-out", "push_out", "Push-out",
         "Off: who begins inside both walls of the wedge and pushes across it stays there. On: is put before "
         "them at once and walks past.",
         demo_push_out},
        {"nudge", "nudge", "Nudge",
         "Off: who spawned between posts that stand too close cannot leave. On: is put beside them and walks "
         "off.",
         demo_nudge},
        {"step-up", "step_up", "Step up", "Off: the stairs are a wall. On: they are climbed.", demo_step_up},
        {"heightfield", "heightfield", "Heightfield", "Off: falls through the terrain. On: walks over it.",
         demo_heightfield},
        {"sectors", "sectors", "Sectors",
         "A million metres out. Off: coordinates are 6 cm apart, and the posts of the gate have moved too "
         "close. On: walks through as at the origin.",
         demo_sectors},
        {"bounce", "bounce", "Bounce", "Off: the pad is a floor. On: each rebound is 0.8 times as fast.",
         demo_bounce},
        {"sticky", "stick", "Sticky", "Off: slides down the wall. On: hangs on it, stick or no stick.",
         demo_sticky},
        {"snap-down", "snap_down", "Snap to floor",
         "Off: flies off the stairs on the way down. On: the path follows them.", demo_snap_down},
        {"seam-filter", "seam_filter", "Seam filter",
         "A floor rises into the player. Off: the edges of its triangles hold the player fast. On: the walk "
         "goes on.",
         demo_seam_filter},
        {"coyote", "coyote", "Coyote time",
         "Jump is pressed 3 ticks after the ledge. Off: falls into the gap. On: reaches the other side.",
         demo_coyote},
        {"jump-buffer", "jump_buffer", "Jump buffer",
         "Jump is pressed 4 ticks before landing. Off: is lost. On: starts on landing.", demo_jump_buffer},
        {"variable-jump", "variable_jump", "Variable jump height",
         "The button is held for 6 ticks only. Off: as high as ever. On: a short hop under the beam.",
         demo_variable_jump},
        {"air-control", "air_control", "Air control",
         "The stick turns in mid-air. Off: flies on past the pillar's top. On: lands on it.",
         demo_air_control},
        {"moving-platforms", "platforms", "Moving platforms",
         "Off: the raft slides away under the feet. On: it carries the player across the gap.",
         demo_platforms},
        {"turntable", "platforms", "Turntable",
         "Off: the turntable turns under the feet. On: the player goes round with it.", demo_turntable},
        {"surface-types", "surface_types", "Surface types",
         "Off: the ladder is a wall. On: it is climbed, and the conveyor above carries on.",
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
