// New faces of parts that an edit made of fewer faces, as decimating does. Many of them bridge what was
// there, in the plane of no old face: each has the type of the old faces that are nearest to most of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "face_matcher.h"
#include "part_support.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

constexpr double enough_points = 0.5;  // of a new face's points, for a type
// With fewer it loses a type that it has by plane, unless it lies in an old face's plane.
constexpr double few_points = 0.35;
constexpr double max_off = 0.5, max_metres = 0.5;  // from an old face: in its size, and in all
// Of the distance from its plane: what is farther outside is in another face's place.
constexpr double max_beside = 0.3;
constexpr double nearer = 0.9;       // of this distance: where a face is clearly nearer
constexpr std::size_t few_bent = 5;  // one of so many changed faces may be bent by other edits
constexpr double one_side = 0.5;     // the cosine of new and old normal

// How far a point is from a flat polygon, which may be concave.
struct Apart {
    double off = 0.0;     // before or behind its plane
    double beside = 0.0;  // seen along its normal; 0 inside
    double distance() const { return std::sqrt(off * off + beside * beside); }
};

Apart apart(const Vec3& point, std::span<const Vec3> polygon, const Vec3& normal) {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto seen = [&](const Vec3& corner) { return Vec2(u.dot(corner - point), v.dot(corner - point)); };
    bool inside = false;
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 here = seen(polygon.back());
    for (const Vec3& corner : polygon) {
        const Vec2 next = seen(corner), edge = next - here;
        const double share = std::clamp(-edge.dot(here) / std::max(edge.squaredNorm(), 1e-30), 0.0, 1.0);
        nearest = std::min(nearest, (here + share * edge).norm());
        if ((here.y() > 0.0) != (next.y() > 0.0) && here.x() - edge.x() * here.y() / edge.y() > 0.0)
            inside = !inside;
        here = next;
    }
    return {std::abs(normal.dot(point - polygon[0])), inside ? 0.0 : nearest};
}

struct Point {
    Vec3 at;
    double weight;
};

// Points of a face, each for as much of its area as its weight says.
std::vector<Point> spread_points(const Mesh& mesh, FaceId face) {
    constexpr int steps = 6;
    std::vector<Point> points;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        const Vec3 a = mesh.corner_position(mesh.triangles[t][0]).cast<double>();
        const Vec3 b = mesh.corner_position(mesh.triangles[t][1]).cast<double>() - a;
        const Vec3 c = mesh.corner_position(mesh.triangles[t][2]).cast<double>() - a;
        const double weight = b.cross(c).norm();
        // The middles of steps * steps small triangles.
        for (int i = 0; i < steps; ++i) {
            for (int k = 0; k < steps - i; ++k) {
                points.push_back({a + ((3 * i + 1) * b + (3 * k + 1) * c) / (3.0 * steps), weight});
                if (i + k + 1 < steps)
                    points.push_back({a + ((3 * i + 2) * b + (3 * k + 2) * c) / (3.0 * steps), weight});
            }
        }
    }
    return points;
}

}  // namespace

// Finds the parts that an edit made of fewer faces, some of them in other planes. Most of their painted faces
// of which a corner is gone have new faces in their place; of a part that only lost faces they have none.
// Returns these painted faces.
std::vector<std::size_t> FaceMatcher::find_merged_parts() {
    const MeshParts& pieces = this->pieces();
    struct Part {
        std::vector<std::uint32_t> pieces;  // of the mesh, in its place and with fewer faces
        // Painted faces of which a corner is gone, and those of them with new faces in other planes.
        std::size_t changed = 0, bent = 0;
    };
    std::vector<Part> parts(parts_.parts.size());
    std::vector<std::size_t> painted;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Aabb box = moved_box(i);
        for (std::uint32_t piece = 0; piece < pieces.parts.size(); ++piece)
            if (pieces.parts[piece].faces < parts_.parts[i].faces &&
                similar_box(pieces.parts[piece].box, box, remeshed_slack))
                parts[i].pieces.push_back(piece);
    }
    for (std::size_t i = 0; i < stored_.size() && lookup_.visits < max_visits; ++i) {
        if (!types_[i] || found_[i] == MatchStage::exact || outlines_[i].empty()) continue;
        if (unit_or_zero(key(i).normal).isZero()) continue;
        painted.push_back(i);
        const std::size_t part = i < parts_.of.size() ? parts_.of[i] : 0;
        if (part == 0 || part > parts.size() || parts[part - 1].pieces.empty() || likely_[i] ||
            corners_left(i).size() >= outlines_[i].size())
            continue;
        const bool replaced = found_[i] != MatchStage::none || lost_[i];
        const bool whole = flat_[i] == Flat::whole || flat_[i] == Flat::whole_in_few;
        parts[part - 1].changed += 1;
        parts[part - 1].bent += replaced && !whole ? 1 : 0;
    }
    std::vector<bool> merged(pieces.parts.size(), false);
    for (const Part& part : parts) {
        if (few_bent * part.bent <= part.changed) continue;
        for (const std::uint32_t piece : part.pieces)
            merged[piece] = true;
    }
    if (std::find(merged.begin(), merged.end(), true) == merged.end()) return {};
    merged_.resize(mesh_.face_count());
    for (FaceId face = 0; face < mesh_.face_count(); ++face)
        merged_[face] = merged[pieces.of[face]];
    return painted;
}

double FaceMatcher::reach_of(std::size_t i) const {
    return std::min(max_off * std::sqrt(key(i).area), max_metres) + position_tolerance(key(i).centroid);
}

// Whether another face than `face` is clearly nearer than the point to where that is on the old face.
bool FaceMatcher::is_nearer(std::size_t i, FaceId face, const Vec3& point, std::size_t& visits) const {
    const Vec3 normal = unit_or_zero(key(i).normal);
    const double off = normal.dot(point - key(i).centroid), reach = nearer * std::abs(off);
    if (reach <= position_tolerance(point)) return false;
    const Vec3 foot = point - off * normal, room = Vec3::Constant(reach);
    for (const TriangleId triangle : lookup_.tree()->triangles_in({foot - room, foot + room})) {
        ++visits;
        const FaceId other = lookup_.tree()->triangle_face(triangle);
        if (other == face || !(index_.key(other).normal.dot(normal) > one_side)) continue;
        std::array<Vec3, 3> corners;
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = mesh_.corner_position(mesh_.triangles[triangle][c]).cast<double>();
        const Vec3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if (across.norm() > 0.0 && apart(foot, corners, across.normalized()).distance() < reach) return true;
    }
    return false;
}

// What of the face is nearest to old faces of each type.
FaceMatcher::Votes FaceMatcher::votes_of(FaceId face, std::span<const std::size_t> old) const {
    Votes votes;
    std::vector<Apart> distances(old.size());
    for (const Point& point : spread_points(mesh_, face)) {
        votes.all += point.weight;
        votes.visits += old.size();
        Apart least{std::numeric_limits<double>::infinity(), 0.0};
        for (std::size_t k = 0; k < old.size(); ++k) {
            distances[k] = apart(point.at, outlines_[old[k]], unit_or_zero(key(old[k]).normal));
            if (distances[k].distance() < least.distance()) least = distances[k];
        }
        // Faces at one place share the point.
        std::vector<std::size_t> nearest;
        for (std::size_t k = 0; k < old.size(); ++k)
            if (distances[k].distance() <= least.distance() + position_tolerance(point.at))
                nearest.push_back(old[k]);
        const double share = point.weight / static_cast<double>(nearest.size());
        for (const std::size_t i : nearest) {
            const bool is_there = least.distance() <= reach_of(i) &&
                                  least.beside <= max_beside * least.off + position_tolerance(point.at);
            if (is_there && !is_nearer(i, face, point.at, votes.visits)) votes.of[*types_[i]] += share;
        }
    }
    return votes;
}

void FaceMatcher::match_merged() {
    const std::vector<std::size_t> painted = find_merged_parts();
    std::map<FaceId, std::vector<std::size_t>> near;
    for (const std::size_t i : painted) {
        if (lookup_.visits >= max_visits) break;
        const Vec3 normal = unit_or_zero(key(i).normal), room = Vec3::Constant(reach_of(i));
        Aabb box;
        for (const Vec3& corner : outlines_[i])
            box.add(corner);
        for (const FaceId face : faces_in(i, {box.min - room, box.max + room}, true))
            if (merged_[face] && claims_[face] != MatchStage::exact &&
                index_.key(face).normal.dot(normal) > one_side)
                near[face].push_back(i);
    }
    // What lies in the plane of an old face is decided.
    std::erase_if(near, [&](const auto& one) {
        return !is_free(one.first) && std::any_of(one.second.begin(), one.second.end(),
                                                  [&](std::size_t i) { return lies_in_plane(one.first, i); });
    });
    std::vector<FaceId> faces;
    for (const auto& [face, old] : near)
        faces.push_back(face);
    constexpr std::size_t at_once = 1024;  // then the work is counted
    std::vector<Votes> votes;
    for (std::size_t begin = 0; begin < faces.size() && lookup_.visits < max_visits; begin += at_once) {
        votes.assign(std::min(at_once, faces.size() - begin), {});
        parallel_for(votes.size(), 32, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                votes[k] = votes_of(faces[begin + k], near.at(faces[begin + k]));
        });
        for (std::size_t k = 0; k < votes.size(); ++k) {
            lookup_.visits += votes[k].visits;
            take_votes(faces[begin + k], votes[k]);
        }
    }
    // A painted face is found if a new one in its place has its type now.
    const auto shows = [&](FaceId face, std::size_t i) {
        return !is_free(face) && result_.overrides[face] == types_[i];
    };
    for (const auto& [face, old] : near)
        for (const std::size_t i : old)
            if (found_[i] == MatchStage::plane) found_[i] = MatchStage::none;
    for (const auto& [face, old] : near)
        for (const std::size_t i : old)
            if (found_[i] == MatchStage::none && shows(face, i)) found_[i] = MatchStage::plane;
    for (const auto& [face, i] : refused_)
        if (found_[i] == MatchStage::none && shows(face, i)) found_[i] = MatchStage::plane;
}

void FaceMatcher::take_votes(FaceId face, const Votes& votes) {
    for (const auto& [type, found] : votes.of) {
        if (found <= enough_points * votes.all) continue;
        claims_[face] = MatchStage::plane;
        result_.overrides[face] = type;
        return;
    }
    if (is_free(face)) return;
    const auto own = votes.of.find(*result_.overrides[face]);
    if (own != votes.of.end() && own->second > few_points * votes.all) return;
    claims_[face] = MatchStage::none;
    result_.overrides[face].reset();
}

}  // namespace slipface
