// Opening, saving and leaving, and what the tools do to the faces under the mouse.
#include "tools/editor.h"

#include <algorithm>
#include <utility>

#include "document/faces.h"
#include "document/inside_out.h"
#include "slipface/base/counted.h"
#include "slipface/level/find_start.h"
#include "tools/commands/commands.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/run_file.h"
#include "tools/target.h"

namespace slipface {
namespace {

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

// "Painted ice on 12 faces".
std::string painted_text(const Editor& editor, std::optional<SurfaceId> surface, std::size_t faces) {
    const std::string count = counted(faces, "face");
    if (!surface) return "Unset on " + count;
    return "Painted " + editor.document->level().surfaces[*surface].name + " on " + count;
}

// Ends a stroke or drag that is still in progress.
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
    restore_tape(editor);
    open_awaited_run(editor);
    offer_recovery(editor);
}

void geometry_changed(Editor& editor) {
    editor.playtest.reset();
    forget_hover(editor);
    editor.tool_faces = {};
    editor.probe = {};
    editor.props.file.clear();
    editor.session.report.reset();
    editor.session.problem.reset();
    make_brush_valid(editor);
    const Document& document = *editor.document;
    if (!document.warnings().empty() || !document.level().orphans.empty() || !document.guessed().empty())
        editor.layout.show(PanelId::warnings);
}

void adopt_document(Editor& editor, std::unique_ptr<Document> opened, const std::filesystem::path& path) {
    stop_playtest(editor);
    store_tape(editor);
    document_is_safe(editor);
    editor.session.changed.reset();
    editor.live_edit = false;
    editor.lab.close();
    editor.audit.reset();
    editor.reach.reset();
    editor.document = std::move(opened);
    editor.recent.add(path);
    geometry_changed(editor);
    const Document& document = *editor.document;
    watch_files(editor);
    editor.camera_shown.reset();
    editor.view.orthographic = false;
    const std::size_t panes = std::exchange(editor.panes, {}).count;
    set_pane_count(editor, panes);  // the other panes show the new level
    if (const std::vector<CameraBookmark>& cameras = document.level().cameras; !cameras.empty()) {
        editor.view.look_at(cameras.front().eye, cameras.front().target);
    } else {
        // Not from where the level before was looked at: that may be along this one's floor.
        const ViewCamera usual;
        editor.view.yaw = usual.yaw;
        editor.view.pitch = usual.pitch;
        frame_pane(editor, editor.panes.active);
    }
    editor.status = "Opened " + path.filename().string() + ", " + counted(document.face_count(), "face");
    if (const std::size_t hidden = document.hidden().size(); hidden > 0)
        editor.status += ", " + std::to_string(hidden) + " hidden";
    offer_import_card(editor);
}

namespace {

void do_next(Editor& editor, const UnsavedDialog& next) {
    switch (next.then) {
        case UnsavedDialog::Then::open: start_loading(editor, next.open_path); break;
        case UnsavedDialog::Then::quit:
            stop_playtest(editor);  // which keeps its recording
            keep_edited_tape(editor);
            editor.quit = true;
            break;
        case UnsavedDialog::Then::demo: show_demo(editor, *next.demo); break;
        case UnsavedDialog::Then::recover: recover(editor, next.autosave); break;
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
    if (is_run_file(path)) return open_run_file(editor, path);
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
    if (file == editor.document->level().file_path && saving_must_wait(editor)) return;
    editor.session.autosave.write_now(*editor.document, file);
    if (const Status status = editor.document->save_as(file); !status) {
        editor.message = MessageDialog{.title = "Cannot save " + file.filename().string(),
                                       .text = status.error().text(),
                                       .details = {},
                                       .offers_save_as = true,
                                       .of_refused_write = true};
        return;
    }
    document_is_safe(editor);
    editor.session.changed.reset();
    watch_files(editor);
    editor.status = "Saved " + file.filename().string();
}

void request_quit(Editor& editor) {
    leave_document(editor, {.then = UnsavedDialog::Then::quit, .open_path = {}});
}

void answer_unsaved(Editor& editor, UnsavedChoice choice) {
    if (!editor.unsaved) return;
    const UnsavedDialog requested = *editor.unsaved;
    editor.unsaved.reset();
    if (choice == UnsavedChoice::cancel) return;
    if (choice == UnsavedChoice::save) {
        save_level(editor);
        if (editor.document && editor.document->dirty()) return;  // saving failed and reported why
    }
    do_next(editor, requested);
}

bool draws_back_faces(const Editor& editor, const Camera& camera) {
    if (editor.back_faces != BackFaces::automatic) return editor.back_faces == BackFaces::always;
    if (!editor.document || editor.playtest) return true;
    const CollisionWorld& world = editor.document->collision();
    if (editor.rooms.mesh != editor.document->level().mesh.id())
        editor.rooms = {editor.document->level().mesh.id(), is_made_of_rooms(world)};
    return !editor.rooms.made_of || !(camera.orthographic || is_outside_rooms(world, camera.eye));
}

bool sees_back_faces(const Editor& editor) {
    return draws_back_faces(editor, editor.view.camera());
}

void set_back_faces(Editor& editor, BackFaces wanted) {
    editor.back_faces = wanted;
    switch (wanted) {
        case BackFaces::automatic:
            editor.status = "Back faces: automatic (hidden from outside a level of rooms)";
            break;
        case BackFaces::always: editor.status = "Back faces: always drawn"; break;
        case BackFaces::never: editor.status = "Back faces: never drawn"; break;
    }
}

void hover(Editor& editor, const Ray& ray) {
    forget_hover(editor);
    if (!editor.document) return;
    const std::optional<RayHit> hit =
        editor.document->pick(ray.origin, ray.direction, !sees_back_faces(editor));
    if (!hit) return;
    editor.hovered = hit->face;
    editor.hovered_point = hit->point;
    editor.hovered_normal = hit->normal;
}

const std::vector<FaceId>& tool_faces(const Editor& editor) {
    Editor::ToolFaces& found = editor.tool_faces;
    const Document* document = editor.document.get();
    if (!document || editor.hovered >= document->face_count() || editor.playtest) {
        found = {};
        return found.faces;
    }
    const bool selects_by_brush = editor.tool == Tool::select && editor.select_shape == SelectShape::brush;
    const double size = editor.tool == Tool::fill ? editor.fill_angle
                        : selects_by_brush        ? editor.select_radius
                                                  : editor.brush_radius;
    const bool by_point = (editor.tool == Tool::paint || selects_by_brush) && size > 0.0;
    if (found.document == document && found.mesh == document->level().mesh.id() &&
        found.tool == editor.tool && found.hovered == editor.hovered && found.size == size &&
        (!by_point || found.point == editor.hovered_point))
        return found.faces;

    // Every face of a flood fill has the same flood fill.
    if (editor.tool == Tool::fill && found.document == document &&
        found.mesh == document->level().mesh.id() && found.tool == editor.tool && found.size == size &&
        std::binary_search(found.faces.begin(), found.faces.end(), editor.hovered)) {
        found.hovered = editor.hovered;
        return found.faces;
    }
    found = {document, document->level().mesh.id(), editor.tool, editor.hovered, editor.hovered_point, size,
             {}};
    switch (editor.tool) {
        case Tool::probe:
        case Tool::props: break;
        case Tool::select:
            found.faces = {editor.hovered};
            if (selects_by_brush)
                found.faces = brush_faces(*document, editor.hovered, editor.hovered_point, size);
            break;
        case Tool::paint:
            found.faces = brush_faces(*document, editor.hovered, editor.hovered_point, size);
            break;
        case Tool::fill: found.faces = flood_by_angle(*document, editor.hovered, size); break;
    }
    return found.faces;
}

void paint_faces(Editor& editor, std::span<const FaceId> faces, std::optional<SurfaceId> surface) {
    if (!editor.document) return;
    const std::size_t changed = editor.document->paint(faces, surface);
    if (changed == 0) return;
    if (!editor.document->in_transaction()) editor.stroke_painted = 0;
    editor.stroke_painted += changed;
    editor.status = painted_text(editor, surface, editor.stroke_painted);
}

void paint_hovered(Editor& editor) {
    if (!editor.document || editor.hovered >= editor.document->face_count()) return;
    paint_faces(editor,
                brush_faces(*editor.document, editor.hovered, editor.hovered_point, editor.brush_radius),
                editor.brush);
}

void fill_hovered(Editor& editor) {
    if (!editor.document || editor.hovered >= editor.document->face_count()) return;
    paint_faces(editor, flood_by_angle(*editor.document, editor.hovered, editor.fill_angle), editor.brush);
}

void pick_surface(Editor& editor) {
    const std::optional<FacePoint> target = target_or_say(editor);
    if (!target) return;
    editor.brush = editor.document->surface_of(target->face);
    editor.status = "Brush: " + brush_name(editor);
}

void frame_selected(Editor& editor, double aspect) {
    if (!editor.document) return;
    const Document& document = *editor.document;
    editor.view.frame(
        document.selection().empty() ? shown_bounds(document) : faces_bounds(document, document.selection()),
        aspect);
}

void choose_brush(Editor& editor, std::optional<SurfaceId> surface) {
    if (!editor.document) return;
    if (surface && *surface >= editor.document->level().surfaces.size()) return;
    editor.brush = surface;
    editor.status = "Brush: " + brush_name(editor);
    if (editor.tool == Tool::paint || editor.tool == Tool::fill) return;
    const bool selected = !editor.document->selection().empty();
    const Command& use = *find_command(selected ? "edit.fill_selection" : "tools.paint");
    const std::string key = shortcut_text(editor, use);
    editor.status += selected ? ". Paint the selection with " : ". Paint with ";
    editor.status += key.empty() ? use.label : key;
}

void make_brush_valid(Editor& editor) {
    if (editor.document && editor.brush && *editor.brush >= editor.document->level().surfaces.size())
        editor.brush = default_surface;
}

Spawn spawn_on(const Editor& editor, const FacePoint& target) {
    Probe standing;
    standing.place_on(target.point, target.normal, editor.document->level().movement);
    return {standing.from, editor.view.yaw};
}

void set_spawn_on_target(Editor& editor) {
    const std::optional<FacePoint> target = target_or_say(editor);
    if (!target) return;
    editor.document->set_spawn(spawn_on(editor, *target));
    editor.status = std::string("Spawn point set ") + target->where;
}

namespace {

// By value: the position may belong to the playtest that ends here.
void begin_playtest(Editor& editor, const Vec3 position, double yaw, std::string note) {
    finish_edits(editor);
    const Document& document = *editor.document;
    const bool first_person = editor.playtest && editor.playtest->first_person;
    take_playtest_tape(editor);  // of the attempt that ends here
    editor.playtest.emplace();
    editor.playtest->first_person = first_person;
    editor.playtest->start(position, yaw);
    editor.began_in_view = true;
    editor.playtest->name_level(document.level().mesh_path.filename().string(),
                                document.level().mesh.fingerprint(),
                                scene_fingerprint(editor.lab.scene(document).at(0, 0.0)));
    editor.status = std::move(note);
}

Result<Start> start_in(const Editor& editor, const Level& level) {
    const TickScene scene = editor.lab.scene(*editor.document);
    return find_start(level, scene.at(0, 0.0), scene.offset(), level.movement);
}

}  // namespace

void start_playtest(Editor& editor) {
    if (!editor.document) return;
    const Result<Start> start = start_in(editor, editor.document->level());
    if (!start) return;
    const bool seen = is_in_view(editor, start->position);
    begin_playtest(editor, start->position, start->yaw, start->note);
    editor.began_in_view = seen;
}

void restart_playtest(Editor& editor) {
    if (!editor.playtest) return;
    begin_playtest(editor, editor.playtest->spawn(), editor.playtest->spawn_yaw(), "");
}

namespace {

void play_from(Editor& editor, const FacePoint& target) {
    Level here;  // find_start() needs only the spawns of a level
    here.movement = editor.document->level().movement;
    Spawn spawn = spawn_on(editor, target);
    spawn.name = "here";
    set_spawns(here, {spawn});
    const Result<Start> start = start_in(editor, here);
    if (!start) return;
    begin_playtest(editor, start->position, start->yaw,
                   start->note.empty() ? std::string("Playing from the face ") + target.where : start->note);
}

}  // namespace

void play_from_target(Editor& editor) {
    if (const std::optional<FacePoint> target = target_or_say(editor)) play_from(editor, *target);
}

void play_from_view(Editor& editor) {
    if (const std::optional<FacePoint> target = middle_of_view(editor))
        play_from(editor, *target);
    else
        editor.status = "There is no face in the middle of the view";
}

void stop_playtest(Editor& editor) {
    take_playtest_tape(editor);
    editor.playtest.reset();
}

FaceHighlights face_highlights(const Editor& editor, std::size_t own) {
    FaceHighlights highlights;
    if (!editor.document) return highlights;
    const PlacedProps& placed = editor.document->level().placed;
    highlights.own.resize(own);
    std::uint32_t prop = no_id;
    std::vector<std::uint8_t>* of_prop = nullptr;
    const auto flags_of = [&](FaceId face) -> std::uint8_t& {
        if (face < own) return highlights.own[face];
        if (prop == no_id || face < placed.first_face[prop] || face >= placed.first_face[prop + 1]) {
            prop = placed.prop_of(face);
            of_prop = &highlights.props[prop];
            of_prop->resize(placed.first_face[prop + 1] - placed.first_face[prop]);
        }
        return (*of_prop)[face - placed.first_face[prop]];
    };
    for (const FaceId face : tool_faces(editor))
        flags_of(face) = 1;
    if (!editor.playtest)  // the player sees the paint, not the selection
        for (const FaceId face : editor.document->selection())
            flags_of(face) = static_cast<std::uint8_t>(flags_of(face) | 2);
    for (const FaceId face : editor.document->hidden())
        flags_of(face) = 4;
    return highlights;
}

}  // namespace slipface
