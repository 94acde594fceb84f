// What follows from the document's data: each face's type, the collision world's copy of it, and picking.
#include <algorithm>

#include "document/document.h"

namespace slipface {

void Document::refresh(const Touched& touched) {
    ++revision_;
    if (touched.types || touched.parameters || !touched.faces.empty()) ++face_revision_;
    if (touched.types) {
        resolve_again();
        return;
    }
    if (touched.parameters) apply_surface_rules(collision_, level_.surfaces);
    for (const FaceId face : touched.faces) {
        --surface_counts_[resolved_.surface[face]];
        resolve_face(face);
        ++surface_counts_[resolved_.surface[face]];
        collision_.set_face_surface(face, resolved_.surface[face]);
    }
}

void Document::resolve_face(FaceId face) {
    const std::optional<SurfaceId> painted = level_.overrides[face];
    resolved_.surface[face] = painted ? *painted : unpainted_.surface[face];
    resolved_.source[face] = painted ? SurfaceSource::override_ : unpainted_.source[face];
}

void Document::resolve_again() {
    std::vector<std::optional<SurfaceId>> overrides(level_.overrides.size());
    std::swap(overrides, level_.overrides);
    unpainted_ = resolve_surfaces(level_);
    std::swap(overrides, level_.overrides);

    resolved_ = unpainted_;
    surface_counts_.fill(0);
    apply_surface_rules(collision_, level_.surfaces);
    for (FaceId face = 0; face < resolved_.surface.size(); ++face) {
        resolve_face(face);
        ++surface_counts_[resolved_.surface[face]];
        collision_.set_face_surface(face, resolved_.surface[face]);
    }
}

std::optional<RayHit> Document::pick(const Vec3& origin, const Vec3& direction, bool front_only) {
    // Painting a face as not solid must not make it unreachable.
    std::vector<SurfaceId> opened;
    for (std::size_t i = 0; i < level_.surfaces.size(); ++i) {
        const auto surface = static_cast<SurfaceId>(i);
        SurfaceRule rule = collision_.surface_rule(surface);
        if (rule.solid) continue;
        rule.solid = true;
        collision_.set_surface_rule(surface, rule);
        opened.push_back(surface);
    }

    constexpr int max_layers = 64;  // back faces looked through
    std::optional<RayHit> hit;
    double done = 0.0;
    for (int layer = 0; layer < max_layers; ++layer) {
        const Vec3 from = origin + done * direction;
        hit = cast_ray(collision_, from, direction);
        if (!hit) break;
        hit->t += done;
        if (!front_only || !hit->back_face) break;
        // The next double along the ray that is sure to lie behind the face, whatever the level's size.
        const double scale =
            std::max({hit->t, origin.norm() / direction.norm(), hit->point.norm() / direction.norm()});
        done = hit->t + scale * 1e-9;
        hit.reset();
    }

    for (const SurfaceId surface : opened) {
        SurfaceRule rule = collision_.surface_rule(surface);
        rule.solid = false;
        collision_.set_surface_rule(surface, rule);
    }
    return hit;
}

}  // namespace slipface
