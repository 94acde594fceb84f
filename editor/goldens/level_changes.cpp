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

std::string material_of(const Mesh& mesh, FaceId face) {
    return mesh.materials[mesh.face_material[face]].name;
}

// How the corners of a face lie in those of another that has the same ones.
struct Winding {
    bool flipped = false;
    std::uint32_t offset = 0;  // of the first corner in the other face
};

bool same_corner(const Mesh& a, std::uint32_t corner_a, const Mesh& b, std::uint32_t corner_b) {
    return (a.corner_position(corner_a) - b.corner_position(corner_b)).cwiseAbs().maxCoeff() < 2e-5f;
}

Winding winding(const Mesh& before, FaceId a, const Mesh& after, FaceId b) {
    const std::uint32_t count = before.face_corner_count(a), first = before.face_first_corner[a],
                        other = after.face_first_corner[b];
    for (const bool flipped : {false, true}) {
        for (std::uint32_t offset = 0; offset < count; ++offset) {
            std::uint32_t i = 0;
            while (i < count && same_corner(before, first + i, after,
                                            other + (offset + (flipped ? count - i : i)) % count))
                ++i;
            if (i == count) return {flipped, offset};
        }
    }
    return {};
}

bool same_texture_coordinates(const Mesh& before, FaceId a, const Mesh& after, FaceId b,
                              std::uint32_t offset) {
    const std::uint32_t count = before.face_corner_count(a), first = before.face_first_corner[a],
                        other = after.face_first_corner[b];
    for (std::uint32_t i = 0; i < count; ++i)
        if ((before.corner_uv[first + i] - after.corner_uv[other + (offset + i) % count])
                .cwiseAbs()
                .maxCoeff() > 1e-6f)
            return false;
    return true;
}

// Empty: equal.
std::string material_change(const Material& was, const Material& is) {
    if (was.name != is.name) return fmt::format("changed material `{}` to `{}`", was.name, is.name);
    if (was.texture != is.texture)
        return fmt::format("of material `{}`: its texture was \"{}\", is \"{}\"", is.name, was.texture,
                           is.texture);
    if (was.diffuse != is.diffuse)
        return fmt::format("of material `{}`: its color was {:.3g} {:.3g} {:.3g}, is {:.3g} {:.3g} {:.3g}",
                           is.name, was.diffuse.x(), was.diffuse.y(), was.diffuse.z(), is.diffuse.x(),
                           is.diffuse.y(), is.diffuse.z());
    return {};
}

std::string type_name(const Level& level, SurfaceId surface) {
    return surface < level.surfaces.size() ? level.surfaces[surface].name : "default";
}

// The hotkey is only for the editor.
bool same_parameters(SurfaceType a, const SurfaceType& b) {
    a.hotkey = b.hotkey;
    return a == b;
}

std::string field_text(const SurfaceType& type, const SurfaceField& field) {
    return std::visit(
        [&](const auto member) -> std::string {
            const auto& value = type.*member;
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, bool>) {
                return value ? "yes" : "no";
            } else if constexpr (std::is_same_v<Value, double>) {
                return fmt::format("{}", value);
            } else if constexpr (std::is_same_v<Value, Vec3>) {
                return fmt::format("{},{},{}", value.x(), value.y(), value.z());
            } else {
                return value ? fmt::format("{}", *value) : "not set";
            }
        },
        field.member);
}

// The change of a face whose partner has the same corners.
FaceChange change_in_position(const Level& before, FaceId a, SurfaceId was, const Level& after, FaceId b,
                              SurfaceId is) {
    const Mesh &old = *before.mesh, &now = *after.mesh;
    const Winding around = winding(old, a, now, b);
    const std::string material =
        material_change(old.materials[old.face_material[a]], now.materials[now.face_material[b]]);
    const std::string from = type_name(before, was), to = type_name(after, is);
    if (around.flipped) return {FaceChange::Kind::flipped, a, b, 0.0, "flipped"};
    if (from != to) {
        const bool by_name = material_of(old, a) != material_of(now, b);
        return {FaceChange::Kind::surface, a, b, 0.0,
                by_name ? fmt::format("{}, and so {} to {}", material, from, to)
                        : fmt::format("changed {} to {}", from, to)};
    }
    if (was < before.surfaces.size() && is < after.surfaces.size() &&
        !same_parameters(before.surfaces[was], after.surfaces[is]))
        return {FaceChange::Kind::parameters, a, b, 0.0,
                fmt::format("of type {}, whose parameters changed", to)};
    if (!material.empty()) return {FaceChange::Kind::material, a, b, 0.0, material};
    if (!same_texture_coordinates(old, a, now, b, around.offset))
        return {FaceChange::Kind::texture, a, b, 0.0, "changed texture coordinates"};
    return {FaceChange::Kind::none, a, b, 0.0, ""};
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
    changes.partner = matcher.found_in_after;
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
        } else {
            change = change_in_position(before, face, was.surface[face], after, partner, is.surface[partner]);
        }
        if (change.kind != FaceChange::Kind::none) add(std::move(change));
    }
    for (FaceId face = 0; face < b.face_count(); ++face)
        if (matcher.found_in_before[face] == no_id) add({FaceChange::Kind::added, no_id, face, 0.0, "added"});
    return changes;
}

std::vector<TypeChange> type_changes(const Level& before, const Level& after) {
    const auto find = [](const Level& level, const std::string& name) -> const SurfaceType* {
        for (const SurfaceType& type : level.surfaces)
            if (type.name == name) return &type;
        return nullptr;
    };
    std::vector<TypeChange> changes;
    for (const SurfaceType& was : before.surfaces) {
        const SurfaceType* const is = find(after, was.name);
        if (is == nullptr) {
            changes.push_back({was.name, "removed"});
            continue;
        }
        std::string text;
        for (const SurfaceField& field : surface_fields())
            if (const std::string a = field_text(was, field), b = field_text(*is, field); a != b)
                text += fmt::format("{}{} was {}, is {}", text.empty() ? "" : "; ", field.name, a, b);
        if (was.color != is->color || was.hatch != is->hatch)
            text += fmt::format("{}another color or hatch", text.empty() ? "" : "; ");
        if (!text.empty()) changes.push_back({was.name, text});
    }
    for (const SurfaceType& is : after.surfaces)
        if (find(before, is.name) == nullptr) changes.push_back({is.name, "added"});
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
