#include "face_match.h"

#include <fmt/format.h>

#include <algorithm>

#include "face_matcher.h"

namespace slipface {

namespace {

// Adds the unpainted faces after the painted ones, to `stored` and to the result.
PaintParts with_unpainted(const PaintParts& parts, std::vector<StoredOverride>& stored) {
    std::vector<StoredOverride> unpainted;
    for (const FaceKey& key : parts.unpainted.keys)
        unpainted.push_back({key, {}, {}, false});
    stored.insert(stored.begin() + static_cast<std::ptrdiff_t>(parts.of.size()), unpainted.begin(),
                  unpainted.end());
    PaintParts all = parts;
    all.of.insert(all.of.end(), parts.unpainted.of.begin(), parts.unpainted.of.end());
    all.guessed.resize(all.guessed.empty() ? 0 : all.of.size(), false);
    for (std::size_t i = 0; i < unpainted.size() && parts.outlines.count() == parts.of.size(); ++i)
        all.outlines.add_bytes(parts.unpainted.outlines.bytes(i));
    return all;
}

// The faces of these objects (object_name()) that are in their places are searched for.
void forget_stayed(const Mesh& mesh, const std::set<std::uint32_t>& objects, FollowedFaces& followed) {
    std::vector<bool> unclear;  // [group]
    for (const std::string& group : mesh.groups)
        unclear.push_back(objects.contains(object_name(group)));
    for (FaceId face = 0; face < followed.face.size(); ++face) {
        if (!followed.face[face] || followed.moved[face] || !unclear[mesh.face_group[face]]) continue;
        followed.face[face] = false;
        followed.types[face].reset();
        if (followed.of[face] != no_id) followed.painted[followed.of[face]] = false;
    }
    std::erase_if(followed.guessed, [&](FaceId face) { return !followed.face[face]; });
}

MatchedOverrides found_without_search(const FollowedFaces& followed) {
    MatchedOverrides result;
    result.overrides = followed.types;
    result.guessed = followed.guessed;
    result.summary.exact = followed.painted.size();
    return result;
}

}  // namespace

std::vector<StoredOverride> stored_overrides(const Level& level, PaintParts& parts) {
    std::vector<FaceId> faces;
    for (std::size_t face = 0; face < level.overrides.size(); ++face) {
        const std::optional<SurfaceId>& surface = level.overrides[face];
        if (surface && *surface < level.surfaces.size()) faces.push_back(static_cast<FaceId>(face));
    }
    const Mesh& mesh = mesh_with(level, faces);
    std::vector<StoredOverride> stored;
    stored.reserve(faces.size() + level.orphans.size());
    std::vector<FaceKey> keys = face_keys(mesh, faces);
    parts = paint_parts(mesh, level.surfaces, faces, keys);
    for (std::size_t i = 0; i < faces.size(); ++i)
        stored.push_back({std::move(keys[i]), level.surfaces[*level.overrides[faces[i]]].name, {}});
    parts.guessed = which_of(faces, level.guessed);
    for (const Orphan& orphan : level.orphans)
        stored.push_back({orphan.key, orphan.type, {}});
    return stored;
}

std::vector<bool> which_of(std::span<const FaceId> faces, std::span<const FaceId> set) {
    std::vector<bool> result(faces.size());
    for (std::size_t i = 0; i < faces.size() && !set.empty(); ++i)
        result[i] = std::binary_search(set.begin(), set.end(), faces[i]);
    return result;
}

const Mesh& mesh_with(const Level& level, std::span<const FaceId> faces) {
    const Mesh& own = *own_mesh(level);
    return faces.empty() || faces.back() < own.face_count() ? own : *level.mesh;
}

MatchedOverrides match_overrides(const Level& level, const std::vector<StoredOverride>& stored,
                                 const PaintParts& parts) {
    // Faces of props may be like faces of the level that a part could have moved to.
    const bool all_own =
        !has_instances(level) ||
        match_overrides(*own_mesh(level), level.surfaces, stored, {}).summary.exact == stored.size();
    if (all_own) return match_overrides(*own_mesh(level), level.surfaces, stored, parts);
    MatchedOverrides all = match_overrides(*level.mesh, level.surfaces, stored, parts);
    while (all.overrides.size() > own_mesh(level)->face_count() && !all.overrides.back())
        all.overrides.pop_back();
    return all;
}

MatchedOverrides match_overrides(const Mesh& mesh, SurfaceTable surfaces,
                                 const std::vector<StoredOverride>& stored, const PaintParts& parts) {
    if (stored.empty()) {
        MatchedOverrides result;
        result.overrides.resize(mesh.face_count());
        return result;
    }
    const VertexMotions of_vertices = motions_of_vertices(mesh, parts);
    FollowedReadings followed = follow_faces(mesh, surfaces, stored, parts, of_vertices);
    const auto all_followed = [&](const FollowedFaces& faces) { return faces.are_all(parts.of.size()); };
    std::optional<FaceLookup> lookup;
    PartMotions motions;
    std::vector<StoredOverride> with_unpainted_faces;
    std::optional<PaintParts> parts_of_all;
    const bool all_known =
        all_followed(followed.first) && (!followed.second || all_followed(*followed.second));
    if (!all_known || stored.size() != parts.of.size()) lookup.emplace(mesh, surfaces);
    if (!all_known && !parts.parts.empty()) {
        motions = find_motions(*lookup, surfaces, parts, stored, of_vertices);
        forget_stayed(mesh, motions.unclear_objects, followed.first);
        if (followed.second) forget_stayed(mesh, motions.unclear_objects, *followed.second);
        with_unpainted_faces = stored;
        if (!parts.unpainted.keys.empty()) parts_of_all = with_unpainted(parts, with_unpainted_faces);
    }
    const std::vector<PartMotion> staying;
    const auto read = [&](const FollowedFaces& faces, const std::vector<PartMotion>& moved) {
        const bool all_found = all_followed(faces);
        if (all_found && stored.size() == parts.of.size()) return found_without_search(faces);
        const bool all = parts_of_all && !all_found;
        FaceMatcher matcher(mesh, surfaces, all ? with_unpainted_faces : stored, *lookup,
                            all ? *parts_of_all : parts, all_found ? staying : moved);
        matcher.take(faces);
        return std::move(matcher).run();
    };
    MatchedOverrides result = read(followed.first, motions.first);
    if (!followed.second && motions.second.empty()) return result;
    const MatchedOverrides second = read(followed.second ? *followed.second : followed.first,
                                         motions.second.empty() ? motions.first : motions.second);
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        if (result.overrides[face] == second.overrides[face]) continue;
        result.second.faces.push_back(face);
        result.second.types.push_back(second.overrides[face]);
    }
    return result;
}

FaceKeySets stored_face_keys(const Level& level) {
    // Keys of all sets at once, because numbering the copies examines the whole mesh.
    std::vector<FaceId> faces = level.hidden;
    for (const SavedSelection& saved : level.selections)
        faces.insert(faces.end(), saved.faces.begin(), saved.faces.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    faces.erase(std::lower_bound(faces.begin(), faces.end(), level.mesh.face_count()), faces.end());
    const std::vector<FaceKey> keys =
        faces.empty() ? std::vector<FaceKey>() : face_keys(mesh_with(level, faces), faces);
    const auto of = [&](const std::vector<FaceId>& set) {
        std::vector<FaceKey> result;
        result.reserve(set.size());
        for (const FaceId face : set) {
            const auto found = std::lower_bound(faces.begin(), faces.end(), face);
            if (found != faces.end() && *found == face)
                result.push_back(keys[static_cast<std::size_t>(found - faces.begin())]);
        }
        return result;
    };
    FaceKeySets sets{of(level.hidden)};
    for (const SavedSelection& saved : level.selections)
        sets.push_back(of(saved.faces));
    return sets;
}

Warnings match_stored_faces(Level& level, const FaceKeySets& sets) {
    level.hidden.clear();
    for (SavedSelection& saved : level.selections)
        saved.faces.clear();
    Warnings warnings;
    std::optional<FaceLookup> in_own, in_whole;
    const auto find = [&](const Mesh& mesh, std::optional<FaceLookup>& lookup,
                          const std::vector<StoredOverride>& stored) {
        if (!lookup) lookup.emplace(mesh, level.surfaces);
        return FaceMatcher(mesh, level.surfaces, stored, *lookup).run();
    };
    for (std::size_t i = 0; i < sets.size() && i <= level.selections.size(); ++i) {
        if (sets[i].empty()) continue;
        std::vector<StoredOverride> stored;
        stored.reserve(sets[i].size());
        for (const FaceKey& key : sets[i])
            stored.push_back({key, level.surfaces.front().name, {}});  // any type, the same for all
        MatchedOverrides matched = find(*own_mesh(level), in_own, stored);
        if (has_instances(level) && matched.summary.exact < stored.size())
            matched = find(*level.mesh, in_whole, stored);
        std::vector<FaceId>& faces = i == 0 ? level.hidden : level.selections[i - 1].faces;
        for (FaceId face = 0; face < matched.overrides.size(); ++face)
            if (matched.overrides[face]) faces.push_back(face);
        if (matched.orphans.empty()) continue;
        const std::string set = i == 0 ? std::string("hidden")
                                       : fmt::format("of the selection \"{}\"", level.selections[i - 1].name);
        warnings.push_back({"", fmt::format("{} of the {} faces {} no longer exist; they are dropped",
                                            matched.orphans.size(), sets[i].size(), set)});
    }
    return warnings;
}

}  // namespace slipface
