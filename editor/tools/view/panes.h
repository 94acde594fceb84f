// Up to four views of the level side by side.
#pragma once

#include <array>
#include <cstddef>

#include "tools/view/view_camera.h"

namespace slipface {

struct Editor;

// The active pane's camera is Editor::view; the others' are in `waiting`.
struct Panes {
    static constexpr std::size_t maximum = 4;

    std::size_t count = 1;   // 1: all of it; 2: side by side; 3: one large, two stacked; 4: a cross
    std::size_t active = 0;  // the one that the mouse and commands use
    bool maximised = false;  // only the active one is shown
    std::array<ViewCamera, maximum> waiting;
    double across = 0.5, down = 0.5;  // positions of the borders between them, as fractions of the view
};

struct PaneRect {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;  // fractions of the view
};
// The rectangle of each pane; width 0: not shown.
std::array<PaneRect, Panes::maximum> pane_rects(const Panes& panes);
const ViewCamera& pane_view(const Editor& editor, std::size_t pane);

// Panes that are shown for the first time begin as top, front and right views of the level.
void set_pane_count(Editor& editor, std::size_t count);
void activate_pane(Editor& editor, std::size_t pane);  // ignored unless it is shown

}  // namespace slipface
