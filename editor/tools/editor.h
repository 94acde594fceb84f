// The state behind the editor's windows. It knows neither ImGui nor OpenGL, so that all of it can be tested
// and scripted.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/document.h"
#include "document/recent_files.h"
#include "slipface/view/level_style.h"
#include "tools/lab/imported_run.h"
#include "tools/lab/lab.h"
#include "tools/lab/probe.h"
#include "tools/lab/why.h"
#include "tools/playtest/playtest.h"
#include "tools/session/import_card.h"
#include "tools/session/session.h"
#include "tools/view/panel_layout.h"
#include "tools/view/panes.h"
#include "tools/view/view_camera.h"

namespace slipface {

// What dragging with the select tool does.
enum class SelectShape { box, lasso, brush };

// Whether faces are drawn, and can be picked, from behind.
enum class BackFaces {
    automatic,  // `never` where back faces would hide rooms seen from outside, otherwise `always`
    always,
    never
};

enum class Tool { select, paint, fill, probe, props };
inline constexpr std::size_t tool_count = 5;

// What the handles at the chosen prop do.
enum class PropHandles { move, rotate, scale };
struct PropTool {
    std::string chosen;  // name of a prop; empty, or of none that is there: none
    std::string file;    // what a click with the tool places; empty: a click chooses
    PropHandles handles = PropHandles::move;
    bool snap = true;
    double move_step = 0.25;                // metres
    double turn_step = 0.2617993877991494;  // radians, 15 degrees
    double scale_step = 0.1;
    std::vector<std::string> files;  // that can be placed, of the document `files_of`
    const Document* files_of = nullptr;
};

// A point of the level that a command acts on (tools/target.h).
struct FacePoint {
    FaceId face = no_id;
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitY();
    const char* where = "";  // "under the mouse", for the status line
};

// A message that the user must close. One at a time, drawn over all windows.
struct MessageDialog {
    std::string title;
    std::string text;
    Warnings details;
    bool of_broken_file = false;    // closes by itself when the file can be read again
    bool offers_save_as = false;    // the level file could not be written where it was to go
    bool of_refused_write = false;  // something was not written: a script must expect it, or it fails
    bool asks_about_files = false;  // the answers to Session::changed are its buttons
};
struct DemoInfo;

// The question about unsaved changes, asked before `then`.
struct UnsavedDialog {
    enum class Then { open, quit, demo, recover } then = Then::quit;
    std::filesystem::path open_path;
    const DemoInfo* demo = nullptr;
    AutosaveInfo autosave{};
};
enum class UnsavedChoice { save, discard, cancel };
enum class FileDialogKind {
    none,
    open,
    save_as,
    open_tape,
    open_recording,
    add_tape,
    import_run,
    save_tape,
    save_capsule,
    save_csv,
    open_preset,
    save_preset,
    export_obj,
    export_gltf,
    export_game
};

// A run that was recorded in a level and not saved when another level was opened.
struct StoredTape {
    std::filesystem::path level;  // its geometry
    Tape tape;
    std::string name;
};

// A run to be opened as soon as its level is.
struct AwaitedRun {
    Tape tape;
    std::string name;
    std::filesystem::path file = {};  // of a tape; empty: the run is in no file of its own
    std::size_t tick = 0;
    std::string note = {};
    bool from_capsule = false;
    std::filesystem::path level = {};  // its geometry
};

struct Review;

struct Editor {
    std::unique_ptr<Document> document;  // null: nothing is open
    std::shared_ptr<Review> review;      // of snapshots (tools/review.h); null: none
    RecentFiles recent;
    Session session;  // opening, autosaves, reloading, preferences, the doctor

    ViewCamera view;           // of the active pane
    double view_aspect = 1.6;  // its width / height, as drawn last
    Panes panes;
    std::optional<std::size_t> camera_shown;  // the bookmark used last
    LevelStyle style;                         // its back_faces is set per view by draws_back_faces()
    BackFaces back_faces = BackFaces::automatic;
    float overlay_strength = LevelStyle{}.overlay;  // restored when the overlay is switched on again
    bool show_triangle_ids = false;                 // beside the mouse
    bool show_trace = true;                         // in playtest: contacts of the last tick

    Tool tool = Tool::select;
    std::optional<SurfaceId> brush = SurfaceId{1};  // nothing: unset
    std::optional<std::size_t> rule;                // open in the Rules panel
    double brush_radius = 0.0;                      // metres; 0: single faces
    double fill_angle = 0.2617993877991494;         // radians, 15 degrees
    SelectShape select_shape = SelectShape::box;
    bool select_through = false;  // box and lasso also take faces that cannot be seen
    bool select_whole = false;    // box and lasso take only faces that lie inside completely
    double select_radius = 0.0;   // metres, of the selecting brush; 0: single faces
    FaceId hovered = no_id;
    Vec3 hovered_point = Vec3::Zero();
    Vec3 hovered_normal = Vec3::Zero();
    // Under the mouse when the context menu or the palette was opened over the view, while one of them is
    // open.
    std::optional<FacePoint> pointed;

    std::size_t stroke_painted = 0;  // faces painted by the present stroke

    // A panel's widget holds a transaction open while the user drags it or types in it.
    bool live_edit = false;

    Probe probe;
    PropTool props;
    std::optional<Playtest> playtest;      // walking while set
    bool began_in_view = true;             // the walk: its start was seen in the view before
    Lab lab;                               // the tape, and its runs under other settings
    ImportedRun imported;                  // of another controller, beside the lab's tape
    Why why;                               // of the lab's selected run
    std::vector<StoredTape> stored_tapes;  // newest last; each returns when its level is opened
    std::optional<AwaitedRun> awaited_run;
    std::optional<StoredTape> walked_on;    // the run that the playtest goes on from, which stays as a ghost
    std::shared_ptr<class AuditJob> audit;  // of random walkers: running, or with results
    std::shared_ptr<class ReachJob> reach;  // the search for what can be reached: running, or with results

    // Open windows.
    PanelLayout layout;
    ImportCard import_card;
    Warnings texture_warnings;           // of the level that is shown; known once it was drawn
    std::uint64_t texture_revision = 0;  // grows when texture files have changed
    bool show_shortcuts = false, show_command_palette = false;
    std::vector<std::string> recent_commands;  // ids, as run from the command palette, newest first
    std::string movement_search;               // what the Movement panel is searched for; empty: it shows all
    std::optional<MessageDialog> message;
    std::optional<UnsavedDialog> unsaved;
    FileDialogKind file_dialog = FileDialogKind::none;
    std::string status;  // the last action, for the status bar
    // Text that the app copies to the clipboard at the end of the frame.
    std::optional<std::string> clipboard;
    // The title of a section of docs/symptoms.md that the host shows at the end of the frame.
    std::optional<std::string> symptom;
    bool quit = false;  // the host ends after this frame

    // The last result of tool_faces(), valid until one of its inputs changes.
    struct ToolFaces {
        const Document* document = nullptr;
        const void* mesh = nullptr;  // LevelMesh::id()
        Tool tool = Tool::select;
        FaceId hovered = no_id;
        Vec3 point = Vec3::Zero();
        double size = 0.0;
        std::vector<FaceId> faces;
    };
    mutable ToolFaces tool_faces;
    // The result of is_made_of_rooms() for this mesh.
    struct Rooms {
        const void* mesh = nullptr;  // LevelMesh::id()
        bool made_of = false;
    };
    mutable Rooms rooms;
};

// Each of these reports failure as a MessageDialog and leaves the open document as it was.
void open_level(Editor& editor, const std::filesystem::path& path);  // asks nothing
// Shows a document that was opened elsewhere and adds `path` to the recent files.
void adopt_document(Editor& editor, std::unique_ptr<Document> document, const std::filesystem::path& path);
void geometry_changed(Editor& editor);  // the document has another mesh: clears what refers to the old one
// Does what `next` says; asks first if there are unsaved changes.
void leave_document(Editor& editor, const UnsavedDialog& next);
void request_open(Editor& editor, const std::filesystem::path& path);
void save_level(Editor& editor);
void save_level_as(Editor& editor, const std::filesystem::path& level_file);
void request_quit(Editor& editor);
// Closes the dialog and continues with the decision.
void answer_unsaved(Editor& editor, UnsavedChoice choice);

// Whether a view by this camera draws back faces. `automatic` does not draw them from outside a level made of
// rooms, nor in orthographic views of one; during a playtest it draws them.
bool draws_back_faces(const Editor& editor, const Camera& camera);
bool sees_back_faces(const Editor& editor);  // the active view
void set_back_faces(Editor& editor, BackFaces wanted);

// The face under a ray, or no_id; fills hovered_*. Finds non-solid faces, too; back faces only while they are
// drawn.
void hover(Editor& editor, const Ray& ray);
// The faces that a click with the tool would change: none, the hovered face, those under the brush, or the
// flood fill's. Ascending.
const std::vector<FaceId>& tool_faces(const Editor& editor);
// Gives faces a type (nothing: removes their paint) and writes to the status line how many changed; during a
// stroke, how many since the stroke began.
void paint_faces(Editor& editor, std::span<const FaceId> faces, std::optional<SurfaceId> surface);
void paint_hovered(Editor& editor);  // with the brush, inside the open transaction if there is one
void fill_hovered(Editor& editor);
void pick_surface(Editor& editor);                   // eyedropper: the target's type becomes the brush
void frame_selected(Editor& editor, double aspect);  // or all faces if none is selected
void choose_brush(Editor& editor, std::optional<SurfaceId> surface);
void make_brush_valid(Editor& editor);  // if undo removed the brush's type, the brush becomes `default`
Spawn spawn_on(const Editor& editor, const FacePoint& target);  // for a player there, with the camera's yaw
void set_spawn_on_target(Editor& editor);                       // moves the main spawn there
void start_playtest(Editor& editor);    // at the main spawn, moved to a position that fits (find_start)
void restart_playtest(Editor& editor);  // from the start of the running one
void play_from_target(Editor& editor);  // with the view's yaw
void play_from_view(Editor& editor);    // the same on the face in the middle of the view
void stop_playtest(Editor& editor);

// Faces for LevelRenderer::set_face_highlights: bit 0 hovered (all faces that the tool would touch), bit 1
// selected, bit 2 hidden.
// `own`: how many of the first faces are listed one by one; the others belong to props.
struct FaceHighlights {
    std::vector<std::uint8_t> own;                             // [face]
    std::map<std::uint32_t, std::vector<std::uint8_t>> props;  // [prop] of its faces; those that have some
    friend bool operator==(const FaceHighlights&, const FaceHighlights&) = default;
};
FaceHighlights face_highlights(const Editor& editor, std::size_t own);

}  // namespace slipface
