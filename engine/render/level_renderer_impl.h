// The data of a LevelRenderer: buffers, textures and programs of one context, and the geometry to draw.
#pragma once

#include <optional>

#include "face_state.h"
#include "level_geometry.h"
#include "level_programs.h"
#include "level_props.h"
#include "level_textures.h"
#include "light_map.h"
#include "rig_buffers.h"
#include "slipface/mesh/animation.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

struct LevelRenderer::Impl {
    struct LineBuffer {
        unsigned vertex_array = 0, buffer = 0;
        GLsizei count = 0;
    };
    // Triangles of one moving part, contiguous in the vertex buffer.
    struct MovingRun {
        std::uint32_t part = no_id;
        std::size_t first = 0;
        std::vector<TriangleId> triangles;
    };

    // `programs`: those of another renderer of this context, for one that draws only faces.
    explicit Impl(GlTable table, std::shared_ptr<LevelPrograms> programs = nullptr)
        : gl(std::move(table)),
          textures(gl),
          face_state(gl),
          light_map(gl),
          only_faces(programs != nullptr),
          level_programs(programs ? std::move(programs) : std::make_shared<LevelPrograms>(gl)) {}

    GlTable gl;
    LevelTextures textures;
    FaceState face_state;
    LightMap light_map;
    bool only_faces;
    std::shared_ptr<LevelPrograms> level_programs;
    std::optional<LevelLight> light;
    Status status;
    MeshPtr mesh;
    Vec3 origin = Vec3::Zero();
    std::vector<DrawBatch> batches;
    std::vector<std::uint8_t> highlights;  // [face]
    std::vector<std::uint32_t> parts;      // [face] its moving part, or no_id; empty: none moves
    std::vector<MovingRun> moving;         // of parts, in drawing order
    // An instance of the mesh: where, and which of several states of all faces it has.
    struct Place {
        Placement at;
        int first_state = 0;  // face 0 in face_state
        const RigPose* pose = nullptr;
        UvChange uv{1, 1, 0, 0};
    };
    // While instances are drawn: where, and the origin of the vertices.
    std::span<const Place> places;
    Vec3 mesh_origin = Vec3::Zero();
    double extent_around = 0.0;  // of the level around, metres
    std::unique_ptr<LevelProps> props;

    std::vector<std::pair<FaceId, FaceId>> drawn_apart;  // faces that props draw instead

    bool surfaces_shown = false;  // some face has a type other than `default`
    bool highlights_shown = false;

    unsigned background_program = 0, line_program = 0;
    unsigned empty_array = 0, level_array = 0, level_buffer = 0;
    unsigned table_texture = 0, white_texture = 0;
    LineBuffer borders, selected_outline, hovered_outline;
    bool borders_built = false;
    std::unique_ptr<RigBuffers> rig;  // of a mesh that is drawn as instances and has clips
    std::optional<OutlineFinder> outlines;

    // level_buffers.cpp
    void build_programs();
    void build_objects();
    bool upload_geometry(const Mesh& from, Warnings& warnings);
    void find_moving(std::span<const std::uint32_t> face_parts);
    void reset_faces();
    void upload_lines(LineBuffer& lines, const std::vector<LineInstance>& instances);

    // level_drawing.cpp
    bool lit(const LevelStyle& style) const {
        return style.textured && style.baked_light && light_map.loaded();
    }
    void draw_background(const Camera& camera, double aspect, const LevelStyle& style);
    void set_sky(const Camera& camera, double aspect);
    void set_level_uniforms(unsigned program, const Camera& camera, int height, const Mat4f& clip,
                            const LevelStyle& style);
    void draw_faces(const Camera& camera, int height, const Mat4f& clip, const LevelStyle& style);
    void draw_in_pieces(const DrawBatch& batch);
    void set_place(unsigned program, const Place& place);
    void draw_lines(const LineBuffer& lines, float shortest);
    void reset_state(int width, int height);
    void draw_level(const Camera& camera, int width, int height, const LevelStyle& style);
    Eigen::Vector4f eye_uniform(const Camera& camera) const;
};

}  // namespace slipface
