// A level at the time when a golden was approved: geometry and surface types, small enough to be stored
// beside the goldens. With it a check can name the changed faces and simulate in the old level.
#pragma once

#include <string>
#include <string_view>

#include "slipface/level/level.h"

namespace slipface {

inline constexpr std::size_t max_digest_triangles = 300'000;  // larger levels have none

// The level file's text without its painted faces.
std::string annotations_json(const Level& level);

// A hash of what a mesh looks like beside its geometry: texture coordinates and materials.
std::uint64_t appearance_hash(const Mesh& mesh);

// "easy-1f2e3d4c5b6a7988": the name of the level and a hash of its geometry, its appearance and its level
// file, in which the painted faces are replaced by the resolved types of all faces. Equal names mean equal
// digests.
std::string digest_name(const Level& level);

// The digest's bytes. Errors: no geometry; more than max_digest_triangles.
Result<std::string> encode_digest(const Level& level);

// The level in a digest. Its overrides are the resolved types, and `mesh_path` is empty. Error: bytes that
// are no valid digest; every index is checked.
Result<Level> decode_digest(std::string_view bytes, const std::string& location);

}  // namespace slipface
