// Everything the editor's windows show and change. Knows neither ImGui nor OpenGL, so that all of it can be
// tested and scripted.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/document.h"
#include "document/recent_files.h"
#include "slipface/render/level_renderer.h"
#include "tools/import_card.h"
#include "tools/lab.h"
#include "tools/panel_layout.h"
#include "tools/panes.h"
#include "tools/playtest.h"
#include "tools/probe.h"
#include "tools/session.h"
#include "tools/view_camera.h"
#include "tools/why.h"

namespace slipface {

// What dragging with the select tool does.
enum class SelectShape { box, lasso, brush };

// Whether faces are drawn, and can be picked, from behind.
enum class BackFaces {
    automatic,  // as `always`, but as `never` where they would hide the rooms that one looks at from outside
    always,
    never
};

enum class Tool { select, paint, fill, probe };
inline constexpr std::size_t tool_count = 4;

// What the UI has to ask or tell. One at a time; the window on top of everything shows it.
struct MessageDialog {
    std::string title;
    std::string text;
    Warnings details;
    bool of_broken_file = false;  // closes by itself when the file can be read again
};
struct DemoInfo;

// A decision about unsaved changes, before `then` is done.
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
    save_tape,
    save_csv,
    open_preset,
    save_preset,
    export_obj,
    export_gltf,
    export_game
};

// A run that was recorded in a level, never saved, and left behind when another level was opened.
struct KeptTape {
    std::filesystem::path level;  // its geometry
    Tape tape;
    std::string name;
};

struct Review;

struct Editor {
    std::unique_ptr<Document> document;  // null: nothing is open
    std::shared_ptr<Review> review;      // of snapshots (tools/review.h); null: none
    RecentFiles recent;
    Session session;  // opening, autosaves, reloading, preferences, the doctor

    ViewCamera view;           // of the active pane
    double view_aspect = 1.6;  // width to height of it, as drawn last
    Panes panes;
    std::optional<std::size_t> camera_shown;  // the bookmark gone to last
    LevelStyle style;                         // its back_faces is for each view to say: draws_back_faces()
    BackFaces back_faces = BackFaces::automatic;
    float overlay_strength = LevelStyle{}.overlay;  // what switching the overlay on again brings back
    bool show_triangle_ids = false;                 // beside the mouse
    bool show_trace = true;                         // in playtest: contacts of the last tick

    Tool tool = Tool::select;
    std::optional<SurfaceId> brush = SurfaceId{1};  // nothing: unset
    double brush_radius = 0.0;                      // metres; 0: single faces
    double fill_angle = 0.2617993877991494;         // radians, 15 degrees
    SelectShape select_shape = SelectShape::box;
    bool select_through = false;  // box and lasso take what cannot be seen, too
    bool select_whole = false;    // box and lasso take only what lies inside them as a whole
    double select_radius = 0.0;   // metres, of the selecting brush; 0: single faces
    FaceId hovered = no_id;
    Vec3 hovered_point = Vec3::Zero();
    Vec3 hovered_normal = Vec3::Zero();

    std::size_t stroke_painted = 0;  // faces, by the stroke under way

    bool live_edit = false;  // a panel's widget holds a transaction open while it is dragged or typed in

    Probe probe;
    std::optional<Playtest> playtest;       // walking while set
    Lab lab;                                // what was walked, and what would have been otherwise
    CureJob cures;                          // of the stop at the lab's cursor
    std::vector<KeptTape> kept_tapes;       // the newest last; each comes back with its level
    std::shared_ptr<class AuditJob> audit;  // random walkers at work, or what they found

    // Open windows.
    PanelLayout layout;
    ImportCard import_card;
    Warnings texture_warnings;  // of the level that is shown, known once it was drawn
    bool show_shortcuts = false, show_command_palette = false;
    std::vector<std::string> recent_commands;  // ids, as run from the command palette, newest first
    std::optional<MessageDialog> message;
    std::optional<UnsavedDialog> unsaved;
    FileDialogKind file_dialog = FileDialogKind::none;
    std::string status;                    // last thing done, for the status bar
    std::optional<std::string> clipboard;  // text that the app puts there at the end of the frame
    bool quit = false;                     // the host ends after this frame

    // What tool_faces() found last, for as long as nothing that it depends on changes.
    struct ToolFaces {
        const Document* document = nullptr;
        const Mesh* mesh = nullptr;
        Tool tool = Tool::select;
        FaceId hovered = no_id;
        Vec3 point = Vec3::Zero();
        double size = 0.0;
        std::vector<FaceId> faces;
    };
    mutable ToolFaces tool_faces;
    // What is_made_of_rooms() says of this mesh.
    struct Rooms {
        const Mesh* mesh = nullptr;
        bool made_of = false;
    };
    mutable Rooms rooms;
};

// Each of these reports failure as a MessageDialog and leaves the open document as it was.
void open_level(Editor& editor, const std::filesystem::path& path);  // no question asked
// Shows a document that was opened elsewhere; `path` goes to the recent files.
void adopt_document(Editor& editor, std::unique_ptr<Document> document, const std::filesystem::path& path);
void geometry_changed(Editor& editor);  // the document has another mesh: what points into the old one goes
// Does what `next` says; asks first when there are unsaved changes.
void leave_document(Editor& editor, const UnsavedDialog& next);
void request_open(Editor& editor, const std::filesystem::path& path);
void save_level(Editor& editor);
void save_level_as(Editor& editor, const std::filesystem::path& level_file);
void request_quit(Editor& editor);
void answer_unsaved(Editor& editor, UnsavedChoice choice);  // closes the dialog and goes on as decided

// Whether a view by this camera draws backs. Automatically it does not from outside a level made of rooms,
// nor in its plans (orthographic views); walking always does.
bool draws_back_faces(const Editor& editor, const Camera& camera);
bool sees_back_faces(const Editor& editor);  // the active view
void set_back_faces(Editor& editor, BackFaces wanted);

// The face under a ray, or no_id; fills hovered_*. Faces that are not solid are found too; back faces only
// while they are drawn.
void hover(Editor& editor, const Ray& ray);
// What a click with the tool would touch: nothing, the hovered face, the brush's or the flood's. Ascending.
const std::vector<FaceId>& tool_faces(const Editor& editor);
// Gives faces a type (nothing: unset) and says in the status line on how many it changed, within a stroke on
// how many since the stroke began.
void paint_faces(Editor& editor, std::span<const FaceId> faces, std::optional<SurfaceId> surface);
void paint_hovered(Editor& editor);  // with the brush, within the open transaction if there is one
void fill_hovered(Editor& editor);
void pick_surface(Editor& editor);                   // eyedropper: the hovered face's type becomes the brush
void frame_selected(Editor& editor, double aspect);  // or everything when nothing is selected
void choose_brush(Editor& editor, std::optional<SurfaceId> surface);
void keep_brush_valid(Editor& editor);         // undo may take the brush's type away; then it is `default`
Spawn spawn_on_hovered(const Editor& editor);  // of a player standing there, looking where the camera looks
void set_spawn_hovered(
    Editor& editor);  // a player standing at the hovered point, looking where the camera looks
void start_playtest(Editor& editor);     // at the main spawn, made to fit (find_start)
void restart_playtest(Editor& editor);   // from where the running one began
void play_from_hovered(Editor& editor);  // on the face under the mouse, looking where the view looks
void stop_playtest(Editor& editor);

// Faces for LevelRenderer::set_face_highlights: bit 0 hovered (all faces that the tool would touch), bit 1
// selected, bit 2 hidden.
std::vector<std::uint8_t> face_highlights(const Editor& editor);

}  // namespace slipface
