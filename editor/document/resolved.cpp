// Data derived from the document: each face's type, the collision world's copy of it, and picking.
#include <algorithm>
#include <utility>

#include "document/document.h"
#include "slipface/base/parallel.h"

namespace slipface {

void Document::refresh(const Touched& touched) {
    ++revision_;
    if (touched.hidden && !touched.geometry) mark_hidden();
    if (touched.types || touched.parameters || touched.props || !touched.faces.empty()) ++face_revision_;
    // Building succeeded before, so it fails only if memory has run out since.
    if (touched.geometry)
        if (const Status status = rebuild_geometry(); !status) warnings_.push_back(status.error());
    if (touched.types) {
        resolve_again();
        return;
    }
    if (touched.props) resolve_props();
    if (touched.parameters) apply_surface_rules(collision_, level_.surfaces);
    if (!touched.faces.empty()) repaint(touched.faces);
}

void Document::repaint(std::span<const FaceId> faces) {
    const std::size_t own = resolved_.own.surface.size();
    if (!has_instances(level_) && faces.size() > own / 8) {
        apply_overrides();
        return;
    }
    bool in_props = false;
    for (const FaceId face : faces) {
        if (face >= own) {
            in_props = true;
            continue;
        }
        count_face(face, false);
        resolve_face(face);
        count_face(face, true);
        collision_.set_face_surface(face, resolved_.own.surface[face]);
    }
    if (in_props) resolve_props();
}

void Document::resolve_face(FaceId face) {
    const std::optional<SurfaceId> painted = paint_of(face);
    resolved_.own.surface[face] = painted ? *painted : unpainted_.own.surface[face];
    resolved_.own.source[face] = painted ? SurfaceSource::override_ : unpainted_.own.source[face];
}

void Document::count_face(FaceId face, bool in) {
    const SurfaceId surface = resolved_.own.surface[face];
    const float area = own_part_.facts.area[face];
    surface_counts_[surface] += in ? std::size_t{1} : ~std::size_t{0};
    surface_areas_[surface] += static_cast<double>(in ? area : -area);
}

void Document::count(const PropFaces& prop, bool in) {
    for (const auto& [surface, sum] : prop.sums) {
        surface_counts_[surface] += in ? sum.faces : ~sum.faces + 1;
        surface_areas_[surface] += in ? sum.area : -sum.area;
    }
}

Document::PropFaces Document::count_prop(std::size_t prop) {
    const Prop& placed = level_.props[prop];
    PropFaces faces{
        placed.mesh, placed.type, placed.scale, resolved_.props[prop] != unpainted_.props[prop], {}};
    if (!resolved_.props[prop]) return faces;
    const MeshPtr& mesh = find_prop_mesh(level_, placed.mesh)->mesh;
    std::vector<Vec3>& vectors = prop_area_vectors_[mesh];
    for (FaceId face = static_cast<FaceId>(vectors.size()); face < mesh->face_count(); ++face)
        vectors.emplace_back(face_area(*mesh, face) * face_normal(*mesh, face));
    const Vec3& s = placed.scale;
    const Vec3 stretch(s.y() * s.z(), s.x() * s.z(), s.x() * s.y());
    std::array<PropFaces::Sum, max_surface_types + 1> sums{};
    for (std::size_t face = 0; face < vectors.size(); ++face) {
        PropFaces::Sum& sum = sums[resolved_.props[prop]->surface[face]];
        ++sum.faces;
        sum.area += vectors[face].cwiseProduct(stretch).norm();
    }
    for (std::size_t surface = 0; surface < sums.size(); ++surface)
        if (sums[surface].faces > 0) faces.sums.emplace_back(static_cast<SurfaceId>(surface), sums[surface]);
    return faces;
}

void Document::resolve_props() {
    unpainted_.props = slipface::resolve_props(level_);
    resolved_.props = unpainted_.props;
    paint_props(level_, resolved_.props);
    std::vector<PropFaces> was = std::exchange(prop_faces_, {});
    prop_faces_.reserve(resolved_.props.size());
    std::size_t next = 0;  // that which is probably the same prop among those before
    for (std::size_t i = 0; i < resolved_.props.size(); ++i) {
        const Prop& prop = level_.props[i];
        const bool painted = resolved_.props[i] != unpainted_.props[i];
        const auto same = [&](std::size_t k) {
            return !painted && k < was.size() && !was[k].painted && was[k].mesh == prop.mesh &&
                   was[k].type == prop.type && was[k].scale == prop.scale &&
                   was[k].sums.empty() == !resolved_.props[i];
        };
        // One may have gone, or come.
        if (!same(next)) next = same(next + 1) ? next + 1 : next > 0 && same(next - 1) ? next - 1 : next;
        if (same(next)) {
            prop_faces_.push_back(std::exchange(was[next], {}));
        } else {
            prop_faces_.push_back(count_prop(i));
            count(prop_faces_.back(), true);
        }
        ++next;
    }
    for (const PropFaces& gone : was)
        count(gone, false);
    whole_part_.reset();
    const std::vector<Instance> instances =
        prop_instances(level_, resolved_, Vec3::Zero(), [](std::size_t) { return true; });
    if (const Status status = collision_.set_instances(instances); !status)
        warnings_.push_back(status.error());
}

void Document::resolve_again() {
    {
        // Put back whatever happens meanwhile: memory may run out.
        struct WithoutPaint {
            std::vector<std::optional<SurfaceId>>& paint;
            std::vector<std::optional<SurfaceId>> kept = std::exchange(paint, {});
            ~WithoutPaint() { paint.swap(kept); }
        } const without{level_.overrides};
        unpainted_ = resolve_parts(level_);
    }
    resolved_ = unpainted_;
    apply_surface_rules(collision_, level_.surfaces);
    apply_overrides();
}

void Document::apply_overrides() {
    surface_counts_.fill(0);
    surface_areas_.fill(0.0);
    prop_faces_.clear();
    // Types and sources are bytes, which may alias anything: their places in memory are looked up only once.
    const std::size_t face_count = resolved_.own.surface.size();
    SurfaceId* const surfaces = resolved_.own.surface.data();
    SurfaceSource* const sources = resolved_.own.source.data();
    const SurfaceId* const plain_surfaces = unpainted_.own.surface.data();
    const SurfaceSource* const plain_sources = unpainted_.own.source.data();
    const std::optional<SurfaceId>* const paint = level_.overrides.data();
    const std::size_t painted = std::min(face_count, level_.overrides.size());
    for (std::size_t face = 0; face < painted; ++face) {
        surfaces[face] = paint[face].value_or(plain_surfaces[face]);
        sources[face] = paint[face] ? SurfaceSource::override_ : plain_sources[face];
    }
    std::copy(plain_surfaces + painted, plain_surfaces + face_count, surfaces + painted);
    std::copy(plain_sources + painted, plain_sources + face_count, sources + painted);
    for (std::size_t begin = 0, end = 0; begin < face_count; begin = end) {
        // A run of faces of one type is counted at once.
        const SurfaceId surface = surfaces[begin];
        double area = 0.0;
        do
            area += static_cast<double>(own_part_.facts.area[end]);
        while (++end < face_count && surfaces[end] == surface);
        surface_counts_[surface] += end - begin;
        surface_areas_[surface] += area;
    }
    collision_.set_face_surfaces(resolved_.own.surface);
    if (has_instances(level_)) resolve_props();
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
