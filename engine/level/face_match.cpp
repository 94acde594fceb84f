#include "face_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "face_cover.h"
#include "face_index.h"
#include "face_union.h"
#include "mesh_collision.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

enum class Stage : std::uint8_t { none, exact, plane, nearest };

// Maximum number of faces examined in all, so that a file with a hundred thousand huge missing faces cannot
// hang the editor.
constexpr std::size_t max_visits = 30'000'000;
constexpr std::size_t max_listed_orphans = 100;

// A part is smaller than this fraction of the old face; all parts together are at most the second fraction.
constexpr double part_fraction = 0.99;
constexpr double whole_fraction = 1.01;

constexpr double max_sideways = 0.45;  // of the nearest face's centre, as a fraction of the old face's size
constexpr double max_bent_area = 1.2;  // of the parts of a bent face, as a fraction of its vector's length

// A face in the plane of an old one, up to this fraction of its area and with nearly its centre, is that face
// with another outline.
constexpr double merged_fraction = 1.5;
constexpr double same_centre = 0.1;  // as a fraction of its size

constexpr double moved_centre = 0.3;      // by lost corners on straight edges
constexpr double filled_fraction = 0.35;  // of an old face by the new ones that it is to give its type to
constexpr double more_than_half = 0.52;   // of a new face

Vec3 unit_or_zero(const Vec3& normal) {
    const double length = normal.norm();
    return length > 0.5 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

bool same_plane_direction(const Vec3& a, const Vec3& b) {
    if (a.isZero() || b.isZero()) return a.isZero() && b.isZero();
    return a.dot(b) > 0.999;
}

// Data built once for a mesh, for all sets of faces that are looked up in it.
struct Lookup {
    Lookup(const Mesh& mesh, SurfaceTable surfaces) : index(mesh, surfaces) {}

    FaceIndex index;
    std::optional<CollisionWorld> tree;  // built if a face is not found exactly
    FaceNeighbours neighbours;           // built if match_union() needs them
    std::size_t visits = 0;              // faces examined so far
};

class Matcher {
  public:
    Matcher(const Mesh& mesh, SurfaceTable surfaces, const std::vector<StoredOverride>& stored,
            Lookup& lookup, std::vector<bool> lost = {}, std::vector<bool> doubtful = {})
        : mesh_(mesh),
          surfaces_(surfaces),
          stored_(stored),
          lookup_(lookup),
          index_(lookup.index),
          claims_(mesh.face_count()),
          found_(stored.size(), Stage::none),
          types_(stored.size()),
          bases_(stored.size()),
          lost_(std::move(lost)),
          doubtful_(std::move(doubtful)) {
        lost_.resize(stored.size(), false);
        doubtful_.resize(stored.size(), false);
        result_.overrides.resize(mesh.face_count());
        for (std::size_t i = 0; i < stored.size(); ++i) {
            types_[i] = type_of(stored[i].type);
            bases_[i] = base_material(stored[i].key.material, surfaces);
        }
    }

    MatchedOverrides run() && {
        run_stage(Stage::exact, [this](std::size_t i) { return match_hash(i); });
        run_stage(Stage::exact, [this](std::size_t i) { return match_location(i); });
        if (has_unmatched() && build_tree()) {
            run_stage(Stage::plane, [this](std::size_t i) { return match_plane(i); });
            run_stage(Stage::plane, [this](std::size_t i) { return match_union(i, false); });
            run_stage(Stage::plane, [this](std::size_t i) { return match_union(i, true); });
            run_stage(Stage::plane, [this](std::size_t i) { return match_area(i); });
            match_covered();
            run_stage(Stage::nearest, [this](std::size_t i) { return match_nearest(i); });
        }
        collect();
        return std::move(result_);
    }

  private:
    std::optional<SurfaceId> type_of(const std::string& name) const {
        for (std::size_t i = 0; i < surfaces_.size() && i < max_surface_types; ++i) {
            if (surfaces_[i].name == name) return static_cast<SurfaceId>(i);
        }
        return std::nullopt;
    }

    template <class Match>
    void run_stage(Stage stage, Match match) {
        for (std::size_t i = 0; i < stored_.size() && lookup_.visits < max_visits; ++i) {
            if (found_[i] == Stage::none && types_[i] && !is_lost(i) && match(i)) found_[i] = stage;
        }
    }

    bool is_lost(std::size_t i) const { return lost_[i]; }

    bool has_unmatched() const {
        for (std::size_t i = 0; i < stored_.size(); ++i) {
            if (found_[i] == Stage::none && types_[i] && !is_lost(i) && !stored_[i].key.normal.isZero())
                return true;
        }
        return false;
    }

    bool build_tree() {
        if (lookup_.tree) return true;
        Result<CollisionWorld> built = build_mesh_collision(mesh_);
        if (!built) return false;
        lookup_.tree = std::move(built).value();
        return true;
    }

    bool is_free(FaceId face) const { return claims_[face] == Stage::none; }

    void claim(FaceId face, std::size_t i, Stage stage) {
        claims_[face] = stage;
        if (doubtful_[i]) result_.guessed.push_back(face);
        result_.overrides[face] = types_[i];
    }

    bool match_hash(std::size_t i) {
        const FaceKey& key = stored_[i].key;
        if (key.loop_hash == 0) return false;  // a moved key
        std::vector<FaceId> faces = index_.with_hash(key.loop_hash);
        lookup_.visits += faces.size() + 1;
        const double tolerance = position_tolerance(key.centroid);
        std::erase_if(faces, [&](FaceId face) {
            return (index_.key(face).centroid - key.centroid).norm() > tolerance;
        });
        for (const FaceId face : faces) {
            if (index_.key(face).material != key.material || index_.key(face).copy != key.copy) continue;
            if (!is_free(face)) return result_.overrides[face] == types_[i];
            claim(face, i, Stage::exact);
            return true;
        }
        return claim_best(i, faces);
    }

    bool match_location(std::size_t i) {
        const FaceKey& key = stored_[i].key;
        const double tolerance = position_tolerance(key.centroid);
        std::vector<FaceId> faces = index_.near(key.centroid, tolerance);
        lookup_.visits += faces.size() + 1;
        const Vec3 normal = unit_or_zero(key.normal);
        std::erase_if(faces, [&](FaceId face) {
            if (index_.is_sliver(face, tolerance)) return false;
            const double area = index_.key(face).area;
            return !same_plane_direction(unit_or_zero(index_.key(face).normal), normal) ||
                   std::abs(area - key.area) > 0.02 * std::max(area, key.area);
        });
        return claim_best(i, faces);
    }

    // Claims the best free face of `faces`: the same material before the same base name before any other,
    // then the nearest, then the lowest index.
    bool claim_best(std::size_t i, const std::vector<FaceId>& faces) {
        const FaceKey& key = stored_[i].key;
        FaceId best = no_id;
        int best_rank = 0;
        double best_distance = 0.0;
        for (const FaceId face : faces) {
            if (!is_free(face)) continue;
            const int rank = index_.key(face).material == key.material ? 0
                             : index_.base(face) == bases_[i]          ? 1
                                                                       : 2;
            const double distance = (index_.key(face).centroid - key.centroid).norm();
            if (best == no_id || rank < best_rank || (rank == best_rank && distance < best_distance)) {
                best = face;
                best_rank = rank;
                best_distance = distance;
            }
        }
        if (best == no_id) return false;
        claim(best, i, Stage::exact);
        return true;
    }

    // Faces of the key's material with a triangle in the box of half size `reach` around the key's centroid,
    // ascending.
    std::vector<FaceId> faces_around(std::size_t i, double reach) {
        const Vec3& centroid = stored_[i].key.centroid;
        Aabb box;
        box.add(centroid - Vec3::Constant(reach));
        box.add(centroid + Vec3::Constant(reach));
        std::vector<FaceId> faces;
        for (const TriangleId triangle : lookup_.tree->triangles_in(box)) {
            ++lookup_.visits;
            const FaceId face = lookup_.tree->triangle_face(triangle);
            if ((faces.empty() || faces.back() != face) && index_.base(face) == bases_[i])
                faces.push_back(face);
        }
        ++lookup_.visits;
        return faces;
    }

    bool match_plane(std::size_t i) {
        const FaceKey& key = stored_[i].key;
        const Vec3 normal = unit_or_zero(key.normal);
        if (normal.isZero() || !(key.area > 0.0)) return false;
        const double size = std::sqrt(key.area);
        const double tolerance = position_tolerance(key.centroid);

        struct Part {
            double distance;
            FaceId face;
        };
        std::vector<Part> parts;
        for (const FaceId face : faces_around(i, size + tolerance)) {
            const bool shared = claims_[face] == Stage::plane && result_.overrides[face] == types_[i];
            if (!is_free(face) && !shared) continue;
            const FaceKey& candidate = index_.key(face);
            if (candidate.normal.dot(normal) < 0.99) continue;
            const Vec3 candidate_normal = face_normal(mesh_, face);
            if (!(candidate_normal.dot(normal) > 0.999)) continue;
            const Vec3 offset = candidate.centroid - key.centroid;
            if (std::abs(candidate_normal.dot(offset)) > 1e-3 * size + tolerance) continue;
            if (candidate.area >= part_fraction * key.area) {
                if (!index_.covers(face, key.centroid, normal)) continue;
                // One of several that a larger face may cover.
                if (candidate.area > merged_fraction * key.area || offset.norm() > same_centre * size)
                    return false;
                claim(face, i, Stage::plane);
                return true;
            }
            if (offset.norm() <= size) parts.push_back({offset.norm(), face});
        }
        std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
            return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
        });
        double area = 0.0;
        std::vector<FaceId> faces;
        for (const Part& part : parts) {
            area += index_.key(part.face).area;
            if (area > whole_fraction * key.area) return false;
            faces.push_back(part.face);
            if (area < part_fraction * key.area) continue;
            if (!has_middle(mesh_, key, faces) || !cover_middle(index_, key, normal, faces)) return false;
            for (const FaceId face : faces)
                claim(face, i, Stage::plane);
            return true;
        }
        return false;
    }

    // A face that lost corners on straight edges has another mean of corners, which may lie outside of it. It
    // is the only face of that area in the plane around.
    bool match_area(std::size_t i) {
        const FaceKey& key = stored_[i].key;
        const Vec3 normal = unit_or_zero(key.normal);
        if (normal.isZero() || !(key.area > 0.0)) return false;
        const double size = std::sqrt(key.area);
        FaceId best = no_id;
        for (const FaceId face : faces_around(i, size)) {
            const FaceKey& candidate = index_.key(face);
            if (std::abs(candidate.area - key.area) > 1e-3 * key.area ||
                candidate.normal.dot(normal) < 0.999 ||
                std::abs(normal.dot(candidate.centroid - key.centroid)) > 1e-3 * size)
                continue;
            if (best != no_id) return false;
            best = face;
        }
        if (best == no_id || !is_free(best)) return false;
        if ((index_.key(best).centroid - key.centroid).norm() > moved_centre * size) return false;
        claim(best, i, Stage::plane);
        return true;
    }

    // New faces that cover several old ones, or parts of them. Each has the type of most of its area; old
    // faces of which most is covered by other types are left for the user.
    void match_covered() {
        struct Cover {
            FaceId face;
            std::size_t i;
            bool inside, same_face;
            double area;
        };
        std::vector<Cover> all;
        for (std::size_t i = 0; i < stored_.size() && lookup_.visits < max_visits; ++i) {
            const FaceKey& key = stored_[i].key;
            if (found_[i] != Stage::none || !types_[i] || is_lost(i) || !(key.area > 0.0)) continue;
            const double size = std::sqrt(key.area);
            const Vec3 normal = unit_or_zero(key.normal);
            for (const FaceId face : faces_around(i, size)) {
                const FaceKey& candidate = index_.key(face);
                const double least = candidate.area < small_fraction * key.area ? 0.97 : 0.9;
                if (!is_free(face) || !(candidate.normal.dot(normal) > least)) continue;
                // A tilted face leaves the plane; a parallel one off it is another face.
                const double tilt = candidate.normal.cross(normal).norm();
                const double off = std::abs(candidate.normal.dot(candidate.centroid - key.centroid));
                if (off > (0.02 + 0.7 * tilt) * size) continue;
                const bool inside = index_.covers(face, key.centroid, candidate.normal);
                lookup_.visits += mesh_.face_corner_count(face);
                // Of a long face, which no square is like, the key says too little.
                const bool same_face = inside && candidate.area > 0.5 * key.area &&
                                       candidate.area < 1.5 * key.area &&
                                       (candidate.centroid - key.centroid).norm() < 0.15 * size;
                all.push_back({face, i, inside, same_face, 0.0});
            }
        }
        std::stable_sort(all.begin(), all.end(),
                         [](const Cover& a, const Cover& b) { return a.face < b.face; });
        std::vector<double> total(stored_.size(), 0.0);
        const auto each_face = [&](const auto& apply) {
            for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
                for (end = begin; end < all.size() && all[end].face == all[begin].face;)
                    ++end;
                apply(std::span(all).subspan(begin, end - begin));
            }
        };
        each_face([&](std::span<Cover> covers) {
            std::vector<OldFace> old;
            for (const Cover& cover : covers)
                old.push_back({&stored_[cover.i].key, cover.inside});
            const std::vector<double> areas = covered_areas(mesh_, covers[0].face, old);
            for (std::size_t k = 0; k < covers.size(); ++k) {
                covers[k].area = areas[k];
                total[covers[k].i] += areas[k];
            }
        });
        // Of an old face whose square holds little of the new faces, the outline is another, or it is gone.
        const auto is_square = [&](std::size_t i) {
            return total[i] >= filled_fraction * stored_[i].key.area;
        };
        each_face([&](std::span<Cover> covers) {
            const FaceId face = covers[0].face;
            std::map<SurfaceId, double> shares;
            for (const Cover& cover : covers)
                if (is_square(cover.i)) shares[*types_[cover.i]] += cover.area;
            for (const auto& [type, share] : shares) {
                if (share <= more_than_half * index_.key(face).area) continue;
                claims_[face] = Stage::plane;
                result_.overrides[face] = type;
            }
        });
        for (const Cover& cover : all) {
            if (cover.inside && result_.overrides[cover.face] == types_[cover.i])
                found_[cover.i] = Stage::plane;
            else if (cover.inside && !is_free(cover.face))
                lost_[cover.i] = true;
            if (!cover.same_face && is_square(cover.i)) refused_.push_back({cover.face, cover.i});
        }
        std::sort(refused_.begin(), refused_.end());
    }

    // A long face that was cut into parts, whose centres are too far away for match_plane(): connected faces
    // in its plane that together have its area and the mean of its corners. Starts at the faces at its
    // centre; the number of attempts is limited. `bent`: the parts of a bent face, which lie near its plane
    // and have its vector of area, because that depends on the outline alone.
    bool match_union(std::size_t i, bool bent) {
        const FaceKey& key = stored_[i].key;
        const Vec3 normal = unit_or_zero(key.normal);
        if (normal.isZero() || !(key.area > 0.0)) return false;
        FaceNeighbours& neighbours = lookup_.neighbours;
        if (neighbours.first.empty()) neighbours = face_neighbours(mesh_);
        bent_ = bent;
        const double reach = plane_slack() * std::sqrt(key.area) + position_tolerance(key.centroid);
        union_visits_ = 0;
        for (const FaceId face : faces_around(i, reach)) {
            std::vector<FaceId> parts;
            if (!grow_union(key, normal, face, parts)) continue;
            for (const FaceId part : parts)
                claim(part, i, Stage::plane);
            return true;
        }
        return false;
    }

    // Adds `face` and further neighbours to the parts until they are complete; if that fails, removes it.
    bool grow_union(const FaceKey& key, const Vec3& normal, FaceId face, std::vector<FaceId>& parts) {
        const std::size_t max_parts = bent_ ? 6 : 12;
        const std::size_t max_tries = bent_ ? 300 : 2000;
        if (parts.size() == max_parts || ++union_visits_ > max_tries || !is_part(key, normal, face))
            return false;
        ++lookup_.visits;
        parts.push_back(face);
        double area = 0.0;
        for (const FaceId part : parts)
            area += index_.key(part).area;
        if (area >= part_fraction * key.area &&
            (bent_ ? has_area_vector(index_, key, parts) : area <= whole_fraction * key.area) &&
            has_corner_mean(mesh_, key, parts, bent_ ? bent_mean_slack : mean_slack))
            return true;
        if (area < (bent_ ? max_bent_area : part_fraction) * key.area) {
            for (std::size_t k = 0; k < parts.size(); ++k) {
                for (const FaceId next : lookup_.neighbours.of(parts[k])) {
                    if (std::find(parts.begin(), parts.end(), next) == parts.end() &&
                        grow_union(key, normal, next, parts))
                        return true;
                }
            }
        }
        parts.pop_back();
        return false;
    }

    bool is_part(const FaceKey& key, const Vec3& normal, FaceId face) const {
        const FaceKey& candidate = index_.key(face);
        // Around a bent face nearly every neighbour could be a part; only near ones are tried.
        if (bent_ && (candidate.centroid - key.centroid).norm() > 0.7 * std::sqrt(key.area)) return false;
        return is_free(face) && index_.base(face) == base_material(key.material, surfaces_) &&
               candidate.normal.dot(normal) > (bent_ ? 0.8 : 0.999) &&
               std::abs(normal.dot(candidate.centroid - key.centroid)) <=
                   plane_slack() * std::sqrt(key.area) + position_tolerance(key.centroid);
    }

    double plane_slack() const { return bent_ ? 0.2 : 1e-3; }

    bool is_refused(FaceId face, std::size_t i) const {
        return std::binary_search(refused_.begin(), refused_.end(), std::pair{face, i});
    }

    bool match_nearest(std::size_t i) {
        const FaceKey& key = stored_[i].key;
        const Vec3 normal = unit_or_zero(key.normal);
        if (normal.isZero() || !(key.area > 0.0)) return false;
        const double size = std::sqrt(key.area);
        FaceId best = no_id;
        double best_distance = 0.0;
        for (const FaceId face : faces_around(i, size)) {
            const FaceKey& candidate = index_.key(face);
            const double distance = (candidate.centroid - key.centroid).norm();
            const bool similar = candidate.area > 0.25 * key.area && candidate.area < 4.0 * key.area &&
                                 candidate.normal.dot(normal) > 0.9 && distance <= size;
            if (!is_free(face) || is_refused(face, i) || !similar ||
                (best != no_id && distance >= best_distance))
                continue;
            // A face that moved straight along its normal need not cover the centre: it may be concave.
            const Vec3 offset = candidate.centroid - key.centroid;
            const double sideways = (offset - normal.dot(offset) * normal).norm();
            if (sideways > 0.02 * size && !index_.covers(face, key.centroid, normal)) continue;
            if (sideways > max_sideways * size) continue;  // more of it is where a neighbour was
            best = face;
            best_distance = distance;
        }
        if (best == no_id) return false;
        claim(best, i, Stage::nearest);
        return true;
    }

    void collect() {
        for (std::size_t i = 0; i < stored_.size(); ++i) {
            switch (found_[i]) {
                case Stage::exact: ++result_.summary.exact; break;
                case Stage::plane: ++result_.summary.by_plane; break;
                case Stage::nearest: ++result_.summary.by_nearest; break;
                case Stage::none: add_orphan(i); break;
            }
        }
        for (FaceId face = 0; face < claims_.size(); ++face)
            if (claims_[face] > Stage::exact) result_.guessed.push_back(face);
        std::sort(result_.guessed.begin(), result_.guessed.end());
        result_.guessed.erase(std::unique(result_.guessed.begin(), result_.guessed.end()),
                              result_.guessed.end());
        if (result_.summary.orphaned > max_listed_orphans) {
            result_.warnings.push_back({"", fmt::format("{} more painted faces were not found",
                                                        result_.summary.orphaned - max_listed_orphans)});
        }
        if (lookup_.visits >= max_visits) {
            result_.warnings.push_back({"", "stopped the search for moved faces: too many faces have moved"});
        }
    }

    void add_orphan(std::size_t i) {
        const StoredOverride& stored = stored_[i];
        result_.orphans.push_back({stored.key, stored.type});
        if (++result_.summary.orphaned > max_listed_orphans) return;
        const Vec3& at = stored.key.centroid;
        const std::string reason =
            types_[i] ? "its face was not found" : "found no surface type of that name";
        result_.warnings.push_back(
            {stored.location, fmt::format("{}: a face painted \"{}\" at ({:.3f}, {:.3f}, {:.3f}), material "
                                          "\"{}\"; stored as an orphan",
                                          reason, stored.type, at.x(), at.y(), at.z(), stored.key.material)});
    }

    const Mesh& mesh_;
    SurfaceTable surfaces_;
    const std::vector<StoredOverride>& stored_;
    Lookup& lookup_;
    const FaceIndex& index_;
    std::vector<Stage> claims_;                    // [face]
    std::vector<Stage> found_;                     // [stored]
    std::vector<std::optional<SurfaceId>> types_;  // [stored]
    std::vector<std::string> bases_;               // [stored]
    std::vector<bool> lost_;      // [stored] not to be searched: nothing found could be trusted
    std::vector<bool> doubtful_;  // [stored] what is found is a guess
    // Faces that match_covered() did not give the type of the stored one, sorted.
    std::vector<std::pair<FaceId, std::size_t>> refused_;
    std::size_t union_visits_ = 0;
    bool bent_ = false;  // what match_union() looks for
    MatchedOverrides result_;
};

}  // namespace

std::vector<StoredOverride> stored_overrides(const Level& level, PaintParts& parts) {
    std::vector<FaceId> faces;
    for (std::size_t face = 0; face < level.overrides.size(); ++face) {
        const std::optional<SurfaceId>& surface = level.overrides[face];
        if (surface && *surface < level.surfaces.size()) faces.push_back(static_cast<FaceId>(face));
    }
    const Mesh& mesh = mesh_with(level, faces);
    parts = paint_parts(mesh, level.surfaces, faces);
    std::vector<StoredOverride> stored;
    stored.reserve(faces.size() + level.orphans.size());
    std::vector<FaceKey> keys = face_keys(mesh, faces);
    for (std::size_t i = 0; i < faces.size(); ++i)
        stored.push_back({std::move(keys[i]), level.surfaces[*level.overrides[faces[i]]].name, {}});
    for (const Orphan& orphan : level.orphans)
        stored.push_back({orphan.key, orphan.type, {}});
    return stored;
}

const Mesh& mesh_with(const Level& level, std::span<const FaceId> faces) {
    const Mesh& own = *own_mesh(level);
    return faces.empty() || faces.back() < own.face_count() ? own : *level.mesh;
}

MatchedOverrides match_overrides(const Level& level, const std::vector<StoredOverride>& stored,
                                 const PaintParts& parts) {
    // Faces of props may be like faces of the level that a part could have moved to.
    const bool all_own =
        !has_instances(level) ||
        match_overrides(*own_mesh(level), level.surfaces, stored, {}).summary.exact == stored.size();
    if (all_own) return match_overrides(*own_mesh(level), level.surfaces, stored, parts);
    MatchedOverrides all = match_overrides(*level.mesh, level.surfaces, stored, parts);
    while (all.overrides.size() > own_mesh(level)->face_count() && !all.overrides.back())
        all.overrides.pop_back();
    return all;
}

MatchedOverrides match_overrides(const Mesh& mesh, SurfaceTable surfaces,
                                 const std::vector<StoredOverride>& stored, const PaintParts& parts) {
    if (stored.empty()) {
        MatchedOverrides result;
        result.overrides.resize(mesh.face_count());
        return result;
    }
    Lookup lookup(mesh, surfaces);
    if (parts.parts.empty()) return Matcher(mesh, surfaces, stored, lookup).run();
    const std::vector<PartMotion> motions = find_motions(mesh, lookup.index, surfaces, parts, stored);
    const auto stays = [](const PartMotion& motion) {
        return motion.is_identity() && !motion.lost && !motion.guessed;
    };
    if (std::all_of(motions.begin(), motions.end(), stays))
        return Matcher(mesh, surfaces, stored, lookup).run();
    std::vector<StoredOverride> moved = stored;
    std::vector<bool> lost(stored.size(), false), doubtful(stored.size(), false);
    for (std::size_t i = 0; i < parts.of.size() && i < stored.size(); ++i) {
        if (parts.of[i] == 0 || parts.of[i] > motions.size()) continue;
        const PartMotion& motion = motions[parts.of[i] - 1u];
        if (motion.lost)
            lost[i] = true;
        else
            moved[i].key = moved_key(moved[i].key, motion);
        doubtful[i] = motion.guessed;
    }
    return Matcher(mesh, surfaces, moved, lookup, std::move(lost), std::move(doubtful)).run();
}

FaceKeySets stored_face_keys(const Level& level) {
    // Keys of all sets at once, because numbering the copies examines the whole mesh.
    std::vector<FaceId> faces = level.hidden;
    for (const SavedSelection& saved : level.selections)
        faces.insert(faces.end(), saved.faces.begin(), saved.faces.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    faces.erase(std::lower_bound(faces.begin(), faces.end(), level.mesh.face_count()), faces.end());
    const std::vector<FaceKey> keys =
        faces.empty() ? std::vector<FaceKey>() : face_keys(mesh_with(level, faces), faces);
    const auto of = [&](const std::vector<FaceId>& set) {
        std::vector<FaceKey> result;
        result.reserve(set.size());
        for (const FaceId face : set) {
            const auto found = std::lower_bound(faces.begin(), faces.end(), face);
            if (found != faces.end() && *found == face)
                result.push_back(keys[static_cast<std::size_t>(found - faces.begin())]);
        }
        return result;
    };
    FaceKeySets sets{of(level.hidden)};
    for (const SavedSelection& saved : level.selections)
        sets.push_back(of(saved.faces));
    return sets;
}

Warnings match_stored_faces(Level& level, const FaceKeySets& sets) {
    level.hidden.clear();
    for (SavedSelection& saved : level.selections)
        saved.faces.clear();
    Warnings warnings;
    std::optional<Lookup> in_own, in_whole;
    const auto find = [&](const Mesh& mesh, std::optional<Lookup>& lookup,
                          const std::vector<StoredOverride>& stored) {
        if (!lookup) lookup.emplace(mesh, level.surfaces);
        return Matcher(mesh, level.surfaces, stored, *lookup).run();
    };
    for (std::size_t i = 0; i < sets.size() && i <= level.selections.size(); ++i) {
        if (sets[i].empty()) continue;
        std::vector<StoredOverride> stored;
        stored.reserve(sets[i].size());
        for (const FaceKey& key : sets[i])
            stored.push_back({key, level.surfaces.front().name, {}});  // any type, the same for all
        MatchedOverrides matched = find(*own_mesh(level), in_own, stored);
        if (has_instances(level) && matched.summary.exact < stored.size())
            matched = find(*level.mesh, in_whole, stored);
        std::vector<FaceId>& faces = i == 0 ? level.hidden : level.selections[i - 1].faces;
        for (FaceId face = 0; face < matched.overrides.size(); ++face)
            if (matched.overrides[face]) faces.push_back(face);
        if (matched.orphans.empty()) continue;
        const std::string set = i == 0 ? std::string("hidden")
                                       : fmt::format("of the selection \"{}\"", level.selections[i - 1].name);
        warnings.push_back({"", fmt::format("{} of the {} faces {} no longer exist; they are dropped",
                                            matched.orphans.size(), sets[i].size(), set)});
    }
    return warnings;
}

}  // namespace slipface
