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
#include "tools/lab.h"
#include "tools/panel_layout.h"
#include "tools/panes.h"
#include "tools/playtest.h"
#include "tools/probe.h"
#include "tools/session.h"
#include "tools/view_camera.h"

namespace slipface {

// What dragging with the select tool does.
enum class SelectShape { box, lasso, brush };

enum class Tool { select, paint, fill, probe };
inline constexpr std::size_t tool_count = 4;

// What the UI has to ask or tell. One at a time; the window on top of everything shows it.
struct MessageDialog {
    std::string title;
    std::string text;
    Warnings details;
};
struct DemoInfo;

// A decision about unsaved changes, before `then` is done.
struct UnsavedDialog {
    enum class Then { open, quit, demo } then = Then::quit;
    std::filesystem::path open_path;
    const DemoInfo* demo = nullptr;
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
    LevelStyle style;
    float overlay_strength = LevelStyle{}.overlay;  // what switching the overlay on again brings back
    bool show_triangle_ids = false;                 // beside the mouse
    bool show_trace = true;                         // in playtest: contacts of the last tick

    Tool tool = Tool::select;
    std::optional<SurfaceId> brush = SurfaceId{1};  // nothing: unset
    double brush_radius = 0.0;                      // metres; 0: single faces
    double fill_angle = 0.2617993877991494;         // radians, 15 degrees
    SelectShape select_shape = SelectShape::box;
    bool select_through = false;  // box and lasso take what cannot be seen, too
    double select_radius = 0.0;   // metres, of the selecting brush; 0: single faces
    FaceId hovered = no_id;
    Vec3 hovered_point = Vec3::Zero();
    Vec3 hovered_normal = Vec3::Zero();

    bool live_edit = false;  // a panel's widget holds a transaction open while it is dragged or typed in

    Probe probe;
    std::optional<Playtest> playtest;       // walking while set
    Lab lab;                                // what was walked, and what would have been otherwise
    std::vector<KeptTape> kept_tapes;       // the newest last; each comes back with its level
    std::shared_ptr<class AuditJob> audit;  // random walkers at work, or what they found

    // Open windows.
    PanelLayout layout;
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

// The face under a ray, or no_id; fills hovered_*. Faces that are not solid are found too; back faces only
// while they are drawn.
void hover(Editor& editor, const Ray& ray);
// What a click with the tool would touch: nothing, the hovered face, the brush's or the flood's. Ascending.
const std::vector<FaceId>& tool_faces(const Editor& editor);
void paint_hovered(Editor& editor);  // with the brush, within the open transaction if there is one
void fill_hovered(Editor& editor);
void pick_surface(Editor& editor);                   // eyedropper: the hovered face's type becomes the brush
void frame_selected(Editor& editor, double aspect);  // or everything when nothing is selected
void choose_brush(Editor& editor, std::optional<SurfaceId> surface);
void keep_brush_valid(Editor& editor);  // undo may take the brush's type away; then it is `default`
void set_spawn_hovered(
    Editor& editor);  // a player standing at the hovered point, looking where the camera looks
void start_playtest(Editor& editor);  // again from the spawn if it is running
void stop_playtest(Editor& editor);

// Faces for LevelRenderer::set_face_highlights: bit 0 hovered (all faces that the tool would touch), bit 1
// selected, bit 2 hidden.
std::vector<std::uint8_t> face_highlights(const Editor& editor);

}  // namespace slipface
