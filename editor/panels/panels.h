// The editor's panels. Each draws itself into the current ImGui window region given by the layout and acts on
// the Editor.
#pragma once

#include <functional>

#include "slipface/render/overlay.h"
#include "tools/commands/commands.h"
#include "tools/playtest/play_frame.h"

struct ImVec2;

namespace slipface {

// The part of the frame that draws the 3D view. The app owns the GL objects; the viewport panel requests an
// image of the level.
struct ViewportServices {
    // Draws level and overlay with `camera` into the pane's target of that many pixels and returns the
    // texture (rows from the bottom).
    virtual unsigned render(std::size_t pane, const Camera& camera, const Overlay& overlay, int width,
                            int height) = 0;
    // An image as a texture (rows from the top). One per slot is stored; a new `revision` uploads it again.
    virtual unsigned still(int slot, const Image& image, std::uint64_t revision) = 0;
    virtual ~ViewportServices() = default;
};

// Small images of levels that are not open, drawn once by the same renderer and stored.
struct ImageRequest {
    const Level* level = nullptr;
    Camera camera;
    Overlay overlay;
};
struct ImageServices {
    // The texture (rows from the bottom) stored under `key`; `request` is called the first time.
    virtual unsigned image(const std::string& key, int width, int height,
                           const std::function<ImageRequest()>& request) = 0;
    virtual ~ImageServices() = default;
};

struct FrameContext {
    double seconds = 1.0 / 60.0;  // since the last frame, clamped
    HeldKeys held;
    ViewportServices* viewport = nullptr;
    ImageServices* images = nullptr;    // null: images cannot be drawn
    bool wants_cursor_capture = false;  // out: the host hides and captures the cursor
    bool animating = false;             // out: draw another frame soon even without events
};

// Image, gestures, overlays, legend, playtest HUD.
void viewport_panel(Editor& editor, FrameContext& frame);
// The card about unit, axis and size, if shown: at the left of this room, or over its corner where the view
// beside it would be too narrow. Returns the width that the view leaves to it.
float import_card(Editor& editor, const ImVec2& min, const ImVec2& size);
void palette_panel(Editor& editor);     // surface types: choose, edit, counts
void rules_panel(Editor& editor);       // types for materials by their names; the level's materials
void spawns_panel(Editor& editor);      // spawns: add, rename, delete, choose; the fall limit
void cameras_panel(Editor& editor);     // bookmarks: go there, add, rename, delete
void props_panel(Editor& editor);       // instances of meshes: place, move, turn, scale, paint
void selections_panel(Editor& editor);  // saved selections: recall, add, rename, delete
void movement_panel(Editor& editor, FrameContext& frame);  // every hack and parameter, from settings_table()
void probe_panel(Editor& editor);                          // numbers of the sweep probe
void inspector_panel(Editor& editor);                      // the hovered or selected faces
void history_panel(Editor& editor);
void warnings_panel(Editor& editor);
void review_panel(Editor& editor);
void problems_panel(Editor& editor);                   // what the mesh doctor found
void why_panel(Editor& editor);                        // the story of the lab's tick
void ghosts_panel(Editor& editor);                     // the lab's runs, and the route at other rates
void timeline_panel(Editor& editor);                   // the lab's tape
void card_panel(Editor& editor, FrameContext& frame);  // of the open demo
void inputs_panel(Editor& editor);                     // the tape as text, to be typed in
void plots_panel(Editor& editor);                      // the lab's runs as curves
void audit_panel(Editor& editor, FrameContext& frame);
void reach_panel(Editor& editor, FrameContext& frame);

// Calls the function above for `panel`.
void draw_panel(PanelId panel, Editor& editor, FrameContext& frame);

}  // namespace slipface
