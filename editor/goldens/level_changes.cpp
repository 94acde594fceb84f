#include "goldens/level_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "slipface/base/hash.h"

namespace slipface {

namespace {

// A key of the corners, independent of the loop's start and direction, rounded to 1e-5 m.
std::uint64_t corners_hash(const Mesh& mesh, FaceId face) {
    std::uint64_t sum = mesh.face_corner_count(face);
    for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
        const Vec3f p = mesh.corner_position(c);
        Hasher hasher;
        for (int axis = 0; axis < 3; ++axis)
            hasher.u64(static_cast<std::uint64_t>(std::llround(static_cast<double>(p[axis]) * 1e5)));
        sum += hasher.value();
    }
    return sum;
}

using Buckets = std::map<std::uint64_t, std::vector<FaceId>>;

std::vector<FaceId> all_faces(const Mesh& mesh) {
    std::vector<FaceId> faces(mesh.face_count());
    for (FaceId face = 0; face < faces.size(); ++face)
        faces[face] = face;
    return faces;
}

struct Matcher {
    const Mesh& before;
    const Mesh& after;
    std::vector<FaceId> found_in_after, found_in_before;  // [face] partner

    // Pairs faces with equal keys, in order.
    template <class Key>
    void pair_by(const Key& key, bool equal_counts_only) {
        std::map<decltype(key(before, FaceId{})), std::pair<std::vector<FaceId>, std::vector<FaceId>>>
            buckets;
        for (const FaceId face : all_faces(before))
            if (found_in_after[face] == no_id) buckets[key(before, face)].first.push_back(face);
        for (const FaceId face : all_faces(after))
            if (found_in_before[face] == no_id) buckets[key(after, face)].second.push_back(face);
        for (const auto& [k, sides] : buckets) {
            if (equal_counts_only && sides.first.size() != sides.second.size()) continue;
            for (std::size_t i = 0; i < std::min(sides.first.size(), sides.second.size()); ++i) {
                found_in_after[sides.first[i]] = sides.second[i];
                found_in_before[sides.second[i]] = sides.first[i];
            }
        }
    }
};

double largest_move(const Mesh& before, FaceId a, const Mesh& after, FaceId b) {
    double largest = 0.0;
    const std::uint32_t count = std::min(before.face_corner_count(a), after.face_corner_count(b));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3f from = before.corner_position(before.face_first_corner[a] + i),
                    to = after.corner_position(after.face_first_corner[b] + i);
        largest = std::max(largest, (to - from).cast<double>().norm());
    }
    return largest;
}

std::string type_name(const Level& level, SurfaceId surface) {
    return surface < level.surfaces.size() ? level.surfaces[surface].name : "default";
}

// A type of the same name may have other parameters.
bool same_type(const Level& before, SurfaceId a, const Level& after, SurfaceId b) {
    return a < before.surfaces.size() && b < after.surfaces.size() && before.surfaces[a] == after.surfaces[b];
}

}  // namespace

LevelChanges compare_levels(const Level& before, const Level& after) {
    const Mesh &a = *before.mesh, &b = *after.mesh;
    Matcher matcher{a, b, std::vector<FaceId>(a.face_count(), no_id),
                    std::vector<FaceId>(b.face_count(), no_id)};
    matcher.pair_by(corners_hash, false);
    const std::vector<FaceId> unmoved = matcher.found_in_after;
    matcher.pair_by(
        [](const Mesh& mesh, FaceId face) {
            return std::tuple(mesh.groups[mesh.face_group[face]],
                              mesh.materials[mesh.face_material[face]].name, mesh.face_corner_count(face));
        },
        true);
    const ResolvedSurfaces was = resolve_surfaces(before), is = resolve_surfaces(after);
    LevelChanges changes;
    changes.of_before.assign(a.face_count(), no_id);
    changes.of_after.assign(b.face_count(), no_id);
    const auto add = [&](FaceChange change) {
        const auto index = static_cast<std::uint32_t>(changes.list.size());
        if (change.before != no_id) changes.of_before[change.before] = index;
        if (change.after != no_id) changes.of_after[change.after] = index;
        changes.list.push_back(std::move(change));
    };
    for (FaceId face = 0; face < a.face_count(); ++face) {
        const FaceId partner = matcher.found_in_after[face];
        FaceChange change{FaceChange::Kind::none, face, partner, 0.0, ""};
        if (partner == no_id) {
            change.kind = FaceChange::Kind::removed;
            change.text = "removed";
        } else if (unmoved[face] == no_id) {
            change.kind = FaceChange::Kind::moved;
            change.moved = largest_move(a, face, b, partner);
            change.text = fmt::format("moved by up to {:.3g} m", change.moved);
        } else if (!same_type(before, was.surface[face], after, is.surface[partner])) {
            change.kind = FaceChange::Kind::surface;
            const std::string from = type_name(before, was.surface[face]),
                              to = type_name(after, is.surface[partner]);
            change.text = from == to ? fmt::format("are of type {}, whose parameters changed", to)
                                     : fmt::format("changed {} to {}", from, to);
        }
        if (change.kind != FaceChange::Kind::none) add(std::move(change));
    }
    for (FaceId face = 0; face < b.face_count(); ++face)
        if (matcher.found_in_before[face] == no_id) add({FaceChange::Kind::added, no_id, face, 0.0, "added"});
    return changes;
}

std::string group_label(const Mesh& mesh, FaceId face) {
    const std::string& group = mesh.groups[mesh.face_group[face]];
    return group.empty() ? std::string("the level") : fmt::format("`{}`", group);
}

std::string face_label(const Mesh& mesh, FaceId face) {
    const std::string& group = mesh.groups[mesh.face_group[face]];
    return group.empty() ? fmt::format("face {}", face) : fmt::format("face {} of `{}`", face, group);
}

}  // namespace slipface
