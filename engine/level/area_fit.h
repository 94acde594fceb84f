// Where painted faces went of which an edit left few corners, such as a floor that was decimated and turned:
// the rigid motion that puts most of their area onto faces in their planes and of their materials.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "face_matcher.h"

namespace slipface {

struct AreaMotion {
    PartMotion motion;
    double covered = 0.0;  // fraction of the painted area that lies on faces of the mesh
    double corners = 0.0;  // of the mesh's corners that lie on painted ones
};

class AreaFit {
  public:
    // All arguments must outlive it. `stored` as for find_motions().
    AreaFit(FaceLookup& lookup, SurfaceTable surfaces, const PaintParts& parts,
            const std::vector<StoredOverride>& stored);

    // The motions of `parts` together onto `places`, faces of the mesh: the one that covers most first, at
    // most a few. None if these faces have no planes.
    std::vector<AreaMotion> motions(std::span<const std::size_t> parts, std::span<const FaceId> places);

    // What of the parts' painted area lies on the mesh after the motion.
    double covered(std::span<const std::size_t> parts, const PartMotion& motion);

    // True if any more work is allowed. What is done here takes nothing from the stages that follow.
    bool may_search() const { return visits_ < max_area_visits && work_ < max_work; }

  private:
    static constexpr std::size_t max_work = 3'000'000'000;          // corners compared, about
    static constexpr std::size_t max_area_visits = max_visits / 2;  // faces examined

    struct Face {
        Vec3 centroid, normal;
        double area = 0.0;
        std::uint32_t material = 0;
    };
    // A point of a painted face.
    struct Sample {
        Vec3 point, normal;
        double size = 0.0, weight = 0.0;
        std::uint32_t material = 0;
    };
    struct Direction {
        Vec3 normal;
        double area = 0.0;
        std::map<std::uint32_t, double> of_material;
    };
    struct Plane {
        double offset, area;
        std::uint32_t material;
    };
    struct Side {  // the painted faces, or the mesh's
        std::vector<Face> faces;
        std::vector<Direction> directions;  // those of most area
        std::size_t kinds = 0;              // of directions
        std::vector<Vec3> corners;          // some of them; painted ones up to 1 % of their face's extent
        std::vector<Vec3> edges;            // some; as long as they are
    };

    std::uint32_t material(const std::string& base);
    void collect_old(std::span<const std::size_t> parts);
    void collect_new(std::span<const FaceId> places);
    std::vector<Sample> samples_of(std::span<const std::size_t> parts, std::size_t most) const;
    double covered(std::span<const Sample> samples, const PartMotion& motion, double least);
    FaceId face_under(const Sample& sample, const Vec3& point, const Vec3& normal);
    double box_room() const { return 0.02 * box_.size().norm(); }
    bool fits_box(const PartMotion& motion) const;
    double corners_met(const PartMotion& motion) const;
    PartMotion refined(std::span<const Sample> samples, PartMotion motion);

    // area_guess.cpp: motions to be tried
    static void find_directions(Side& side);
    std::vector<Eigen::Matrix3d> turns() const;
    std::vector<Eigen::Matrix3d> turns_of_pairs() const;
    std::vector<Eigen::Matrix3d> turns_of_edges(const Vec3& old_normal, const Vec3& new_normal) const;
    double shared_area(const Eigen::Matrix3d& turn) const;
    std::vector<Vec3> offsets(const Eigen::Matrix3d& turn) const;
    std::vector<Vec3> offsets_of_planes(const Eigen::Matrix3d& turn, const Vec3 (&normals)[3]) const;
    std::vector<Vec3> offsets_of_corners(const Eigen::Matrix3d& turn) const;
    static std::vector<Plane> planes(const Side& side, const Vec3& normal, double slack);

    FaceLookup& lookup_;
    const Mesh& mesh_;
    const FaceIndex& index_;
    const PaintParts& parts_;
    const std::vector<StoredOverride>& stored_;
    SurfaceTable surfaces_;
    std::map<std::string, std::uint32_t> materials_;   // [base material]
    std::vector<std::uint32_t> of_mesh_;               // [material of the mesh]
    std::vector<std::vector<std::uint32_t>> painted_;  // [part] its members of stored_
    std::vector<bool> is_place_;                       // [face]
    Side old_, new_;
    std::vector<Vec3> exact_;  // some of the parts' corners
    Aabb box_;                 // of the parts
    std::size_t work_ = 0, visits_ = 0;
    double face_size_ = 0.0;
    double slack_ = 0.0;  // units: how far a corner is from where it was, up to rounding
};

}  // namespace slipface
