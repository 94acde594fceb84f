// Draws Dear ImGui's lists through our own table of OpenGL functions, so that one process can use any
// context. The renderer of Dear ImGui 1.86 always loads libGL, which does not know contexts made by OSMesa.
#pragma once

#include "slipface/render/gl_context.h"
#include "widgets/imgui_compat.h"

namespace slipface {

class UiRenderer {
  public:
    explicit UiRenderer(GlTable gl);
    ~UiRenderer();
    UiRenderer(const UiRenderer&) = delete;
    UiRenderer& operator=(const UiRenderer&) = delete;

    // After each loading of fonts, for the current Dear ImGui context.
    void take_fonts() { ui::make_textures(textures_); }

    // Draws over the bound framebuffer. Sets all state that it needs; leaves blending and scissor switched
    // off.
    void draw(const ImDrawData& data);

  private:
    GlTable gl_;
    ui::TextureStore textures_;
    unsigned program_ = 0, vertex_array_ = 0, vertices_ = 0, indices_ = 0;
    int projection_location_ = -1, texture_location_ = -1;
};

}  // namespace slipface
