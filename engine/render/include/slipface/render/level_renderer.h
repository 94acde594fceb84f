// Draws a level's faces: textured or plain, with the surface types laid over them.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "slipface/mesh/mesh.h"
#include "slipface/movement/surface_type.h"
#include "slipface/render/camera.h"
#include "slipface/render/gl_context.h"

namespace slipface {

struct LevelStyle {
    bool textured = true;  // else plain shaded grey
    float overlay =
        0.55f;  // strength of the surface types' colours and hatches, 0..1; `default` faces stay untouched
    bool wireframe = false;                     // face borders (polygon edges, not triangle edges)
    bool back_faces = true;                     // back faces drawn darker and reddish; else culled
    Vec3f background_top{0.16f, 0.18f, 0.21f};  // sRGB
    Vec3f background_bottom{0.09f, 0.10f, 0.12f};
};

class LevelRenderer {
  public:
    explicit LevelRenderer(GlTable gl);
    ~LevelRenderer();
    LevelRenderer(const LevelRenderer&) = delete;
    LevelRenderer& operator=(const LevelRenderer&) = delete;

    // Uploads geometry and loads the textures relative to `folder`; missing or broken ones are drawn as a
    // checker and reported. All faces are `default` and not highlighted afterwards. Null: nothing but the
    // background is drawn.
    Warnings set_mesh(MeshPtr mesh, const std::filesystem::path& folder);

    // The type of every face, and the highlight of every face (bit 0 hovered, bit 1 selected). Uploads only
    // what changed.
    void set_face_surfaces(std::span<const SurfaceId> surfaces);
    void set_face_highlights(std::span<const std::uint8_t> highlights);
    void set_surface_types(SurfaceTable surfaces);

    // Why nothing but a clear is drawn: the driver refused a shader. Otherwise success.
    Status status() const;
    // Bytes sent by set_face_surfaces and set_face_highlights since the beginning: what a change costs.
    std::size_t face_state_bytes_uploaded() const;

    // Clears the bound framebuffer and draws background and level into it.
    void draw(const Camera& camera, int width, int height, const LevelStyle& style);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
