#include "slipface/movement/triggers.h"

#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// Longer than any volume.
constexpr double far_away = 1e6;

struct Found {
    std::array<TriggerKey, 2 * TriggerMemory::capacity> keys;
    std::array<FaceId, 2 * TriggerMemory::capacity> faces;
    std::size_t count = 0;

    void add(const TriggerKey& key, FaceId face) {
        const auto end = keys.begin() + static_cast<std::ptrdiff_t>(count);
        if (count == keys.size() || std::find(keys.begin(), end, key) != end) return;
        keys[count] = key;
        faces[count++] = face;
    }
};

// The centre is inside closed faces of one type: whichever way it looks, it sees the back of one.
bool inside(const PosedWorld& world, const QueryFilter& one_type, const Vec3& centre, FaceId& face) {
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
        for (const double sign : {1.0, -1.0}) {
            const auto hit = cast_ray(world, centre, sign * axis, far_away, RayStops::solid, one_type);
            if (!hit || !hit->back_face) return false;
            face = hit->face;
        }
    }
    return true;
}

void look(const MovementScene& scene, std::uint32_t platform, const Vec3& radii, const Vec3& from,
          const Vec3& to, Found& found) {
    const bool moves = platform < scene.platforms.size();
    const PosedWorld world = moves ? scene.platforms[platform].at_end() : PosedWorld(scene.collision);
    const Aabb room = world.bounds();
    if (room.empty() || ((to.cwiseMax(from) + radii).array() < room.min.array()).any() ||
        ((to.cwiseMin(from) - radii).array() > room.max.array()).any())
        return;
    QueryFilter seen = filter_of(scene, platform);
    seen.solid = false;
    // Each type by itself: a body may touch more faces of one than there is room for.
    for (std::size_t type = 0; type < scene.surfaces.size(); ++type) {
        const auto surface = static_cast<SurfaceId>(type);
        if (scene.surfaces[type].solid || world.surface_rule(surface).solid || seen.ignored[type]) continue;
        QueryFilter only = seen;
        only.ignored.set();
        only.ignored[type] = false;
        std::array<Overlap, 1> overlap;
        FaceId face = no_id;
        if (find_overlaps(world, radii, to, overlap, only) > 0) {
            face = overlap[0].face;
        } else if (const auto hit = sweep_ellipsoid(world, radii, from, to - from, only)) {
            face = hit->face;
        } else if (!inside(world, only, to, face)) {
            continue;
        }
        found.add({platform, surface}, face);
    }
}

}  // namespace

std::size_t track_triggers(const MovementScene& scene, const Vec3& radii, const Vec3& from, const Vec3& to,
                           TriggerMemory& memory, std::span<StepEvent> out) {
    const bool usable = radii.allFinite() && radii.minCoeff() > 0.0 && from.allFinite() && to.allFinite();
    const auto opens = [](const SurfaceType& type) { return !type.solid; };
    Found found;
    if (usable && std::any_of(scene.surfaces.begin(), scene.surfaces.end(), opens)) {
        look(scene, no_id, radii, from, to, found);
        const auto ask = [&](std::uint32_t platform) { look(scene, platform, radii, from, to, found); };
        if (scene.tree != nullptr) {
            const Vec3 slack = slack_around(radii, from, to - from);
            scene.tree->visit({from.cwiseMin(to) - slack, from.cwiseMax(to) + slack}, ask);
        } else {
            for (std::uint32_t i = 0; i < scene.platforms.size(); ++i)
                ask(i);
        }
    }
    std::size_t total = 0;
    const auto report = [&](StepEventKind kind, const TriggerKey& key, FaceId face) {
        const StepEvent event{.kind = kind, .surface = key.surface, .platform = key.platform, .face = face};
        if (total < out.size()) out[total] = event;
        ++total;
    };
    const auto held = [&](const TriggerKey& key) {
        const auto end = memory.inside.begin() + memory.count;
        return std::find(memory.inside.begin(), end, key) != end;
    };
    // By platform and type, whatever the order of the tree.
    const std::size_t count = std::min(found.count, TriggerMemory::capacity);
    std::array<std::size_t, 2 * TriggerMemory::capacity> order;
    for (std::size_t i = 0; i < found.count; ++i)
        order[i] = i;
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(found.count),
              [&](std::size_t a, std::size_t b) {
                  const TriggerKey &x = found.keys[a], &y = found.keys[b];
                  return x.platform + 1 != y.platform + 1 ? x.platform + 1 < y.platform + 1
                                                          : x.surface < y.surface;
              });
    TriggerMemory now;
    for (std::size_t i = 0; i < count; ++i) {
        const TriggerKey& key = found.keys[order[i]];
        now.inside[now.count++] = key;
        report(held(key) ? StepEventKind::stayed : StepEventKind::entered, key, found.faces[order[i]]);
    }
    for (std::uint32_t i = 0; i < std::min<std::uint32_t>(memory.count, TriggerMemory::capacity); ++i) {
        const auto end = now.inside.begin() + now.count;
        if (std::find(now.inside.begin(), end, memory.inside[i]) == end)
            report(StepEventKind::departed, memory.inside[i], no_id);
    }
    memory = now;
    return total;
}

}  // namespace slipface
