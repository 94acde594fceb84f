#include "tools/view/panes.h"

#include <algorithm>
#include <utility>

#include "document/faces.h"
#include "tools/editor.h"

namespace slipface {

std::array<PaneRect, Panes::maximum> pane_rects(const Panes& panes) {
    std::array<PaneRect, Panes::maximum> rects;
    const double x = std::clamp(panes.across, 0.1, 0.9), y = std::clamp(panes.down, 0.1, 0.9);
    if (panes.maximised || panes.count == 1) {
        rects[panes.active] = {0.0, 0.0, 1.0, 1.0};
    } else if (panes.count == 2) {
        rects[0] = {0.0, 0.0, x, 1.0};
        rects[1] = {x, 0.0, 1.0 - x, 1.0};
    } else if (panes.count == 3) {
        rects[0] = {0.0, 0.0, x, 1.0};
        rects[1] = {x, 0.0, 1.0 - x, y};
        rects[2] = {x, y, 1.0 - x, 1.0 - y};
    } else {
        rects[0] = {0.0, 0.0, x, y};
        rects[1] = {x, 0.0, 1.0 - x, y};
        rects[2] = {0.0, y, x, 1.0 - y};
        rects[3] = {x, y, 1.0 - x, 1.0 - y};
    }
    return rects;
}

ViewCamera& pane_view(Editor& editor, std::size_t pane) {
    return pane == editor.panes.active ? editor.view : editor.panes.waiting[pane];
}
const ViewCamera& pane_view(const Editor& editor, std::size_t pane) {
    return pane == editor.panes.active ? editor.view : editor.panes.waiting[pane];
}

void set_pane_count(Editor& editor, std::size_t count) {
    Panes& panes = editor.panes;
    count = std::clamp<std::size_t>(count, 1, Panes::maximum);
    const Vec3 directions[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    for (std::size_t pane = std::max<std::size_t>(1, panes.count); pane < count; ++pane) {
        ViewCamera& view = panes.waiting[pane];
        view.orthographic = true;
        view.look_from(directions[pane]);
        frame_pane(editor, pane);
    }
    if (panes.active >= count) activate_pane(editor, 0);
    panes.count = count;
    panes.maximised = false;
}

void frame_pane(Editor& editor, std::size_t pane) {
    if (!editor.document) return;
    ViewCamera& view = pane_view(editor, pane);
    view.frame(shown_bounds(*editor.document), editor.view_aspect);
    editor.panes.framed[pane] = FramedView{view};
}

void fit_framed_pane(Editor& editor, std::size_t pane, double aspect) {
    std::optional<FramedView>& framed = editor.panes.framed[pane];
    if (!framed || framed->aspect == aspect || !editor.document) return;
    ViewCamera& view = pane_view(editor, pane);
    if (view != framed->view) return framed.reset();
    view.frame(shown_bounds(*editor.document), aspect);
    framed = FramedView{view, aspect};
}

void activate_pane(Editor& editor, std::size_t pane) {
    Panes& panes = editor.panes;
    if (pane >= panes.count || pane == panes.active) return;
    panes.waiting[panes.active] = editor.view;
    panes.active = pane;
    editor.view = panes.waiting[pane];
}

}  // namespace slipface
