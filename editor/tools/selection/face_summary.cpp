#include "tools/selection/face_summary.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

// Leaves `common` set while all faces have the same value; the first face decides.
template <class T>
void agree(std::optional<T>& common, const T& value, bool first) {
    if (first)
        common = value;
    else if (common && *common != value)
        common.reset();
}

}  // namespace

FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces) {
    FaceSummary summary;
    std::optional<std::string> material, group;
    double up_most = -2.0, up_least = 2.0;  // the normals' y
    for (const FaceId face : faces) {
        if (face >= document.face_count()) continue;
        const bool first = summary.faces == 0;
        const FacePart& part = document.part_with(face);
        const FaceId at = face - part.first;
        ++summary.faces;
        summary.triangles += part.mesh->face_first_triangle[at + 1] - part.mesh->face_first_triangle[at];
        summary.area += static_cast<double>(part.facts.area[at]);
        agree(material, document.level().mesh.material_of(face), first);
        agree(group, document.level().mesh.group_of(face), first);
        agree(summary.surface, document.surface_of(face), first);
        agree(summary.source, document.source_of(face), first);
        if (document.paint_of(face)) {
            const bool first_painted = summary.painted++ == 0;
            agree(summary.unpainted, document.unpainted(face), first_painted);
            agree(summary.unpainted_source, document.unpainted_source(face), first_painted);
        }
        const Vec3f& normal = part.facts.normal[at];
        if (normal.isZero(0.0f)) continue;
        up_most = std::max(up_most, static_cast<double>(normal.y()));
        up_least = std::min(up_least, static_cast<double>(normal.y()));
        summary.has_slope = true;
    }
    summary.material = std::move(material);
    summary.group = std::move(group);
    if (summary.has_slope) {
        summary.slope_min = std::acos(std::clamp(up_most, -1.0, 1.0));
        summary.slope_max = std::acos(std::clamp(up_least, -1.0, 1.0));
    }
    return summary;
}

}  // namespace slipface
