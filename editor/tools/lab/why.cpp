#include "tools/lab/why.h"

#include "slipface/repair/repairs.h"
#include "tools/editor.h"
#include "tools/lab/lab_actions.h"

namespace slipface {

const Stop* stop_at_cursor(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape()) return nullptr;
    for (const Stop& stop : editor.lab.stops(*editor.document))
        if (editor.lab.cursor() >= stop.first && editor.lab.cursor() <= stop.last) return &stop;
    return nullptr;
}

const std::vector<Cure>* cures_at_cursor(Editor& editor) {
    const Stop* stop = stop_at_cursor(editor);
    if (stop == nullptr) return nullptr;
    CureJob& job = editor.cures;
    const Lab& lab = editor.lab;
    const bool same =
        job.work && job.revision == lab.revision() && job.run == lab.explained() && job.first == stop->first;
    if (!same) {
        job.work.reset();
        job = CureJob{.revision = lab.revision(), .run = lab.explained(), .first = stop->first};
        auto search = [level = editor.document->snapshot(), run = lab.runs()[lab.explained()].run,
                       at = *stop](Progress& progress) -> Result<std::vector<Cure>> {
            return find_cures_and_repairs(level, run, at, [&] { return progress.cancelled(); });
        };
        job.work =
            std::make_unique<Background<Result<std::vector<Cure>>>>(std::move(search), editor.session.wake);
    }
    if (!job.taken) {
        if (editor.session.beside && !job.work->ready()) return nullptr;
        Result<std::vector<Cure>> cures = job.work->take();
        job.taken = true;
        if (cures)
            job.cures = std::move(*cures);
        else
            editor.message = MessageDialog{"Cannot look for cures", cures.error().text(), {}};
    }
    return &job.cures;
}

void go_to_stop(Editor& editor, const Stop& stop) {
    editor.lab.motion = LabMotion::paused;
    editor.lab.seek(stop.worst);
    const Vec3 eye = viewpoint(editor.document->collision(), stop.loss.position, stop.loss.normal,
                               editor.view.camera().eye, 5.0);
    editor.view.look_at(eye, stop.loss.position);
}

void go_to_headline(Editor& editor) {
    Lab& lab = editor.lab;
    const Stop* headline = headline_stop(lab.stops(*editor.document));
    lab.seek(headline ? headline->worst : lab.ticks());
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
