#include "document/faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "slipface/base/parallel.h"

namespace slipface {
namespace {

// Faces that were modelled flat deviate by up to about this angle in float coordinates, radians.
constexpr double flat_tolerance = 1e-4;

double squared_distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length2 = along.squaredNorm();
    const double fraction = length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (point - (a + fraction * along)).squaredNorm();
}

double squared_distance_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = (b - a).cross(c - a);
    const double length2 = normal.squaredNorm();
    const bool above = length2 > 0.0 && normal.dot((b - a).cross(point - a)) >= 0.0 &&
                       normal.dot((c - b).cross(point - b)) >= 0.0 &&
                       normal.dot((a - c).cross(point - c)) >= 0.0;
    if (above) {
        const double height = normal.dot(point - a);
        return height * height / length2;
    }
    return std::min({squared_distance_to_segment(point, a, b), squared_distance_to_segment(point, b, c),
                     squared_distance_to_segment(point, c, a)});
}

bool face_within(const Mesh& mesh, FaceId face, const Vec3& centre, double radius) {
    const double radius2 = radius * radius;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        const auto& corners = mesh.triangles[t];
        const auto corner = [&](std::size_t i) {
            return Vec3(mesh.corner_position(corners[i]).cast<double>());
        };
        if (squared_distance_to_triangle(centre, corner(0), corner(1), corner(2)) <= radius2) return true;
    }
    return false;
}

}  // namespace

AngleLimit::AngleLimit(double max_angle)
    : acute_(max_angle < 0.5 * std::numbers::pi),
      none_(!(max_angle >= 0.0)),
      sine2_(std::sin(std::min(max_angle, std::numbers::pi)) *
             std::sin(std::min(max_angle, std::numbers::pi))),
      certain_(acute_ && !none_ ? static_cast<float>(std::cos(max_angle)) + 1e-5f : 2.0f) {}

FaceFacts face_facts(const Mesh& mesh) {
    FaceFacts facts;
    facts.normal.resize(mesh.face_count());
    facts.area.resize(mesh.face_count());
    constexpr std::size_t grain = 4096;
    parallel_for(mesh.face_count(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto face = static_cast<FaceId>(i);
            facts.normal[i] = face_normal(mesh, face).cast<float>();
            facts.area[i] = static_cast<float>(face_area(mesh, face));
        }
    });
    facts.some_without_area = std::any_of(facts.normal.begin(), facts.normal.end(),
                                          [](const Vec3f& normal) { return normal.isZero(0.0f); });
    return facts;
}

std::vector<FaceId> marked_faces(std::span<const std::uint8_t> marks) {
    std::size_t count = 0;
    for (const std::uint8_t mark : marks)
        count += mark != 0 ? 1 : 0;
    std::vector<FaceId> faces(count);
    std::size_t done = 0;
    for (FaceId face = 0; done < count; ++face) {
        faces[done] = face;
        done += marks[face] != 0 ? 1 : 0;
    }
    return faces;
}

std::vector<FaceId> flood_by_angle(const FaceFacts& facts, const FaceNeighbours& neighbours,
                                   std::span<const FaceId> start, double max_angle) {
    const AngleLimit within(max_angle + flat_tolerance);
    const std::vector<Vec3f>& normal = facts.normal;
    if (!facts.some_without_area)
        return flood_joined(neighbours, normal.size(), start,
                            [&](FaceId a, FaceId b) { return within(normal[a], normal[b]); });
    return flood(neighbours, normal.size(), start, [&](FaceId carried, FaceId, FaceId next) {
        if (within.surely(normal[carried], normal[next])) return next;
        // A face without area passes on the face before it, whose normal counts then.
        if (normal[next].isZero(0.0f)) return carried;
        return normal[carried].isZero(0.0f) || within(normal[carried], normal[next]) ? next : no_id;
    });
}

std::vector<FaceId> brush_faces(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                const Vec3& centre, double radius) {
    if (start >= mesh.face_count()) return {};
    std::vector<FaceId> result{start};
    if (!(radius > 0.0)) return result;
    std::unordered_set<FaceId> seen{start};
    for (std::size_t done = 0; done < result.size(); ++done) {
        for (const FaceId next : neighbours.of(result[done]))
            if (seen.insert(next).second && face_within(mesh, next, centre, radius)) result.push_back(next);
    }
    std::sort(result.begin(), result.end());
    return result;
}

namespace {

std::vector<FaceId> numbered_from(FaceId first, std::vector<FaceId> faces) {
    for (FaceId& face : faces)
        face += first;
    return faces;
}

}  // namespace

std::vector<FaceId> flood_by_angle(const Document& document, FaceId start, double max_angle) {
    if (start >= document.face_count()) return {};
    const FacePart& part = document.part_with(start);
    const FaceId face = start - part.first;
    return numbered_from(part.first,
                         flood_by_angle(part.facts, part.neighbours, std::span(&face, 1), max_angle));
}

std::vector<FaceId> brush_faces(const Document& document, FaceId start, const Vec3& centre, double radius) {
    if (start >= document.face_count()) return {};
    const FacePart& part = document.part_with(start);
    return numbered_from(part.first,
                         brush_faces(*part.mesh, part.neighbours, start - part.first, centre, radius));
}

Aabb faces_bounds(const Document& document, std::span<const FaceId> faces) {
    Aabb bounds;
    for (const FaceId face : faces) {
        if (face >= document.face_count()) continue;
        const FacePart& part = document.part_with(face);
        const Mesh& mesh = *part.mesh;
        const FaceId at = face - part.first;
        for (std::uint32_t corner = mesh.face_first_corner[at]; corner < mesh.face_first_corner[at + 1];
             ++corner)
            bounds.add(mesh.corner_position(corner).cast<double>());
    }
    return bounds;
}

Aabb shown_bounds(const Document& document) {
    const std::size_t shown = document.face_count() - document.hidden().size();
    if (document.hidden().empty() || shown == 0) return document.bounds();
    std::vector<FaceId> faces;
    faces.reserve(shown);
    for (FaceId face = 0; face < document.face_count(); ++face)
        if (!document.is_hidden(face)) faces.push_back(face);
    return faces_bounds(document, faces);
}

}  // namespace slipface
