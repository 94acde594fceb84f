// What some faces have in common, for the inspector.
#pragma once

#include <span>
#include <string>

#include "document/document.h"

namespace slipface {

// Optional members hold a value that all faces have in common, or nothing if they differ.
struct FaceSummary {
    std::size_t faces = 0;
    std::size_t triangles = 0;
    std::size_t painted = 0;  // with an override
    double area = 0.0;        // square metres, in total
    // Radians: 0 floor, pi/2 wall, pi ceiling; of the faces with area.
    double slope_min = 0.0, slope_max = 0.0;
    bool has_slope = false;
    std::optional<std::string> material, group;  // names
    std::optional<SurfaceId> surface;
    std::optional<SurfaceSource> source;
    std::optional<SurfaceId> unpainted;  // the painted faces' types without their paint
    std::optional<SurfaceSource> unpainted_source;
};

// `faces`: ascending. Ignores those that are not in the level.
FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces);

}  // namespace slipface
