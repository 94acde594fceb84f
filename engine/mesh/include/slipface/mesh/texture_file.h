// Finds the image files that a mesh's materials name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slipface/mesh/mesh.h"

namespace slipface {

// Whether images outside the level's folder may be opened. A level from elsewhere must not make the program
// open any file that it names, so the user must allow it.
enum class TextureAccess : std::uint8_t { folder, anywhere };

struct FoundTexture {
    std::optional<std::filesystem::path> path;
    bool refused = false;  // a matching image exists, but outside the folder
};

// Finds the image `authored` relative to `folder`. Windows tools write backslashes, and many write paths of
// their own machine: so the file name alone is tried in `folder` next. `path` is empty if neither exists.
FoundTexture find_texture(const std::string& authored, const std::filesystem::path& folder,
                          TextureAccess access);

// For messages: material "stone", or a material without a name.
std::string location_of(const Material& material);

// The existing images outside `folder` that the mesh's materials name, each once, in the order of the
// materials.
std::vector<std::string> outside_textures(const Mesh& mesh, const std::filesystem::path& folder);

}  // namespace slipface
