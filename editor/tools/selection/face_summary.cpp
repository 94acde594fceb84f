#include "tools/selection/face_summary.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

// A value that the summary shows if every face has it. Its name is looked up once at the end.
template <class T>
class Common {
  public:
    explicit Common(T first) : value_(first) {}
    void add(T value) { differs_ |= static_cast<unsigned>(value) ^ static_cast<unsigned>(value_); }
    std::optional<T> agreed() const { return differs_ == 0 ? std::optional<T>(value_) : std::nullopt; }

  private:
    T value_;
    unsigned differs_ = 0;  // bits
};

void summarize_paint(const Document& document, std::span<const FaceId> faces, FaceSummary& summary) {
    std::optional<Common<SurfaceId>> surface;
    std::optional<Common<SurfaceSource>> source;
    for (const FaceId face : faces) {
        if (!document.level().overrides[face]) continue;
        if (summary.painted++ == 0) {
            surface.emplace(document.unpainted(face));
            source.emplace(document.unpainted_source(face));
        }
        surface->add(document.unpainted(face));
        source->add(document.unpainted_source(face));
    }
    if (summary.painted == 0) return;
    summary.unpainted = surface->agreed();
    summary.unpainted_source = source->agreed();
}

}  // namespace

FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces) {
    const Mesh& mesh = document.mesh();
    // Selections are ascending.
    while (!faces.empty() && faces.back() >= mesh.face_count())
        faces = faces.first(faces.size() - 1);
    FaceSummary summary;
    if (faces.empty()) return summary;
    const ResolvedSurfaces& resolved = document.resolved();
    const FaceFacts& facts = document.facts();
    Common material(mesh.face_material[faces[0]]), group(mesh.face_group[faces[0]]);
    Common surface(resolved.surface[faces[0]]);
    Common source(resolved.source[faces[0]]);
    float up_most = -2.0f, up_least = 2.0f;  // the normals' y
    std::size_t triangles = 0;
    double area = 0.0;
    for (const FaceId face : faces) {
        triangles += mesh.face_first_triangle[face + 1] - mesh.face_first_triangle[face];
        area += static_cast<double>(facts.area[face]);
        material.add(mesh.face_material[face]);
        group.add(mesh.face_group[face]);
        surface.add(resolved.surface[face]);
        source.add(resolved.source[face]);
        const Vec3f& normal = facts.normal[face];
        if (normal.isZero(0.0f)) continue;
        up_most = std::max(up_most, normal.y());
        up_least = std::min(up_least, normal.y());
    }
    summary.faces = faces.size();
    summary.triangles = triangles;
    summary.area = area;
    summary.surface = surface.agreed();
    summary.source = source.agreed();
    summarize_paint(document, faces, summary);
    if (const auto agreed = material.agreed()) summary.material = mesh.materials[*agreed].name;
    if (const auto agreed = group.agreed()) summary.group = mesh.groups[*agreed];
    summary.has_slope = up_most >= up_least;
    if (summary.has_slope) {
        summary.slope_min = std::acos(std::clamp(static_cast<double>(up_most), -1.0, 1.0));
        summary.slope_max = std::acos(std::clamp(static_cast<double>(up_least), -1.0, 1.0));
    }
    return summary;
}

}  // namespace slipface
