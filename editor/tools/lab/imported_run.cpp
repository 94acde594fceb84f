#include "tools/lab/imported_run.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "slipface/level/level_scene.h"
#include "tools/lab/lab_actions.h"

namespace slipface {

std::size_t ImportedRun::tick_at(double seconds) const {
    const double time_s = run->ticks.front().time_s + seconds;
    const auto at = std::ranges::lower_bound(run->ticks, time_s - 1e-9, {}, &RecordedTick::time_s);
    return std::min(static_cast<std::size_t>(at - run->ticks.begin()), run->ticks.size() - 1);
}

void import_run(Editor& editor, const std::filesystem::path& path) {
    if (!editor.document) return;
    const std::string name = path.filename().string();
    const auto refuse = [&](const Error& error) {
        editor.message = MessageDialog{"Cannot import " + name, error.text(), {}};
    };
    Result<RecordedRun> run = read_recorded_run(path);
    if (!run) return refuse(run.error());
    keep_edited_tape(editor);
    if (const Status status = editor.lab.open(*editor.document, tape_of(*run), name); !status)
        return refuse(status.error());
    editor.imported = {.name = name, .run = std::make_shared<const RecordedRun>(std::move(*run))};
    editor.lab.runs().front().name = "Slipface";
    for (LabRun& other : std::span(editor.lab.runs()).subspan(1))
        other.shown = false;
    complete_runs(editor);
    show_lab(editor);
    editor.status = "Imported " + name + ": its path, and Slipface's mover with its inputs";
}

const std::vector<RecordedFault>* imported_faults(Editor& editor) {
    if (!editor.document || !editor.imported.run) return nullptr;
    return seek(editor.imported.faults, {editor.document->face_revision()}, search_wait(editor), [&] {
        return [level = editor.document->snapshot(),
                run = editor.imported.run](Progress&) -> Result<std::vector<RecordedFault>> {
            Result<LevelScene> scene = LevelScene::build(level);
            if (!scene) return scene.error();
            return find_recorded_faults(level, *scene, *run, level.movement);
        };
    });
}

void go_to_fault(Editor& editor, const RecordedFault& fault) {
    Lab& lab = editor.lab;
    lab.motion = LabMotion::paused;
    const std::vector<RecordedTick>& ticks = editor.imported.run->ticks;
    if (lab.has_tape())
        lab.seek(static_cast<std::size_t>(std::max(
            0.0, std::round((ticks[fault.last].time_s - ticks.front().time_s) / lab.tape().dt - 1.0))));
    const Vec3 eye =
        viewpoint(editor.document->collision(), fault.position, Vec3::Zero(), editor.view.camera().eye, 5.0);
    editor.view.look_at(eye, fault.position);
}

}  // namespace slipface
