#include "face_matcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh_collision.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr std::size_t max_listed_orphans = 100;

}  // namespace

std::optional<SurfaceId> type_of(SurfaceTable surfaces, const std::string& name) {
    for (std::size_t i = 0; i < surfaces.size() && i < max_surface_types; ++i)
        if (surfaces[i].name == name) return static_cast<SurfaceId>(i);
    return std::nullopt;
}

FaceMatcher::FaceMatcher(const Mesh& mesh, SurfaceTable surfaces, const std::vector<StoredOverride>& stored,
                         FaceLookup& lookup, const PaintParts& parts, const std::vector<PartMotion>& motions)
    : mesh_(mesh),
      surfaces_(surfaces),
      stored_(stored),
      lookup_(lookup),
      index_(lookup.index),
      parts_(parts),
      motions_(motions),
      objects_(mesh, parts),
      unpainted_(static_cast<SurfaceId>(surfaces.size())),
      claims_(mesh.face_count()),
      found_(stored.size(), MatchStage::none),
      types_(stored.size()),
      bases_(stored.size()),
      twin_(stored.size(), false),
      lost_(stored.size(), false),
      doubtful_(stored.size(), false) {
    result_.overrides.resize(mesh.face_count());
    for (std::size_t i = 0; i < stored.size(); ++i) {
        types_[i] = stored[i].painted ? type_of(surfaces, stored[i].type) : unpainted_;
        bases_[i] = base_material(stored[i].key.material, surfaces);
    }
    const auto stays = [](const PartMotion& motion) {
        return motion.is_identity() && !motion.lost && !motion.guessed;
    };
    if (!std::all_of(motions.begin(), motions.end(), stays)) move();
    for (std::size_t i = 0; i < std::min(parts.guessed.size(), stored.size()); ++i)
        doubtful_[i] = doubtful_[i] || parts.guessed[i];
}

void FaceMatcher::move() {
    moved_ = stored_;
    for (std::size_t i = 0; i < stored_.size(); ++i) {
        const PartMotion* motion = motion_of(i);
        if (motion == nullptr) continue;
        lost_[i] = motion->lost;
        doubtful_[i] = motion->guessed;
        if (!motion->lost) moved_[i].key = moved_key(stored_[i].key, *motion);
    }
}

const PartMotion* FaceMatcher::motion_of(std::size_t i) const {
    const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
    return part > 0 && part <= motions_.size() ? &motions_[part - 1] : nullptr;
}

bool FaceMatcher::is_of_another_object(FaceId face, std::size_t i) const {
    const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
    return part > 0 && part <= parts_.parts.size() &&
           objects_.differ(parts_.parts[part - 1].object, objects_.of_group[mesh_.face_group[face]]);
}

// How far the face's mean of corners can be from where its part's motion puts it: by what rounding did to the
// part's other corners, and to the mean itself.
double FaceMatcher::slack(std::size_t i) const {
    constexpr double of_a_float = 1e-7, six_decimals = 2e-6;
    const PartMotion* const motion = motion_of(i);
    const double most = position_tolerance(key(i).centroid);
    if (motion == nullptr) return most;
    const double scale = motion->linear.colwise().norm().maxCoeff();
    return std::min(most, 4.0 * motion->rest + six_decimals +
                              of_a_float * (key(i).centroid.cwiseAbs().maxCoeff() +
                                            scale * stored_[i].key.centroid.cwiseAbs().maxCoeff()));
}

// How far it is at most, wherever the part's other corners are.
double FaceMatcher::wide_slack(std::size_t i) const {
    const PartMotion* const motion = motion_of(i);
    const double usual = position_tolerance(key(i).centroid);
    if (motion == nullptr || !std::isfinite(motion->rest)) return usual;
    return std::clamp(2.0 * motion->rest, usual, 4.0 * usual);
}

MatchedOverrides FaceMatcher::run() && {
    using Stage = MatchStage;
    run_stage(Stage::exact, [this](std::size_t i) { return match_hash(i, true); });
    run_stage(Stage::exact, [this](std::size_t i) { return match_hash(i, false); });
    run_stage(Stage::exact, [this](std::size_t i) { return match_location(i, slack(i)); });
    run_stage(Stage::exact, [this](std::size_t i) { return match_location(i, wide_slack(i)); });
    if (find_outlines() && lookup_.tree() != nullptr) {
        const std::vector<std::size_t> single = single_faces();
        run_stage(Stage::exact, [&](std::size_t i) {
            return std::binary_search(single.begin(), single.end(), i) && match_triangles(i);
        });
        run_stage(Stage::nearest, [this](std::size_t i) { return match_extruded(i); });
        if (has_as_many_faces())
            run_stage(Stage::nearest, [this](std::size_t i) { return match_corners(i); });
        match_covered(0.9, false);
        match_covered(0.5, false);
        run_stage(Stage::nearest, [this](std::size_t i) { return match_corners(i); });
        match_covered(0.9, true);
        run_stage(Stage::nearest, [this](std::size_t i) { return match_nearest(i); });
    }
    collect();
    return std::move(result_);
}

const MeshParts& FaceMatcher::pieces() {
    if (!pieces_) pieces_ = mesh_parts(mesh_);
    return *pieces_;
}

// As before: nothing was cut or merged.
bool FaceMatcher::has_as_many_faces() const {
    std::size_t before = 0;
    for (const PaintPart& part : parts_.parts)
        before += part.faces;
    return before == mesh_.face_count();
}

bool FaceMatcher::is_wanted(std::size_t i) const {
    return found_[i] == MatchStage::none && types_[i] && !lost_[i];
}

template <class Match>
void FaceMatcher::run_stage(MatchStage stage, Match match) {
    for (std::size_t i = 0; i < stored_.size() && lookup_.visits < max_visits; ++i)
        if (is_wanted(i) && match(i)) found_[i] = stage;
}

// Of the faces that are still wanted; false if there are none.
bool FaceMatcher::find_outlines() {
    outlines_.resize(stored_.size());
    likely_.resize(stored_.size(), false);
    bool wanted = false;
    for (std::size_t i = 0; i < stored_.size(); ++i) {
        if ((!is_wanted(i) && !twin_[i]) || stored_[i].key.normal.isZero()) continue;
        wanted = true;
        if (i >= parts_.outlines.count()) continue;
        outlines_[i] = parts_.outlines.corners(i, stored_[i].key);
        if (const PartMotion* motion = motion_of(i))
            for (Vec3& corner : outlines_[i])
                corner = (*motion)(corner);
    }
    return wanted;
}

double FaceMatcher::rounding(std::size_t i) const {
    const PartMotion* const motion = motion_of(i);
    const double scale = motion == nullptr ? 1.0 : motion->linear.colwise().norm().maxCoeff();
    return scale * parts_.outlines.rounding(i, stored_[i].key);
}

double FaceMatcher::corner_reach(std::size_t i) const {
    return rounding(i) + 2.0 * position_tolerance(key(i).centroid);
}

const CollisionWorld* FaceLookup::tree() {
    if (tree_) return &*tree_;
    Result<CollisionWorld> built = build_mesh_collision(mesh);
    if (built) tree_ = std::move(built).value();
    return tree_ ? &*tree_ : nullptr;
}

void FaceMatcher::claim(FaceId face, std::size_t i, MatchStage stage) {
    claims_[face] = stage;
    if (doubtful_[i]) result_.guessed.push_back(face);
    result_.overrides[face] = types_[i];
}

// Faces with a triangle in the box, of the key's material unless any will do; ascending. None of another
// object.
std::vector<FaceId> FaceMatcher::faces_in(std::size_t i, const Aabb& box, bool any_material,
                                          std::size_t& visits) const {
    std::vector<FaceId> faces;
    for (const TriangleId triangle : lookup_.tree()->triangles_in(box)) {
        ++visits;
        const FaceId face = lookup_.tree()->triangle_face(triangle);
        const bool known = !faces.empty() && faces.back() == face;
        if (!known && !is_of_another_object(face, i) && (any_material || index_.base(face) == bases_[i]))
            faces.push_back(face);
    }
    ++visits;
    return faces;
}

std::vector<FaceId> FaceMatcher::faces_around(std::size_t i, double reach, bool any_material) {
    const Vec3& centroid = key(i).centroid;
    Aabb box;
    box.add(centroid - Vec3::Constant(reach));
    box.add(centroid + Vec3::Constant(reach));
    return faces_in(i, box, any_material);
}

void FaceMatcher::collect() {
    for (std::size_t i = 0; i < stored_.size(); ++i) {
        if (!stored_[i].painted) continue;
        switch (found_[i]) {
            case MatchStage::exact: ++result_.summary.exact; break;
            case MatchStage::plane: ++result_.summary.by_plane; break;
            case MatchStage::nearest: ++result_.summary.by_nearest; break;
            case MatchStage::none: add_orphan(i); break;
        }
    }
    for (const auto& [face, rival] : rivals_)
        if (result_.overrides[face] != result_.overrides[rival]) result_.guessed.push_back(face);
    for (FaceId face = 0; face < claims_.size(); ++face)
        if (claims_[face] > MatchStage::exact) result_.guessed.push_back(face);
    for (std::optional<SurfaceId>& type : result_.overrides)
        if (type == unpainted_) type.reset();
    std::erase_if(result_.guessed, [&](FaceId face) { return !result_.overrides[face]; });
    std::sort(result_.guessed.begin(), result_.guessed.end());
    result_.guessed.erase(std::unique(result_.guessed.begin(), result_.guessed.end()), result_.guessed.end());
    if (result_.summary.orphaned > max_listed_orphans) {
        result_.warnings.push_back({"", fmt::format("{} more painted faces were not found",
                                                    result_.summary.orphaned - max_listed_orphans)});
    }
    if (lookup_.visits >= max_visits) {
        result_.warnings.push_back({"", "stopped the search for moved faces: too many faces have moved"});
    }
}

void FaceMatcher::add_orphan(std::size_t i) {
    const StoredOverride& stored = stored_[i];
    result_.orphans.push_back({stored.key, stored.type});
    if (++result_.summary.orphaned > max_listed_orphans) return;
    const Vec3& at = stored.key.centroid;
    const std::string reason = types_[i] ? "its face was not found" : "found no surface type of that name";
    result_.warnings.push_back(
        {stored.location, fmt::format("{}: a face painted \"{}\" at ({:.3f}, {:.3f}, {:.3f}), material "
                                      "\"{}\"; stored as an orphan",
                                      reason, stored.type, at.x(), at.y(), at.z(), stored.key.material)});
}

}  // namespace slipface
