// How well motions of parts explain a mesh.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "face_index.h"
#include "mesh_parts.h"
#include "point_grid.h"

namespace slipface {

// The fraction of a box's diagonal by which edits in place change it.
inline constexpr double box_slack = 0.05;

// True if the corners of the boxes are at most this fraction of the diagonal of `b` apart.
bool similar_box(const Aabb& a, const Aabb& b, double slack);

// True if the box `a` lies in `b`, up to `slack` (units).
bool lies_in(const Aabb& a, const Aabb& b, double slack);

struct MotionSupport {
    double corners = 0.0, keys = 0.0;  // fractions
    double sum() const { return corners + keys; }
};

class PartSupport {
  public:
    PartSupport(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces, const PaintParts& parts,
                const std::vector<StoredOverride>& stored);

    // The nearest vertex within `tolerance`, at most widest(); no_id: none.
    std::uint32_t nearest(const Vec3& position, double tolerance) const;
    double widest() const { return grid_.widest(); }

    // The parts of the mesh, found when they are first needed.
    const MeshParts& all();

    // The different corners of the part's anchors. Neighbours are not one after another.
    const std::vector<Vec3>& points(std::size_t part) const { return samples_[part].points; }

    // Some of the part's painted faces.
    const std::vector<const FaceKey*>& keys(std::size_t part) const { return samples_[part].keys; }

    // Nothing as soon as the fraction of corners must be below `least`.
    MotionSupport support(std::size_t part, const PartMotion& motion, double least) const;

    // PartMotion::rest of this motion.
    double rest(std::size_t part, const PartMotion& motion) const;

    // Which way most of the area of the painted faces and of those at the rim looks, if they are there.
    enum class Looks { as_before, back, both };  // `both`: every face has one at its back
    Looks looks(std::size_t part, const PartMotion& motion) const;

    // The part is not where it was: what lies in its box now is another one.
    void set_gone(std::size_t part) { samples_[part].gone = true; }

    // The mesh's parts at the part's points after the motion, of each point.
    std::vector<std::uint32_t> parts_at(std::size_t part, const PartMotion& motion);

    // Whether the mesh's part is of another object than the stored one.
    bool differ(std::size_t part, std::uint32_t part_of_mesh) {
        return names_.differ(stored_.parts[part].object, all().parts[part_of_mesh].object);
    }

    // True if the motion puts the part where another one stayed, or into another object.
    bool is_taken(std::size_t part, const PartMotion& motion);

    // True if the motion puts most of the part where the old file had a part of another object, which is
    // there still: objects are copies of each other, but none becomes another.
    bool is_another_object(std::size_t part, const PartMotion& motion);

    // A part of equal tiles that lost some at its rim looks as if it had moved by a tile, but nothing of it
    // is at a new place.
    bool stays_inside(std::size_t part, const PartMotion& motion) const;

    // The box of the anchors after the motion.
    Aabb moved_box(std::size_t part, const PartMotion& motion) const;

    // Tiles may repeat at half their size in a subdivided part. So a part that was scaled must fill its new
    // box.
    bool fills_box(std::size_t part, const PartMotion& motion);

    // True if the motion's box of the part is nearly the box of the mesh's part there; `slack` as a fraction
    // of its diagonal.
    bool becomes_box(std::size_t part, const PartMotion& motion, double slack);

    // Whether the mesh has a part that fills nearly the same box: an edited part.
    bool has_similar_box(std::size_t part);

  private:
    struct Sample {
        std::vector<Vec3> points;
        std::vector<const FaceKey*> keys;
        bool gone = false;
    };
    enum class Side { none, same, other, both };

    double tolerance(const PartMotion& motion, const Vec3& from, const Vec3& to) const;
    std::uint32_t vertex_at(const Vec3& point, const PartMotion& motion) const;  // after it; or no_id
    double corners_hit(const Sample& sample, const PartMotion& motion, double least) const;
    Side find_face(const FaceKey& key, const PartMotion& motion, bool& same_material) const;

    const Mesh& mesh_;
    const FaceIndex& index_;
    SurfaceTable surfaces_;
    const PaintParts& stored_;
    PointGrid grid_;  // of the vertices
    const ObjectNames names_;
    std::vector<Sample> samples_;  // [part]
    std::optional<MeshParts> all_;
    std::vector<std::uint32_t> vertex_part_;  // [vertex] of the mesh
    std::vector<std::uint32_t> owner_;        // [part of the mesh] the stored part with its box, or no_id
};

}  // namespace slipface
