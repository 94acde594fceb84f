// From a row of the panel table to the function that draws it.
#include <type_traits>

#include "panels/panels.h"

namespace slipface {
namespace {

template <class Draw>
void call(Draw draw, Editor& editor, FrameContext& frame) {
    if constexpr (std::is_invocable_v<Draw, Editor&, FrameContext&>)
        draw(editor, frame);
    else
        draw(editor);
}

}  // namespace

void draw_panel(PanelId panel, Editor& editor, FrameContext& frame) {
    switch (panel) {
#define SLIPFACE_PANEL(name, ...)          \
    case PanelId::name:                    \
        call(name##_panel, editor, frame); \
        break;
#include "tools/view/panel_rows.inc"
#undef SLIPFACE_PANEL
        case PanelId::count: break;
    }
}

}  // namespace slipface
