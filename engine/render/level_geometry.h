// A mesh in the drawing order and vertex format of the level renderer.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gl_util.h"
#include "slipface/base/pose.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

struct LevelVertex {
    float position[3];     // relative to the drawing origin
    std::uint32_t normal;  // of the face; signed 2_10_10_10, red in the low bits
    float uv[2];
    std::uint32_t face;
    std::uint8_t color[4];  // the material's diffuse colour
};
static_assert(sizeof(LevelVertex) == 32);

// Triangles that share a texture, as a range of triangles in drawing order.
struct DrawBatch {
    std::uint32_t texture = 0;
    std::size_t first = 0;
    std::size_t count = 0;
};

struct DrawOrder {
    std::vector<TriangleId> triangles;  // sorted by texture, then in the order of the mesh
    std::vector<DrawBatch> batches;
};

// `material_texture`: [material] its texture, below `texture_count`.
DrawOrder draw_order(const Mesh& mesh, std::span<const std::uint32_t> material_texture,
                     std::size_t texture_count);

// The point near the middle of the mesh to which vertices are relative. A multiple of 64 m on each axis, so
// that patterns of 16 m and below stay where they are in world space.
Vec3 drawing_origin(const Mesh& mesh);

// The vertices of the given triangles, three each, appended to `vertices`.
void append_vertices(const Mesh& mesh, std::span<const TriangleId> triangles, const Vec3& origin,
                     std::vector<LevelVertex>& vertices);

// The same for triangles moved by `pose`.
void append_moved_vertices(const Mesh& mesh, std::span<const TriangleId> triangles, const Pose& pose,
                           const Vec3& origin, std::vector<LevelVertex>& vertices);

// The borders of all faces that are not hidden (highlight bit 2), each edge once, ascending by vertex pair.
std::vector<LineInstance> face_border_lines(const Mesh& mesh, std::span<const std::uint8_t> highlights,
                                            const Vec3& origin, const std::uint8_t (&color)[4], float width);

// Finds outlines of sets of faces: the edges that only one face of the set has. Made once for a mesh; the
// cost of lines() is that of the set or of its complement, whichever is smaller.
class OutlineFinder {
  public:
    explicit OutlineFinder(const Mesh& mesh);
    // The outline of the faces whose highlight has `bit`.
    std::vector<LineInstance> lines(const Mesh& mesh, std::span<const std::uint8_t> highlights,
                                    std::uint8_t bit, const Vec3& origin, const std::uint8_t (&color)[4],
                                    float width);

  private:
    static constexpr std::uint8_t many = 255;  // this many, or more

    std::vector<std::uint32_t> edge_;  // [corner] the edge that begins there; no_id without length
    std::vector<std::array<std::uint32_t, 2>> vertices_;  // [edge]
    std::vector<std::uint8_t> total_, counted_;  // [edge] number of faces; counted in lines(), else 0
    std::vector<std::uint32_t> borders_;         // edges of one face only
};

}  // namespace slipface
