#include "slipface/scenes/demo.h"

#include "demos.h"

namespace slipface {

std::span<const DemoInfo> demo_table() {
    static const std::vector<DemoInfo> table = [] {
        std::vector<DemoInfo> all;
        for (const auto demos : {ground_demos(), air_demos(), move_demos()})
            all.insert(all.end(), demos.begin(), demos.end());
        return all;
    }();
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
    demo.tape.level_fingerprint = demo.level.mesh.fingerprint();
    return demo;
}

}  // namespace slipface
