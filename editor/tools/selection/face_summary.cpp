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

// Joins what two parts of the geometry have in common; the first part decides.
template <class T, class Value>
void join(std::optional<T>& common, const std::optional<Value>& value, bool first) {
    if (first && value)
        common = *value;
    else if (!value || !common || *common != *value)
        common.reset();
}

void summarize_paint(const Document& document, std::span<const FaceId> faces, FaceSummary& summary) {
    SurfaceId surface = default_surface;
    SurfaceSource source = SurfaceSource::none;
    bool one_surface = true, one_source = true;
    std::size_t painted = 0;
    for (const FaceId face : faces) {
        if (!document.paint_of(face)) continue;
        if (painted++ == 0) {
            surface = document.unpainted(face);
            source = document.unpainted_source(face);
        }
        one_surface = one_surface && document.unpainted(face) == surface;
        one_source = one_source && document.unpainted_source(face) == source;
    }
    summary.painted = painted;
    if (painted > 0 && one_surface) summary.unpainted = surface;
    if (painted > 0 && one_source) summary.unpainted_source = source;
}

// Of the faces' normals: y.
struct Slopes {
    float up_most = -2.0f, up_least = 2.0f;
};

// `faces` of one part.
void summarize_part(const Document& document, const FacePart& part, std::span<const FaceId> faces,
                    FaceSummary& summary, Slopes& slopes) {
    const Mesh& mesh = *part.mesh;
    const SurfaceParts& parts = document.resolved_parts();
    const bool own = faces[0] < parts.own.surface.size();
    const ResolvedSurfaces& resolved =
        own ? parts.own : *parts.props[document.level().placed.prop_of(faces[0])];
    const FaceId first = faces[0] - part.first;
    Common material(mesh.face_material[first]), group(mesh.face_group[first]);
    Common surface(resolved.surface[first]);
    Common source(resolved.source[first]);
    std::size_t triangles = 0;
    double area = 0.0;
    for (const FaceId number : faces) {
        const FaceId face = number - part.first;
        triangles += mesh.face_first_triangle[face + 1] - mesh.face_first_triangle[face];
        area += static_cast<double>(part.facts.area[face]);
        material.add(mesh.face_material[face]);
        group.add(mesh.face_group[face]);
        surface.add(resolved.surface[face]);
        source.add(resolved.source[face]);
        const Vec3f& normal = part.facts.normal[face];
        if (normal.isZero(0.0f)) continue;
        slopes.up_most = std::max(slopes.up_most, normal.y());
        slopes.up_least = std::min(slopes.up_least, normal.y());
    }
    const bool is_first = summary.faces == 0;
    summary.faces += faces.size();
    summary.triangles += triangles;
    summary.area += area;
    join(summary.surface, surface.agreed(), is_first);
    join(summary.source, source.agreed(), is_first);
    const LevelMesh& level = document.level().mesh;
    join(summary.material, material.agreed() ? std::optional(level.material_of(faces[0])) : std::nullopt,
         is_first);
    join(summary.group, group.agreed() ? std::optional(level.group_of(faces[0])) : std::nullopt, is_first);
}

}  // namespace

FaceSummary summarize_faces(const Document& document, std::span<const FaceId> faces) {
    // Selections are ascending.
    while (!faces.empty() && faces.back() >= document.face_count())
        faces = faces.first(faces.size() - 1);
    FaceSummary summary;
    if (faces.empty()) return summary;
    Slopes slopes;
    for (std::span<const FaceId> rest = faces; !rest.empty();) {
        const FacePart& part = document.part_with(rest[0]);
        const auto end = std::lower_bound(rest.begin(), rest.end(),
                                          part.first + static_cast<FaceId>(part.mesh->face_count()));
        const auto count = static_cast<std::size_t>(end - rest.begin());
        summarize_part(document, part, rest.first(count), summary, slopes);
        rest = rest.subspan(count);
    }
    summarize_paint(document, faces, summary);
    summary.has_slope = slopes.up_most >= slopes.up_least;
    if (summary.has_slope) {
        summary.slope_min = std::acos(std::clamp(static_cast<double>(slopes.up_most), -1.0, 1.0));
        summary.slope_max = std::acos(std::clamp(static_cast<double>(slopes.up_least), -1.0, 1.0));
    }
    return summary;
}

}  // namespace slipface
