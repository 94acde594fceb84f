// Faces that names, order and joints prove.

#include "match_order.h"

#include <algorithm>

#include "correspondence.h"
#include "face_matcher.h"

namespace slipface {

FollowedReadings follow_faces(const Mesh& mesh, SurfaceTable surfaces, std::span<const StoredOverride> stored,
                              const PaintParts& parts, const VertexMotions& of_vertices) {
    if (parts.tokens.empty()) return {};
    const MeshTokens now = mesh_tokens(mesh, surfaces);
    const std::size_t painted = std::min(parts.token.size(), stored.size());
    std::vector<std::uint32_t> stored_at(parts.tokens.faces.size(), no_id);  // [old token]
    std::vector<std::optional<Vec3>> went(parts.tokens.faces.size());
    for (std::uint32_t i = 0; i < painted; ++i) {
        stored_at[parts.token[i]] = i;
        const std::size_t part = parts.of[i];
        if (part > 0 && part <= of_vertices.size() && of_vertices[part - 1])
            went[parts.token[i]] = (*of_vertices[part - 1])(stored[i].key.centroid);
    }
    const Correspondence known = correspond(parts.tokens, now, went);
    std::vector<std::optional<SurfaceId>> types;  // [painted]
    for (std::size_t i = 0; i < painted; ++i)
        types.push_back(type_of(surfaces, stored[i].type));
    // Nothing: an unpainted face.
    const auto type_at = [&](std::uint32_t token) {
        const std::uint32_t i = token == no_id ? no_id : stored_at[token];
        return i == no_id ? std::optional<SurfaceId>() : types[i];
    };
    const auto read = [&](const std::vector<std::uint32_t>& befores,
                          const std::vector<std::uint32_t>& rivals) {
        FollowedFaces followed;
        followed.face.resize(mesh.face_count(), false);
        followed.moved.resize(mesh.face_count(), false);
        followed.types.resize(mesh.face_count());
        followed.of.resize(mesh.face_count(), no_id);
        followed.painted.resize(painted, false);
        std::vector<bool> found(parts.tokens.faces.size(), false);  // [old token]
        for (std::uint32_t token = 0; token < now.faces.size(); ++token) {
            const std::uint32_t before = befores[token];
            if (before == no_id) continue;
            const std::uint32_t i = stored_at[before];
            if (i != no_id && !types[i]) continue;  // an orphan for want of its type
            const FaceId face = now.face[token];
            found[before] = followed.face[face] = true;
            followed.moved[face] = known.moved[token];
            followed.types[face] = type_at(before);
            if (i == no_id) continue;
            followed.of[face] = i;
            followed.painted[i] = true;
            if ((i < parts.guessed.size() && parts.guessed[i]) || known.open[token] ||
                followed.types[face] != type_at(rivals[token]))
                followed.guessed.push_back(face);
        }
        for (const std::uint32_t token : parts.unpainted.token)
            followed.unpainted.push_back(found[token]);
        std::sort(followed.guessed.begin(), followed.guessed.end());
        return followed;
    };
    FollowedReadings readings{read(known.before, known.rival), {}};
    if (known.rival != known.before) readings.second = read(known.rival, known.before);
    return readings;
}

bool FollowedFaces::are_all(std::size_t painted_faces) const {
    return painted.size() == painted_faces &&
           std::find(painted.begin(), painted.end(), false) == painted.end();
}

void FaceMatcher::take(const FollowedFaces& followed) {
    moved_here_ = followed.moved;
    for (FaceId face = 0; face < followed.face.size(); ++face) {
        if (!followed.face[face]) continue;
        claims_[face] = MatchStage::exact;
        result_.overrides[face] = followed.types[face] ? followed.types[face] : unpainted_;
    }
    result_.guessed = followed.guessed;
    const std::size_t painted = followed.painted.size();
    for (std::size_t i = 0; i < painted; ++i)
        if (followed.painted[i]) found_[i] = MatchStage::exact;
    for (std::size_t k = 0; k < followed.unpainted.size() && painted + k < stored_.size(); ++k)
        if (followed.unpainted[k] && !stored_[painted + k].painted) found_[painted + k] = MatchStage::exact;
}

}  // namespace slipface
