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

// The same for an index; its name is looked up once at the end.
struct CommonIndex {
    std::uint32_t value = 0;
    bool any = false, mixed = false;
    void add(std::uint32_t index) {
        mixed = mixed || (any && index != value);
        value = index;
        any = true;
    }
    bool agreed() const { return any && !mixed; }
};

}  // namespace

FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces) {
    const Mesh& mesh = document.mesh();
    FaceSummary summary;
    CommonIndex material, group;
    double up_most = -2.0, up_least = 2.0;  // the normals' y
    for (const FaceId face : faces) {
        if (face >= mesh.face_count()) continue;
        const bool first = summary.faces == 0;
        ++summary.faces;
        summary.triangles += mesh.face_first_triangle[face + 1] - mesh.face_first_triangle[face];
        summary.area += static_cast<double>(document.facts().area[face]);
        material.add(mesh.face_material[face]);
        group.add(mesh.face_group[face]);
        agree(summary.surface, document.resolved().surface[face], first);
        agree(summary.source, document.resolved().source[face], first);
        if (document.level().overrides[face]) {
            const bool first_painted = summary.painted++ == 0;
            agree(summary.unpainted, document.unpainted(face), first_painted);
            agree(summary.unpainted_source, document.unpainted_source(face), first_painted);
        }
        const Vec3f& normal = document.facts().normal[face];
        if (normal.isZero(0.0f)) continue;
        up_most = std::max(up_most, static_cast<double>(normal.y()));
        up_least = std::min(up_least, static_cast<double>(normal.y()));
        summary.has_slope = true;
    }
    if (material.agreed()) summary.material = mesh.materials[material.value].name;
    if (group.agreed()) summary.group = mesh.groups[group.value];
    if (summary.has_slope) {
        summary.slope_min = std::acos(std::clamp(up_most, -1.0, 1.0));
        summary.slope_max = std::acos(std::clamp(up_least, -1.0, 1.0));
    }
    return summary;
}

}  // namespace slipface
