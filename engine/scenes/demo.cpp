#include "slipface/scenes/demo.h"

#include "demos.h"

namespace slipface {

std::span<const DemoInfo> demo_table() {
    static const std::vector<DemoInfo> table = [] {
        std::vector<DemoInfo> all;
        for (const auto demos : {lecture_demos(), ground_demos(), air_demos(), move_demos()})
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

std::string sentences_of(const DemoInfo& info) {
    return std::string(info.problem) + " " + info.cure;
}

std::string off_of(const DemoInfo& info) {
    return *info.off != '\0' ? info.off : std::string(info.hack) + "=off";
}

std::string changed_by(const DemoInfo& info) {
    const std::string off = off_of(info);
    return off.substr(0, off.find_first_of("= "));
}

bool plays_lecture(const DemoInfo& info) {
    return info.formula.text != nullptr;
}

std::string exercise_of(const DemoInfo& info) {
    const std::string name = info.name, by = changed_by(info);
    const std::string allowed = plays_lecture(info) && by != "mover" ? "mover," + by : by;
    return "Exercise: " + std::string(info.exercise) + (*info.exercise == '\0' ? "" : " ") + "change " +
           name + "-off.tape, its settings or its inputs, until it passes: slipface grade " + name + ".obj " +
           name + "-off.tape --allow " + allowed;
}

const FormulaInfo* formula_of(const DemoInfo& info) {
    return info.formula.text != nullptr ? &info.formula : find_formula(info.hack);
}

Demo make_demo(const DemoInfo& info) {
    Demo demo = info.build();
    const std::string name = info.name;
    demo.level.mesh_path = name + ".obj";
    demo.level.file_path = name + ".slipface.json";
    demo.off = demo.on;
    demo.level.movement = demo.on;
    demo.camera.name = info.title;
    demo.level.cameras = {demo.camera};
    demo.tape.level_name = name + ".obj";
    demo.tape.level_fingerprint = demo.level.mesh.fingerprint();
    demo.off_tape = demo.tape;
    constexpr std::string_view mover = "mover ";
    const std::string off = off_of(info);
    if (off.starts_with(mover))
        demo.off_tape.mover = find_mover(off.substr(mover.size()));
    else  // the demos' own values, of which a test tries all
        static_cast<void>(set_setting(demo.off, off).ok());
    return demo;
}

}  // namespace slipface
