// Opening, saving and leaving, and what the tools do to the faces under the mouse.
#include "tools/editor.h"

#include <algorithm>
#include <utility>

#include "document/faces.h"
#include "tools/lab_actions.h"

namespace slipface {
namespace {

constexpr double opening_aspect = 1.6;  // the window is not known yet; framing again corrects it

std::string count_text(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string brush_name(const Editor& editor) {
    if (!editor.brush) return "unset";
    const std::vector<SurfaceType>& surfaces = editor.document->level().surfaces;
    return *editor.brush < surfaces.size() ? surfaces[*editor.brush].name : "nothing";
}

void forget_hover(Editor& editor) {
    editor.hovered = no_id;
    editor.hovered_point = Vec3::Zero();
    editor.hovered_normal = Vec3::Zero();
}

void paint_faces(Editor& editor, const std::vector<FaceId>& faces) {
    const std::uint64_t before = editor.document->face_revision();
    editor.document->paint(faces, editor.brush);
    if (editor.document->face_revision() != before)
        editor.status = (editor.brush ? "Painted " + brush_name(editor) : std::string("Unset")) + " on " +
                        count_text(faces.size(), "face", "faces");
}

// A stroke or drag that is still going on ends where it is.
void finish_edits(Editor& editor) {
    while (editor.document && editor.document->in_transaction())
        editor.document->commit();
    editor.live_edit = false;
}

}  // namespace

void open_level(Editor& editor, const std::filesystem::path& path) {
    Result<std::unique_ptr<Document>> opened = Document::open(path);
    const std::string name = path.filename().string();
    if (!opened) {
        editor.message = MessageDialog{"Cannot open " + name, opened.error().text(), {}};
        return;
    }
    adopt_document(editor, std::move(opened).value(), path);
    bring_back_tape(editor);
}

void geometry_changed(Editor& editor) {
    editor.playtest.reset();
    forget_hover(editor);
    editor.tool_faces = {};
    editor.probe = {};
    editor.session.report.reset();
    editor.session.problem.reset();
    keep_brush_valid(editor);
    const Document& document = *editor.document;
    if (!document.warnings().empty() || !document.level().orphans.empty())
        editor.layout.show(PanelId::warnings);
}

void adopt_document(Editor& editor, std::unique_ptr<Document> opened, const std::filesystem::path& path) {
    stop_playtest(editor);
    keep_tape(editor);
    document_is_safe(editor);
    editor.live_edit = false;
    editor.lab.close();
    editor.audit.reset();
    editor.document = std::move(opened);
    editor.recent.add(path);
    geometry_changed(editor);
    const Document& document = *editor.document;
    editor.session.watch.start(document.level().mesh_path, document.level().file_path);
    editor.camera_shown.reset();
    editor.view.orthographic = false;
    const std::size_t panes = std::exchange(editor.panes, {}).count;
    set_pane_count(editor, panes);  // the others look at the new level
    if (const std::vector<CameraBookmark>& cameras = document.level().cameras; !cameras.empty())
        editor.view.look_at(cameras.front().eye, cameras.front().target);
    else
        editor.view.frame(document.mesh().bounds, opening_aspect);
    editor.status = "Opened " + path.filename().string() + ", " +
                    count_text(document.mesh().face_count(), "face", "faces");
    if (const std::size_t hidden = document.hidden().size(); hidden > 0)
        editor.status += ", " + std::to_string(hidden) + " hidden";
}

namespace {

void do_next(Editor& editor, const UnsavedDialog& next) {
    switch (next.then) {
        case UnsavedDialog::Then::open:
            start_loading(editor, next.open_path);
            break;
        case UnsavedDialog::Then::quit:
            stop_playtest(editor);  // which keeps its recording
            editor.quit = true;
            break;
        case UnsavedDialog::Then::demo:
            show_demo(editor, *next.demo);
            break;
    }
}

}  // namespace

void leave_document(Editor& editor, const UnsavedDialog& next) {
    finish_edits(editor);
    if (editor.document && editor.document->dirty())
        editor.unsaved = next;
    else
        do_next(editor, next);
}

void request_open(Editor& editor, const std::filesystem::path& path) {
    leave_document(editor, {.then = UnsavedDialog::Then::open, .open_path = path});
}

void save_level(Editor& editor) {
    if (editor.document) save_level_as(editor, editor.document->level().file_path);
}

void save_level_as(Editor& editor, const std::filesystem::path& level_file) {
    if (!editor.document) return;
    finish_edits(editor);
    std::filesystem::path file = level_file;
    if (!file.empty() && !file.has_extension()) file += ".slipface.json";
    if (const Status status = editor.document->save_as(file); !status) {
        editor.message = MessageDialog{"Cannot save " + file.filename().string(), status.error().text(), {}};
        return;
    }
    document_is_safe(editor);
    editor.session.watch.start(editor.document->level().mesh_path, editor.document->level().file_path);
    editor.status = "Saved " + file.filename().string();
}

void request_quit(Editor& editor) {
    leave_document(editor, {.then = UnsavedDialog::Then::quit, .open_path = {}});
}

void answer_unsaved(Editor& editor, UnsavedChoice choice) {
    if (!editor.unsaved) return;
    const UnsavedDialog asked = *editor.unsaved;
    editor.unsaved.reset();
    if (choice == UnsavedChoice::cancel) return;
    if (choice == UnsavedChoice::save) {
        save_level(editor);
        if (editor.document && editor.document->dirty()) return;  // saving failed and said why
    }
    do_next(editor, asked);
}

void hover(Editor& editor, const Ray& ray) {
    forget_hover(editor);
    if (!editor.document) return;
    const std::optional<RayHit> hit =
        editor.document->pick(ray.origin, ray.direction, !editor.style.back_faces);
    if (!hit) return;
    editor.hovered = hit->face;
    editor.hovered_point = hit->point;
    editor.hovered_normal = hit->normal;
}

const std::vector<FaceId>& tool_faces(const Editor& editor) {
    Editor::ToolFaces& found = editor.tool_faces;
    const Document* document = editor.document.get();
    if (!document || editor.hovered >= document->mesh().face_count() || editor.playtest) {
        found = {};
        return found.faces;
    }
    const bool selects_by_brush = editor.tool == Tool::select && editor.select_shape == SelectShape::brush;
    const double size = editor.tool == Tool::fill ? editor.fill_angle
                        : selects_by_brush        ? editor.select_radius
                                                  : editor.brush_radius;
    const bool by_point = (editor.tool == Tool::paint || selects_by_brush) && size > 0.0;
    if (found.document == document && found.mesh == &document->mesh() && found.tool == editor.tool &&
        found.hovered == editor.hovered && found.size == size &&
        (!by_point || found.point == editor.hovered_point))
        return found.faces;

    // Within a flood every face has the same flood.
    if (editor.tool == Tool::fill && found.document == document && found.mesh == &document->mesh() &&
        found.tool == editor.tool && found.size == size &&
        std::binary_search(found.faces.begin(), found.faces.end(), editor.hovered)) {
        found.hovered = editor.hovered;
        return found.faces;
    }
    found = {document, &document->mesh(), editor.tool, editor.hovered, editor.hovered_point, size, {}};
    switch (editor.tool) {
        case Tool::probe:
            break;
        case Tool::select:
            found.faces = {editor.hovered};
            if (selects_by_brush)
                found.faces = brush_faces(document->mesh(), document->neighbours(), editor.hovered,
                                          editor.hovered_point, size);
            break;
        case Tool::paint:
            found.faces = brush_faces(document->mesh(), document->neighbours(), editor.hovered,
                                      editor.hovered_point, size);
            break;
        case Tool::fill:
            found.faces = flood_by_angle(document->facts(), document->neighbours(),
                                         std::span(&editor.hovered, 1), size);
            break;
    }
    return found.faces;
}

void paint_hovered(Editor& editor) {
    if (!editor.document || editor.hovered >= editor.document->mesh().face_count()) return;
    paint_faces(editor, brush_faces(editor.document->mesh(), editor.document->neighbours(), editor.hovered,
                                    editor.hovered_point, editor.brush_radius));
}

void fill_hovered(Editor& editor) {
    if (!editor.document || editor.hovered >= editor.document->mesh().face_count()) return;
    paint_faces(editor, flood_by_angle(editor.document->facts(), editor.document->neighbours(),
                                       std::span(&editor.hovered, 1), editor.fill_angle));
}

void pick_surface(Editor& editor) {
    if (!editor.document || editor.hovered >= editor.document->mesh().face_count()) return;
    editor.brush = editor.document->resolved().surface[editor.hovered];
    editor.status = "Brush: " + brush_name(editor);
}

void frame_selected(Editor& editor, double aspect) {
    if (!editor.document) return;
    const Document& document = *editor.document;
    editor.view.frame(document.selection().empty() ? document.mesh().bounds
                                                   : faces_bounds(document.mesh(), document.selection()),
                      aspect);
}

void choose_brush(Editor& editor, std::optional<SurfaceId> surface) {
    if (!editor.document) return;
    if (surface && *surface >= editor.document->level().surfaces.size()) return;
    editor.brush = surface;
    if (editor.tool != Tool::paint && editor.tool != Tool::fill) editor.tool = Tool::paint;
    editor.status = "Brush: " + brush_name(editor);
}

void keep_brush_valid(Editor& editor) {
    if (editor.document && editor.brush && *editor.brush >= editor.document->level().surfaces.size())
        editor.brush = default_surface;
}

void set_spawn_hovered(Editor& editor) {
    if (!editor.document || editor.hovered == no_id) return;
    Probe standing;
    standing.place_on(editor.hovered_point, editor.hovered_normal, editor.document->level().movement);
    editor.document->set_spawn({standing.from, editor.view.yaw});
    editor.status = "Spawn point set";
}

void start_playtest(Editor& editor) {
    if (!editor.document) return;
    finish_edits(editor);
    const Document& document = *editor.document;
    const bool first_person = editor.playtest && editor.playtest->first_person;
    take_playtest_tape(editor);  // of the attempt that ends here
    editor.playtest.emplace();
    editor.playtest->first_person = first_person;
    editor.playtest->start(document.level().spawn, document.level().spawn_yaw);
    editor.playtest->name_level(document.level().mesh_path.filename().string(), document.mesh().fingerprint,
                                scene_fingerprint(editor.lab.scene(document).at(0, 0.0)));
    editor.status =
        overlaps_any(document.collision(), document.level().movement.radii, document.level().spawn)
            ? "The spawn point overlaps the level"
            : "";
}

void stop_playtest(Editor& editor) {
    take_playtest_tape(editor);
    editor.playtest.reset();
}

std::vector<std::uint8_t> face_highlights(const Editor& editor) {
    if (!editor.document) return {};
    std::vector<std::uint8_t> highlights(editor.document->mesh().face_count(), 0);
    for (const FaceId face : tool_faces(editor))
        highlights[face] = 1;
    for (const FaceId face : editor.document->selection())
        highlights[face] = static_cast<std::uint8_t>(highlights[face] | 2);
    for (const FaceId face : editor.document->hidden())
        highlights[face] = 4;
    return highlights;
}

}  // namespace slipface
