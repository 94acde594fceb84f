#include "tools/face_summary.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

// Keeps `common` while every face says the same; the first face decides.
template <class T>
void agree(std::optional<T>& common, const T& value, bool first) {
    if (first)
        common = value;
    else if (common && *common != value)
        common.reset();
}

}  // namespace

FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces) {
    const Mesh& mesh = document.mesh();
    FaceSummary summary;
    for (const FaceId face : faces) {
        if (face >= mesh.face_count()) continue;
        const bool first = summary.faces == 0;
        ++summary.faces;
        summary.triangles += mesh.face_first_triangle[face + 1] - mesh.face_first_triangle[face];
        summary.area += face_area(mesh, face);
        if (document.level().overrides[face]) ++summary.painted;
        agree(summary.material, mesh.materials[mesh.face_material[face]].name, first);
        agree(summary.group, mesh.groups[mesh.face_group[face]], first);
        agree(summary.surface, document.resolved().surface[face], first);
        agree(summary.source, document.resolved().source[face], first);
        const Vec3 normal = face_normal(mesh, face);
        if (normal.isZero(0.0)) continue;
        const double slope = std::atan2(std::hypot(normal.x(), normal.z()), normal.y());
        summary.slope_min = summary.has_slope ? std::min(summary.slope_min, slope) : slope;
        summary.slope_max = summary.has_slope ? std::max(summary.slope_max, slope) : slope;
        summary.has_slope = true;
    }
    return summary;
}

}  // namespace slipface
