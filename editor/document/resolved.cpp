// Data derived from the document: each face's type, the collision world's copy of it, and picking.
#include <algorithm>

#include "document/document.h"
#include "slipface/base/parallel.h"

namespace slipface {

void Document::refresh(const Touched& touched) {
    ++revision_;
    if (touched.hidden && !touched.geometry) {
        std::fill(hidden_flags_.begin(), hidden_flags_.end(), std::uint8_t{0});
        for (const FaceId face : level_.hidden)
            hidden_flags_[face] = 1;
    }
    if (touched.types || touched.parameters || !touched.faces.empty()) ++face_revision_;
    // Building succeeded before, so it fails only if memory has run out since.
    if (touched.geometry)
        if (const Status status = rebuild_geometry(); !status) warnings_.push_back(status.error());
    if (touched.types) {
        resolve_again();
        return;
    }
    if (touched.parameters) apply_surface_rules(collision_, level_.surfaces);
    if (touched.faces.size() > resolved_.surface.size() / 8) {
        apply_overrides();
        return;
    }
    for (const FaceId face : touched.faces) {
        count_face(face, false);
        resolve_face(face);
        count_face(face, true);
        collision_.set_face_surface(face, resolved_.surface[face]);
    }
}

void Document::resolve_face(FaceId face) {
    const std::optional<SurfaceId> painted = level_.overrides[face];
    resolved_.surface[face] = painted ? *painted : unpainted_.surface[face];
    resolved_.source[face] = painted ? SurfaceSource::override_ : unpainted_.source[face];
}

void Document::count_face(FaceId face, bool in) {
    const SurfaceId surface = resolved_.surface[face];
    surface_counts_[surface] += in ? std::size_t{1} : ~std::size_t{0};
    surface_areas_[surface] += static_cast<double>(in ? facts_.area[face] : -facts_.area[face]);
}

void Document::resolve_again() {
    std::vector<std::optional<SurfaceId>> overrides(level_.overrides.size());
    std::swap(overrides, level_.overrides);
    unpainted_ = resolve_surfaces(level_);
    std::swap(overrides, level_.overrides);

    resolved_ = unpainted_;
    apply_surface_rules(collision_, level_.surfaces);
    apply_overrides();
}

void Document::apply_overrides() {
    surface_counts_.fill(0);
    surface_areas_.fill(0.0);
    const auto face_count = static_cast<FaceId>(resolved_.surface.size());
    for (FaceId begin = 0, end = 0; begin < face_count; begin = end) {
        // A run of faces of one type is counted at once.
        resolve_face(begin);
        const SurfaceId surface = resolved_.surface[begin];
        double area = 0.0;
        do {
            area += static_cast<double>(facts_.area[end]);
            if (++end < face_count) resolve_face(end);
        } while (end < face_count && resolved_.surface[end] == surface);
        surface_counts_[surface] += end - begin;
        surface_areas_[surface] += area;
    }
    collision_.set_face_surfaces(resolved_.surface);
}

namespace {

// Non-solid faces must stay pickable: while this object exists, every type is solid.
class AllSolid {
  public:
    AllSolid(CollisionWorld& world, std::size_t types) : world_(world) {
        for (std::size_t i = 0; i < types; ++i) {
            const auto surface = static_cast<SurfaceId>(i);
            SurfaceRule rule = world_.surface_rule(surface);
            if (rule.solid) continue;
            rule.solid = true;
            world_.set_surface_rule(surface, rule);
            opened_.push_back(surface);
        }
    }
    ~AllSolid() {
        for (const SurfaceId surface : opened_) {
            SurfaceRule rule = world_.surface_rule(surface);
            rule.solid = false;
            world_.set_surface_rule(surface, rule);
        }
    }
    AllSolid(const AllSolid&) = delete;
    AllSolid& operator=(const AllSolid&) = delete;

  private:
    CollisionWorld& world_;
    std::vector<SurfaceId> opened_;
};

constexpr int max_layers = 4096;  // faces passed by one ray

// Calls visit(hit) for the faces along the ray, nearest first, until it returns true.
template <class Visit>
void for_each_layer(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                    const Visit& visit) {
    double done = 0.0;
    for (int layer = 0; layer < max_layers; ++layer) {
        const Vec3 from = origin + done * direction;
        std::optional<RayHit> hit = cast_ray(world, from, direction);
        if (!hit) return;
        hit->t += done;
        if (visit(*hit)) return;
        // The next parameter along the ray that is certain to lie behind the face, for any size of level.
        const double scale =
            std::max({hit->t, origin.norm() / direction.norm(), hit->point.norm() / direction.norm()});
        done = hit->t + scale * 1e-9;
    }
}

}  // namespace

std::optional<RayHit> Document::pick(const Vec3& origin, const Vec3& direction, bool front_only) {
    const AllSolid all_solid(collision_, level_.surfaces.size());
    std::optional<RayHit> found;
    for_each_layer(collision_, origin, direction, [&](const RayHit& hit) {
        if (is_hidden(hit.face) || (front_only && hit.back_face)) return false;
        found = hit;
        return true;
    });
    return found;
}

std::vector<FaceId> Document::pick_through(const Vec3& origin, const Vec3& direction, bool front_only) {
    const AllSolid all_solid(collision_, level_.surfaces.size());
    std::vector<FaceId> faces;
    for_each_layer(collision_, origin, direction, [&](const RayHit& hit) {
        const bool seen = !is_hidden(hit.face) && !(front_only && hit.back_face);
        if (seen && std::find(faces.begin(), faces.end(), hit.face) == faces.end()) faces.push_back(hit.face);
        return false;
    });
    return faces;
}

std::vector<FaceId> Document::pick_faces(std::span<const PickRay> rays, bool front_only) {
    const AllSolid all_solid(collision_, level_.surfaces.size());
    std::vector<FaceId> faces(rays.size(), no_id);
    constexpr std::size_t grain = 512;
    parallel_for(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for_each_layer(collision_, rays[i].origin, rays[i].direction, [&](const RayHit& hit) {
                if (is_hidden(hit.face) || (front_only && hit.back_face)) return false;
                faces[i] = hit.face;
                return true;
            });
    });
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (!faces.empty() && faces.back() == no_id) faces.pop_back();
    return faces;
}

}  // namespace slipface
