// What some faces have in common, for the inspector.
#pragma once

#include <span>
#include <string>

#include "document/document.h"

namespace slipface {

// A value that all faces share, or nothing when they differ.
struct FaceSummary {
    std::size_t faces = 0;
    std::size_t triangles = 0;
    std::size_t painted = 0;  // with an override
    double area = 0.0;        // square metres, all together
    double slope_min = 0.0,
           slope_max = 0.0;  // radians: 0 floor, pi/2 wall, pi ceiling; of the faces with area
    bool has_slope = false;
    std::optional<std::string> material, group;  // names
    std::optional<SurfaceId> surface;
    std::optional<SurfaceSource> source;
    std::optional<SurfaceId> unpainted;  // what the painted ones would be without their paint
    std::optional<SurfaceSource> unpainted_source;
};

// Faces outside the level are left out.
FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces);

}  // namespace slipface
