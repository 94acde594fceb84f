// The doctor in the editor: background examination, going to a problem, and the fixes that paint can make.
#include <algorithm>
#include <utility>

#include "document/faces.h"
#include "tools/editor.h"

namespace slipface {
namespace {

bool differ_in_type(const Document& document, const Problem& problem) {
    const std::size_t count = document.face_count();
    return problem.face < count && problem.other < count &&
           document.surface_of(problem.face) != document.surface_of(problem.other);
}

}  // namespace

bool report_is_current(const Editor& editor) {
    const Session& session = editor.session;
    return editor.document && session.report && session.report_revision == editor.document->face_revision();
}

void examine_level(Editor& editor) {
    Session& session = editor.session;
    if (!editor.document) return;
    session.report_revision = editor.document->face_revision();
    session.doctor = std::make_unique<Background<Result<DoctorReport>>>(
        [level = editor.document->snapshot()](Progress& progress) {
            progress.begin("Examining", 0.0, 1.0);
            return examine(level, [&](double done) {
                progress.advance(done);
                return !progress.cancelled();
            });
        },
        session.wake);
    if (!session.beside) finish_examination(editor);
}

void finish_examination(Editor& editor) {
    Session& session = editor.session;
    Result<DoctorReport> report = std::exchange(session.doctor, nullptr)->take();
    session.problem.reset();
    if (report)
        session.report = std::move(*report);
    else
        editor.message = MessageDialog{"Cannot examine the level", report.error().text(), {}};
}

void go_to_position(Editor& editor, const Vec3& position) {
    if (!editor.document) return;
    // Close enough to see the problem, with enough of its surroundings.
    const Vec3 around = 4.0 * editor.document->level().movement.radii;
    Aabb box;
    box.add(position - around);
    box.add(position + around);
    editor.view.frame(box, 1.6);
}

void go_to_problem(Editor& editor, std::size_t row) {
    const std::optional<DoctorReport>& report = editor.session.report;
    if (!editor.document || !report || row >= report->problems.size()) return;
    Document& document = *editor.document;
    const Problem& problem = report->problems[row];
    editor.session.problem = row;
    std::vector<FaceId> faces;
    for (const FaceId face : {problem.face, problem.other})
        if (face < document.face_count()) faces.push_back(face);
    go_to_position(editor, problem.position);
    document.select(std::move(faces));
    editor.status = info_of(problem.kind).label + std::string(": ") + problem.text;
}

std::string fix_label(const Editor& editor, const Problem& problem) {
    if (!editor.document) return {};
    const Document& document = *editor.document;
    switch (problem.kind) {
        case ProblemKind::duplicate:
        case ProblemKind::overlap:
            if (!differ_in_type(document, problem)) return {};
            return "Make both " + document.level().surfaces[document.surface_of(problem.other)].name;
        case ProblemKind::orphan:
            if (problem.index >= document.level().orphans.size()) return {};
            if (document.selection().empty()) return {};
            return document.selection().size() == 1
                       ? "Attach to the selected face"
                       : "Attach to " + std::to_string(document.selection().size()) + " selected faces";
        default: return {};
    }
}

void fix_problem(Editor& editor, const Problem& problem) {
    if (fix_label(editor, problem).empty()) return;
    Document& document = *editor.document;
    if (problem.kind == ProblemKind::orphan) {
        const std::vector<FaceId> faces(document.selection().begin(), document.selection().end());
        const Status status = document.attach_orphan(problem.index, faces);
        if (!status) editor.message = MessageDialog{"Cannot attach the orphan", status.error().text(), {}};
        return;
    }
    const SurfaceId wanted = document.surface_of(problem.other);
    document.paint(std::span(&problem.face, 1), wanted);
    editor.status = "Both faces are " + document.level().surfaces[wanted].name + " now";
}

}  // namespace slipface
