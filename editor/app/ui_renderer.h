// Draws Dear ImGui's lists through our own table of OpenGL functions, so that one process can use any
// context. The renderer that ships with Dear ImGui 1.86 always loads libGL, which knows nothing of a context
// made by OSMesa.
#pragma once

#include <imgui.h>

#include "slipface/render/gl_context.h"

namespace slipface {

class UiRenderer {
  public:
    // Uploads the fonts of the current Dear ImGui context.
    explicit UiRenderer(GlTable gl);
    ~UiRenderer();
    UiRenderer(const UiRenderer&) = delete;
    UiRenderer& operator=(const UiRenderer&) = delete;

    // Over the bound framebuffer; sets every state that it needs and leaves blending and the scissor switched
    // off.
    void draw(const ImDrawData& data);

  private:
    GlTable gl_;
    unsigned program_ = 0, vertex_array_ = 0, vertices_ = 0, indices_ = 0, font_texture_ = 0;
    int projection_location_ = -1, texture_location_ = -1;
};

}  // namespace slipface
