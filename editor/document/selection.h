// The selection algebra: from some faces to others. Every list of faces is ascending, each face once. Pure:
// nothing here changes a document, and what is hidden is left to whoever selects.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "document/document.h"

namespace slipface {

// Faces reached from `start` over shared edges ("corners alone do not connect"), `start` among them.
std::vector<FaceId> connected_flat(const Document& document,
                                   std::span<const FaceId> start);  // in the start's plane
// Over edges that bend by at most `max_angle`, radians.
std::vector<FaceId> connected_by_angle(const Document& document, std::span<const FaceId> start,
                                       double max_angle);
std::vector<FaceId> connected_within_material(const Document& document, std::span<const FaceId> start);
std::vector<FaceId> connected_within_type(const Document& document, std::span<const FaceId> start);

// With all faces that share an edge with one of them.
std::vector<FaceId> grown(const Document& document, std::span<const FaceId> faces);
// Without those that share an edge with a face that is not among them. The level's open borders do not
// shrink.
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
const SlopeCounts& slope_counts(const Document& document);  // worked out anew only when something changed
std::vector<FaceId> faces_with_slope(const Document& document, SlopeClass slope);
// The cosine of the limit for faces of this type.
double slope_limit_cosine(const Document& document, SurfaceId surface);

enum class Likeness { material, type, normal, area, slope, group };
// Faces of the whole level that are like one of `samples`: the same material, type, group or slope class, a
// normal within 2 degrees, or an area within 5 %.
std::vector<FaceId> similar_faces(const Document& document, std::span<const FaceId> samples,
                                  Likeness likeness);

std::vector<FaceId> faces_of_type(const Document& document, SurfaceId surface);
std::vector<FaceId> painted_faces(const Document& document);  // with an override
std::vector<FaceId> unpainted_faces(const Document& document);
std::vector<FaceId> faces_steeper_than_limit(const Document& document);  // steep and overhanging

std::vector<FaceId> united(std::span<const FaceId> a, std::span<const FaceId> b);
std::vector<FaceId> without(std::span<const FaceId> a, std::span<const FaceId> b);

}  // namespace slipface
