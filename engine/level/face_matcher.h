// The search for painted faces in a changed mesh. match_overrides() says what each stage does.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "face_index.h"
#include "match_order.h"
#include "mesh_parts.h"
#include "slipface/collision/collision_world.h"

namespace slipface {

enum class MatchStage : std::uint8_t { none, exact, plane, nearest };

// Maximum number of faces examined in all, so that a file with a hundred thousand huge missing faces cannot
// hang the editor.
inline constexpr std::size_t max_visits = 30'000'000;

// Data built once for a mesh, for all sets of faces that are looked up in it.
struct FaceLookup {
    FaceLookup(const Mesh& of, SurfaceTable surfaces) : mesh(of), index(of, surfaces) {}

    // Built when it is first needed; null if the mesh has no tree.
    const CollisionWorld* tree();

    const Mesh& mesh;
    FaceIndex index;
    std::size_t visits = 0;  // faces examined so far

  private:
    std::optional<CollisionWorld> tree_;
};

class FaceMatcher {
  public:
    // `motions`: of the parts; without any, all faces are searched for where they were.
    FaceMatcher(const Mesh& mesh, SurfaceTable surfaces, const std::vector<StoredOverride>& stored,
                FaceLookup& lookup, const PaintParts& parts = {},
                const std::vector<PartMotion>& motions = {});

    // First of all: what is known is not searched for.
    void take(const FollowedFaces& followed);
    MatchedOverrides run() &&;

  private:
    // What the stages share
    const FaceKey& key(std::size_t i) const { return (moved_.empty() ? stored_ : moved_)[i].key; }
    bool is_wanted(std::size_t i) const;  // not found yet, and to be searched
    bool is_free(FaceId face) const { return claims_[face] == MatchStage::none; }
    // It is known that the face was elsewhere, and is no other than it was.
    bool moved_here(FaceId face) const { return !moved_here_.empty() && moved_here_[face]; }
    bool is_of_another_object(FaceId face, std::size_t i) const;
    void claim(FaceId face, std::size_t i, MatchStage stage);
    std::vector<FaceId> faces_in(std::size_t i, const Aabb& box, bool any_material,
                                 std::size_t& visits) const;
    std::vector<FaceId> faces_in(std::size_t i, const Aabb& box, bool any_material = false) {
        return faces_in(i, box, any_material, lookup_.visits);
    }
    std::vector<FaceId> faces_around(std::size_t i, double reach, bool any_material = false);
    std::vector<FaceId> faces_at_outline(std::size_t i);
    template <class Match>
    void run_stage(MatchStage stage, Match match);
    void move();
    bool has_as_many_faces() const;
    const PartMotion* motion_of(std::size_t i) const;
    double slack(std::size_t i) const;
    double wide_slack(std::size_t i) const;
    bool find_outlines();
    const MeshParts& pieces();
    double rounding(std::size_t i) const;      // of the outline's corners
    double corner_reach(std::size_t i) const;  // distance from a corner up to which it is that corner
    void collect();
    void add_orphan(std::size_t i);

    // match_exact.cpp
    bool match_hash(std::size_t i, bool own);
    // `misfit`: how far its mean of corners and its rim are from those of the stored face.
    struct Candidate {
        FaceId face;
        double misfit;
    };
    // `distance`: of the means.
    Candidate candidate(std::size_t i, FaceId face, double distance) const;
    bool match_location(std::size_t i, double slack);
    bool may_repeat(std::size_t i) const;
    void add_repeated(std::size_t i, double slack, std::vector<Candidate>& found);
    bool is_as_before(std::size_t i, FaceId face, double slack) const;
    bool claim_best(std::size_t i, const std::vector<Candidate>& faces);
    bool has_other_corners(std::size_t i, FaceId face) const;

    // match_triangles.cpp
    std::vector<std::size_t> single_faces() const;
    bool match_triangles(std::size_t i);

    // match_covered.cpp
    struct Cover {
        FaceId face;
        std::size_t i;
        double distance, area;
        bool flat;  // the face lies in the old one's plane
    };
    // Of one old face.
    struct Covers {
        std::vector<Cover> found;
        std::size_t visits = 0;
    };
    // `any_material`: a new face may also cover old ones of other materials than its own.
    void match_covered(double least_dot, bool any_material);
    bool lies_in_plane(FaceId face, std::size_t i) const;
    bool is_off_plane(FaceId face, const FaceKey& key) const;
    bool is_covered(std::size_t i) const;  // found so by new faces; others may cover it, too
    bool has_turned_over(std::size_t i);
    double area_to_cover(FaceId face, std::span<const Cover> covers);
    Covers find_covers(std::size_t i, double least_dot, bool any_material) const;

    // match_nearest.cpp
    std::vector<Vec3> edges_along(std::size_t i, const Vec3& normal);
    bool has_grown(FaceId face, std::size_t i) const;
    bool match_extruded(std::size_t i);
    std::size_t joined_corners(FaceId face, std::span<const Vec3> positions, double slack);
    bool match_corners(std::size_t i);
    bool match_nearest(std::size_t i);
    std::vector<Vec3> corners_left(std::size_t i);
    bool is_joined(FaceId face, std::span<const Vec3> corners);
    bool is_refused(FaceId face, std::size_t i) const;

    const Mesh& mesh_;
    SurfaceTable surfaces_;
    const std::vector<StoredOverride>& stored_;
    FaceLookup& lookup_;
    const FaceIndex& index_;
    const PaintParts& parts_;
    const std::vector<PartMotion>& motions_;
    const ObjectNames objects_;
    const SurfaceId unpainted_;                    // the type of stored faces that are not painted
    std::vector<StoredOverride> moved_;            // stored_ after the motions, or empty if all stayed
    std::vector<MatchStage> claims_;               // [face]
    std::vector<bool> moved_here_;                 // [face] FollowedFaces::moved
    std::vector<MatchStage> found_;                // [stored]
    std::vector<std::optional<SurfaceId>> types_;  // [stored]
    std::vector<std::string> bases_;               // [stored]
    std::vector<bool> twin_;  // [stored] another one was found at its place; there may be pieces of its own
    std::vector<std::vector<Vec3>> outlines_;  // [stored] after the motion; empty if it is not known
    std::vector<bool> likely_;                 // [stored] the outline is only a likely one
    std::vector<bool> turned_over_;            // [stored] an edit turned it over in its place
    std::vector<bool> lost_;                   // [stored] not to be searched: nothing found could be trusted
    std::vector<bool> doubtful_;               // [stored] what is found is a guess
    // Faces that match_covered() did not give the type of the stored one, sorted.
    std::vector<std::pair<FaceId, std::size_t>> refused_;
    // Faces found exactly, each with one that the stored face could have been as well.
    std::vector<std::pair<FaceId, FaceId>> rivals_;
    std::optional<MeshParts> pieces_;  // of the mesh, found when they are needed
    MatchedOverrides result_;
};

// The type of that name, if there is one.
std::optional<SurfaceId> type_of(SurfaceTable surfaces, const std::string& name);

inline Vec3 unit_or_zero(const Vec3& normal) {
    const double length = normal.norm();
    return length > 0.5 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

}  // namespace slipface
