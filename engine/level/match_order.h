// Painted faces that need no search, because names, order and joints prove which faces they are.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "face_match.h"

namespace slipface {

struct FollowedFaces {
    std::vector<bool> face;                       // [face] it is known which old one it was
    std::vector<bool> moved;                      // [face] of these: from another place
    std::vector<std::optional<SurfaceId>> types;  // [face] of these; nothing: it was not painted
    std::vector<FaceId> guessed;                  // ascending; another type is as possible
    std::vector<std::uint32_t> of;                // [face] the painted one that it was; or no_id
    std::vector<bool> painted;                    // [painted face] found
    std::vector<bool> unpainted;                  // [PaintParts::unpainted] found

    bool are_all(std::size_t painted_faces) const;
};

struct FollowedReadings {
    FollowedFaces first;
    std::optional<FollowedFaces> second;  // if names and order can be read in two ways
};

// None in a level file without tokens. `stored`: the painted faces of `parts`, and others after them.
FollowedReadings follow_faces(const Mesh& mesh, SurfaceTable surfaces, std::span<const StoredOverride> stored,
                              const PaintParts& parts, const VertexMotions& of_vertices);

}  // namespace slipface
