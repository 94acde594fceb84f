// Selection algebra: functions from sets of faces to sets of faces. Every list is ascending, each face once.
// Nothing here changes a document or looks at hidden faces: the caller handles those.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "document/document.h"

namespace slipface {

// Faces reachable from `start` across shared edges, `start` included; a shared corner does not connect.
// connected_flat: only in the plane of the face of `start` where the path began.
std::vector<FaceId> connected_flat(const Document& document, std::span<const FaceId> start);
// Across edges that bend by at most `max_angle` (radians).
std::vector<FaceId> connected_by_angle(const Document& document, std::span<const FaceId> start,
                                       double max_angle);
std::vector<FaceId> connected_within_material(const Document& document, std::span<const FaceId> start);
std::vector<FaceId> connected_within_type(const Document& document, std::span<const FaceId> start);

// With all faces that share an edge with one of `faces`.
std::vector<FaceId> grown(const Document& document, std::span<const FaceId> faces);
// Without the faces that share an edge with a face outside `faces`. Open borders of the level do not count.
std::vector<FaceId> shrunk(const Document& document, std::span<const FaceId> faces);
std::vector<FaceId> inverted(const Document& document, std::span<const FaceId> faces);
std::vector<FaceId> every_face(const Document& document);

// How steep a face is for the player: by the slope limit of its type, or of the movement settings.
enum class SlopeClass : std::uint8_t {
    none,      // no area
    walkable,  // at most the limit
    steep,     // steeper, up to vertical
    overhang   // faces downwards
};
SlopeClass slope_class(const Document& document, FaceId face);
// All faces by slope class: how many, and their area in square metres.
struct SlopeCounts {
    std::array<std::size_t, 4> faces{};  // [SlopeClass]
    std::array<double, 4> area{};
};
const SlopeCounts& slope_counts(const Document& document);  // cached until something changes
std::vector<FaceId> faces_with_slope(const Document& document, SlopeClass slope);
// The cosine of the limit for faces of this type.
double slope_limit_cosine(const Document& document, SurfaceId surface);

enum class Likeness { material, type, normal, area, slope, group };
// The faces of the whole level that are like one of `samples`: of the same material, type, group or slope
// class, with a normal within 2 degrees, or with an area within 5 %.
std::vector<FaceId> similar_faces(const Document& document, std::span<const FaceId> samples,
                                  Likeness likeness);

std::vector<FaceId> faces_of_type(const Document& document, SurfaceId surface);
std::vector<FaceId> painted_faces(const Document& document);  // with an override
std::vector<FaceId> unpainted_faces(const Document& document);
std::vector<FaceId> faces_steeper_than_limit(const Document& document);  // steep and overhanging

std::vector<FaceId> united(std::span<const FaceId> a, std::span<const FaceId> b);
std::vector<FaceId> without(std::span<const FaceId> a, std::span<const FaceId> b);

}  // namespace slipface
