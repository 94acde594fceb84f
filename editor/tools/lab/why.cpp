#include "tools/lab/why.h"

#include "slipface/level/level_scene.h"
#include "slipface/repair/repairs.h"
#include "tools/editor.h"
#include "tools/lab/lab_actions.h"

namespace slipface {

SearchWait search_wait(Editor& editor) {
    return {editor.session.beside, editor.session.wake, [&editor](const Error& error) {
                editor.message = MessageDialog{"Cannot examine the run", error.text(), {}};
            }};
}

bool is_shown(const Why& why, const RunEvent& event) {
    return !why.hidden_words.contains(event.word);
}

const RunFindings* findings(Editor& editor) {
    const Lab& lab = editor.lab;
    if (!editor.document || !lab.has_tape() || !lab.runs()[lab.explained()].run.complete()) return nullptr;
    return seek(editor.why.findings, {lab.revision(), lab.explained()}, search_wait(editor), [&] {
        return [level = editor.document->snapshot(),
                run = lab.runs()[lab.explained()].run](Progress& progress) -> Result<RunFindings> {
            const auto cancelled = [&] { return progress.cancelled(); };
            Result<LevelScene> scene = LevelScene::build(level, run.settings());
            if (!scene) return scene.error();
            return RunFindings{find_stops(*scene, run, level, cancelled),
                               find_events(*scene, run, level, cancelled)};
        };
    });
}

const Stop* stop_at_cursor(Editor& editor) {
    const RunFindings* const found = findings(editor);
    if (found == nullptr) return nullptr;
    for (const Stop& stop : found->stops)
        if (editor.lab.cursor() >= stop.first && editor.lab.cursor() <= stop.last) return &stop;
    return nullptr;
}

const std::vector<Cure>* cures_at_cursor(Editor& editor) {
    const Stop* stop = stop_at_cursor(editor);
    if (stop == nullptr) return nullptr;
    const Lab& lab = editor.lab;
    const auto begin = [&] {
        return [level = editor.document->snapshot(), run = lab.runs()[lab.explained()].run,
                at = *stop](Progress& progress) -> Result<std::vector<Cure>> {
            return find_cures_and_repairs(level, run, at, [&] { return progress.cancelled(); });
        };
    };
    return seek(editor.why.cures, {lab.revision(), lab.explained(), stop->first}, search_wait(editor), begin);
}

void go_to_stop(Editor& editor, const Stop& stop) {
    editor.lab.motion = LabMotion::paused;
    editor.lab.seek(stop.worst);
    const Vec3 eye = viewpoint(editor.document->collision(), stop.loss.position, stop.loss.normal,
                               editor.view.camera().eye, 5.0);
    editor.view.look_at(eye, stop.loss.position);
}

void go_to_headline(Editor& editor) {
    editor.lab.seek(editor.lab.ticks());
    editor.why.headline_from = editor.lab.cursor();
    follow_headline(editor);
}

void follow_headline(Editor& editor) {
    if (!editor.why.headline_from) return;
    if (!editor.lab.has_tape() || editor.lab.cursor() != *editor.why.headline_from)
        return editor.why.headline_from.reset();
    const RunFindings* const found = findings(editor);
    if (found == nullptr) return;
    editor.why.headline_from.reset();
    if (const Stop* headline = headline_stop(found->stops)) editor.lab.seek(headline->worst);
}

void use_cure(Editor& editor, const Cure& cure) {
    if (!editor.document) return;
    if (cure.mesh) {
        go_to_position(editor, cure.position);
        editor.status = cure.text + ": in the modelling tool; the level is read again when it is saved";
        return;
    }
    Document& document = *editor.document;
    Level changed = document.level();
    if (const Status status = apply_cure(changed, cure); !status) {
        editor.status = status.error().text();
        return;
    }
    Transaction step(document, cure.text);
    if (changed.surfaces != document.level().surfaces) document.set_surfaces(changed.surfaces, cure.text);
    if (!cure.faces.empty()) document.paint(cure.faces, changed.overrides[cure.faces.front()]);
    if (changed.movement != document.level().movement) document.set_movement(changed.movement, cure.text);
    step.commit();
    editor.lab.explain(1);
    editor.status = cure.text;
}

}  // namespace slipface
