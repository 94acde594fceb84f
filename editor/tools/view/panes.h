// Up to four views of the level side by side.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "tools/view/view_camera.h"

namespace slipface {

struct Editor;

struct FramedView {
    ViewCamera view;
    std::vector<Vec3> points = {};  // what it shows; none: the level
    double aspect = 0.0;            // width / height; 0: not drawn yet
};

// The active pane's camera is Editor::view; the others' are in `waiting`.
struct Panes {
    static constexpr std::size_t maximum = 4;

    std::size_t count = 1;   // 1: all of it; 2: side by side; 3: one large, two stacked; 4: a cross
    std::size_t active = 0;  // the one that the mouse and commands use
    bool maximised = false;  // only the active one is shown
    std::array<ViewCamera, maximum> waiting;
    // How a pane was framed when it, or its level, opened; empty once the view has been moved.
    std::array<std::optional<FramedView>, maximum> framed;
    double across = 0.5, down = 0.5;  // positions of the borders between them, as fractions of the view
};

struct PaneRect {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;  // fractions of the view
};
// The rectangle of each pane; width 0: not shown.
std::array<PaneRect, Panes::maximum> pane_rects(const Panes& panes);
ViewCamera& pane_view(Editor& editor, std::size_t pane);
const ViewCamera& pane_view(const Editor& editor, std::size_t pane);

// Panes that are shown for the first time begin as top, front and right views of the level.
void set_pane_count(Editor& editor, std::size_t count);
// Shows all of the level in a pane, from where it is seen: along the view's direction, or from above where
// that would show it from behind; inside a building that is closed on all sides. A view that is not moved
// until then fits the pane when it is drawn.
void frame_pane(Editor& editor, std::size_t pane);
// The same for these points, along the view's direction.
void frame_pane(Editor& editor, std::size_t pane, std::vector<Vec3> points);
// `aspect`: width / height of the pane as it is drawn now.
void fit_framed_pane(Editor& editor, std::size_t pane, double aspect);
void activate_pane(Editor& editor, std::size_t pane);  // ignored unless it is shown

}  // namespace slipface
