// What a motion of a painted part explains: how much of the part is in the mesh where the motion puts it.
#pragma once

#include <optional>

#include "mesh_parts.h"
#include "part_motion.h"
#include "vertex_grid.h"

namespace slipface {

struct FaceKey;

// Fractions, 0 to 1, of a part that the mesh has after a motion.
struct Support {
    double corners = 0.0, keys = 0.0;  // anchors' corners; painted faces, half without their material
    double ranks = 0.0;                // anchors with their place in the file's order
    double sum() const { return corners + keys; }
};

class MotionCheck {
  public:
    // All must outlive this.
    MotionCheck(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces, const PaintParts& parts,
                const std::vector<const FaceKey*>& keys);

    // Of a stored part.
    struct Sample {
        std::vector<Vec3> points;          // corners of its anchors, each once
        std::vector<const FaceKey*> keys;  // some of its painted faces
    };
    const std::vector<Sample>& samples() const { return samples_; }
    const VertexGrid& grid() const { return grid_; }
    const MeshParts& mesh_parts();  // those of the mesh, found when they are first needed

    // `least`: below this fraction of corners all is 0. Without ranks, which cost more.
    Support support(std::size_t part, const Motion& motion, double least) const;
    double ranks_kept(std::size_t part, const Motion& motion);

    bool is_flipped(std::size_t part, const Motion& motion) const;  // more faces look the other way
    // True if the motion puts the part where another one stayed.
    bool is_taken(std::size_t part, const Motion& motion);
    // A part of equal tiles that lost some at its rim looks as if it had moved by a tile, but nothing of it
    // is at a new place.
    bool stays_inside(std::size_t part, const Motion& motion) const;
    // Tiles may repeat at half their size in a subdivided part. So a part that was scaled must fill its new
    // box.
    bool fills_box(std::size_t part, const Motion& motion);
    // Whether the mesh has a part that fills nearly the same box: an edited part.
    bool has_similar_box(std::size_t part);

  private:
    enum class Side { none, same, other, both };
    double tolerance(const Motion& motion, const Vec3& from, const Vec3& to) const;
    double corners_hit(const Sample& sample, const Motion& motion, double least) const;
    Side find_face(const FaceKey& key, const Motion& motion, bool& same_material) const;

    const Mesh& mesh_;
    const FaceIndex& index_;
    SurfaceTable surfaces_;
    const PaintParts& stored_;
    VertexGrid grid_;
    std::vector<Sample> samples_;
    std::optional<MeshParts> mesh_parts_;
    std::vector<std::uint32_t> vertex_part_;  // [vertex] its part of the mesh
    std::vector<std::uint32_t> owner_;        // [part of the mesh] the stored part with its box, or no_id
};

inline constexpr double box_slack = 0.05;  // of a box's diagonal, by which edits in place change it

}  // namespace slipface
