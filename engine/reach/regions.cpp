// Which walkable faces belong together.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "rim.h"
#include "slipface/collision/collision_world.h"
#include "slipface/level/shown_mesh.h"
#include "slipface/reach/links.h"

namespace slipface {
namespace {

// Sets of numbers, each named by its smallest.
class Unions {
  public:
    explicit Unions(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t one) {
        while (parent_[one] != one)
            one = parent_[one] = parent_[parent_[one]];
        return one;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

// What the player walks up: a step, or a rim that the ellipsoid rolls over, whose contact is as steep as the
// limit.
double highest_step(const MovementSettings& settings) {
    const double across = std::tan(settings.max_slope) * settings.radii.x() / settings.radii.y();
    const double rolls = settings.radii.y() * (1.0 - 1.0 / std::sqrt(1.0 + across * across));
    return std::max(rolls, settings.step_up ? settings.step_height : 0.0);
}

}  // namespace

std::uint32_t WalkRegions::of(const PlayerState& state) const {
    if (!state.grounded || state.climbing || state.stuck || state.ground_platform != no_id) return no_id;
    return state.ground_face < of_face.size() ? of_face[state.ground_face] : of_terrain;
}

WalkRegions walk_regions(const Level& level) {
    const Mesh& mesh = *level.mesh;
    const MovementSettings& settings = level.movement;
    const auto terrain = static_cast<std::uint32_t>(mesh.face_count());
    std::vector<bool> walkable(mesh.face_count());
    const std::vector<std::uint32_t> platform = face_platforms(level);
    for (const FaceId face : walkable_faces(level))
        walkable[face] = platform.empty() || platform[face] == no_id;
    Unions unions(mesh.face_count() + 1);
    const FaceNeighbours neighbours = face_neighbours(mesh);
    const Result<CollisionWorld> world = build_collision_world(level);
    const double step = highest_step(settings), radius = std::min(settings.radii.x(), settings.radii.z());
    // Where a rim's outside is ground, a step higher or lower.
    const auto join_beside = [&](FaceId face, const Vec3& beside) {
        const Vec3 above = beside + Vec3(0.0, step, 0.0);
        if (const auto hit = cast_ray(*world, above, Vec3(0.0, -1.0, 0.0), 2.0 * step))
            if (walkable[hit->face]) unions.join(face, hit->face);
        if (!level.terrain) return;
        const auto ground = terrain_at(*level.terrain, beside.x(), beside.z());
        if (ground && std::abs(ground->height - beside.y()) <= step) unions.join(face, terrain);
    };
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        if (!walkable[face]) continue;
        for (const FaceId other : neighbours.of(face))
            if (walkable[other]) unions.join(face, other);
        if (!world) continue;
        for_each_rim(mesh, face, [&](const Vec3& from, const Vec3& along, const Vec3& out) {
            const int places = std::clamp(static_cast<int>(along.norm() / (2.0 * radius)), 1, 16);
            for (int place = 0; place < places; ++place)
                for (const double away : {0.02, 0.5, 1.0})
                    join_beside(face, from + along * ((place + 0.5) / places) + away * radius * out);
        });
    }

    WalkRegions regions;
    regions.of_face.assign(mesh.face_count(), no_id);
    std::vector<std::uint32_t> number(mesh.face_count() + 1, no_id);
    const auto region_at = [&](std::uint32_t one) {
        std::uint32_t& region = number[unions.find(one)];
        if (region == no_id) {
            region = static_cast<std::uint32_t>(regions.regions.size());
            regions.regions.emplace_back();
        }
        return region;
    };
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        if (!walkable[face]) continue;
        regions.of_face[face] = region_at(face);
        WalkRegions::Region& region = regions.regions[regions.of_face[face]];
        region.faces.push_back(face);
        region.area_m2 += face_area(mesh, face);
    }
    if (level.terrain) regions.of_terrain = region_at(terrain);
    return regions;
}

}  // namespace slipface
