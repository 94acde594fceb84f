// Draws a level's faces: textured or plain, with an overlay of the surface types.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slipface/base/placement.h"
#include "slipface/level/level.h"
#include "slipface/level/level_light.h"
#include "slipface/mesh/animation.h"
#include "slipface/mesh/mesh.h"
#include "slipface/mesh/texture_file.h"
#include "slipface/movement/surface_type.h"
#include "slipface/render/gl_context.h"
#include "slipface/view/camera.h"
#include "slipface/view/level_style.h"

namespace slipface {

// An instance of a mesh.
struct PosedMesh {
    Placement at;
    RigPose pose = {};  // of a mesh with clips; without bones: at rest
    UvChange uv{1, 1, 0, 0};
};

class LevelRenderer {
  public:
    explicit LevelRenderer(GlTable gl);
    ~LevelRenderer();
    LevelRenderer(const LevelRenderer&) = delete;
    LevelRenderer& operator=(const LevelRenderer&) = delete;

    // Uploads the geometry and loads the textures relative to `folder`; missing or broken ones are drawn as a
    // checker and returned as warnings. All faces are `default` and not highlighted afterwards. Null: only
    // the background is drawn. read_texture() says what is read.
    Warnings set_mesh(MeshPtr mesh, const std::filesystem::path& folder);

    // A mesh that only draw_placed() draws. If it has clips, in any pose.
    Warnings set_instances(MeshPtr mesh, const std::filesystem::path& folder);

    // The level's baked light; its image is in `folder`. Call it after set_mesh(), which drops the light.
    // `lit` is the mesh it was baked for: the first faces of the drawn one. An image that does not fit this
    // mesh is not used and returned as a warning.
    Warnings set_light(const std::optional<LevelLight>& light, const MeshPtr& lit,
                       const std::filesystem::path& folder);

    // The type of every face, and the highlight of every face (bit 0 hovered, bit 1 selected, bit 2 not
    // drawn). Uploads only what changed.
    void set_face_surfaces(std::span<const SurfaceId> surfaces);
    void set_face_highlights(std::span<const std::uint8_t> highlights);
    // Sorts the mesh's edges, which outlines need. Without this call the first highlight does it.
    void prepare_outlines();
    void set_surface_types(SurfaceTable surfaces);

    // Draws the level's props beside the mesh, which is then the one without them: each mesh is uploaded
    // once, and a change of the props costs little. `types`: resolve_props(), painted. Not lit by baked
    // light. Returns textures that are missing. set_mesh() ends it.
    Warnings set_props(const Level& level, const PropSurfaces& types);
    // For a mesh that has the faces of the props, as baked light needs it: those that are animated are drawn
    // as instances instead of their faces there, and not lit.
    Warnings set_animated_props(const Level& level, PropSurfaces types);
    // Highlights of props that have some: [prop] of each face.
    void set_prop_highlights(const std::map<std::uint32_t, std::vector<std::uint8_t>>& highlights);
    // The moment of the level that the props' clips and textures show, seconds.
    void animate_props(double time_s);
    // Draws props elsewhere than they rest: [prop].
    void move_props(const std::map<std::uint32_t, Pose>& poses);

    // Moves faces: a face with parts[face] other than no_id is drawn at poses[parts[face]] of its position in
    // the mesh. Empty `parts`: no face moves. Uploads only the moved faces. Borders and outlines do not move.
    void move_faces(std::span<const std::uint32_t> parts, std::span<const Pose> poses);

    // Error: the driver refused a shader, and draw() only clears.
    Status status() const;
    // Bytes uploaded so far by set_face_surfaces() and set_face_highlights(): the cost of changes.
    std::size_t face_state_bytes_uploaded() const;

    // Clears the bound framebuffer and draws background and level into it.
    void draw(const Camera& camera, int width, int height, const LevelStyle& style);
    // Draws the level alone, with depth test, over what is already drawn: another level of the same world.
    void draw_over(const Camera& camera, int width, int height, const LevelStyle& style);
    // The same where `placed` has the mesh of set_instances(), without borders. `extent_around`: the size of
    // the level around it, metres, from which follows what is far away.
    void draw_placed(const Camera& camera, int width, int height, const LevelStyle& style,
                     const PosedMesh& placed, double extent_around);

  private:
    friend class LevelProps;
    struct Impl;
    explicit LevelRenderer(std::unique_ptr<Impl> impl);
    Warnings set(MeshPtr mesh, const std::filesystem::path& folder, bool instances);
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface
