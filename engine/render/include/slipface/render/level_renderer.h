// Draws a level's faces: textured or plain, with the surface types laid over them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slipface/base/pose.h"
#include "slipface/level/level_light.h"
#include "slipface/mesh/mesh.h"
#include "slipface/mesh/texture_file.h"
#include "slipface/movement/surface_type.h"
#include "slipface/render/camera.h"
#include "slipface/render/gl_context.h"

namespace slipface {

// What the overlay's colours tell: the surface types, or how steep a face is for the player.
enum class FaceColors {
    types,
    slope,    // from flat over the limit to vertical; overhangs apart
    walkable  // walkable, too steep, overhanging
};

struct LevelStyle {
    bool textured = true;     // else plain shaded grey
    bool baked_light = true;  // textures in the level's baked light and sky, if it has them
    float overlay =
        0.55f;  // strength of the surface types' colours and hatches, 0..1; `default` faces stay untouched
    FaceColors colors = FaceColors::types;
    double max_slope = 0.8726646259971648;      // radians; the limit of types without one of their own
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
    // Pictures outside `folder` are read only where `textures` says so: a level from elsewhere must not make
    // the program open any file it names. The user is asked (outside_textures).
    Warnings set_mesh(MeshPtr mesh, const std::filesystem::path& folder,
                      TextureAccess textures = TextureAccess::folder);

    // The light that the level's textures are shown in, its picture in `folder`; after set_mesh, which drops
    // it. `lit` is the mesh that it was baked for: the first faces of the one that is drawn. A picture that
    // does not fit it is not used and reported.
    Warnings set_light(const std::optional<LevelLight>& light, const MeshPtr& lit,
                       const std::filesystem::path& folder);

    // The type of every face, and the highlight of every face (bit 0 hovered, bit 1 selected, bit 2 not
    // drawn). Uploads only what changed.
    void set_face_surfaces(std::span<const SurfaceId> surfaces);
    void set_face_highlights(std::span<const std::uint8_t> highlights);
    // Does now what the first highlight would wait for: the mesh's edges are sorted to find outlines.
    void prepare_outlines();
    void set_surface_types(SurfaceTable surfaces);

    // Draws each face whose part is not no_id at poses[part] of where the mesh has it. [face] `parts`; empty:
    // all faces stand still. Sends the moved faces only. Borders and outlines stay where the mesh has them.
    void move_faces(std::span<const std::uint32_t> parts, std::span<const Pose> poses);

    // Why nothing but a clear is drawn: the driver refused a shader. Otherwise success.
    Status status() const;
    // Bytes sent by set_face_surfaces and set_face_highlights since the beginning: what a change costs.
    std::size_t face_state_bytes_uploaded() const;

    // Clears the bound framebuffer and draws background and level into it.
    void draw(const Camera& camera, int width, int height, const LevelStyle& style);
    // Draws the level alone over what is there already, by its depth: another level of the same world.
    void draw_over(const Camera& camera, int width, int height, const LevelStyle& style);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
