// Where the pictures that a mesh's materials name are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slipface/mesh/mesh.h"

namespace slipface {

// Whether pictures outside the level's folder may be opened: a level from elsewhere must not make the program
// open any file it names, so the user is asked.
enum class TextureAccess : std::uint8_t { folder, anywhere };

struct FoundTexture {
    std::optional<std::filesystem::path> path;
    bool refused = false;  // the picture that was meant lies outside the folder
};

// Windows tools write backslashes, and many write the path of the machine they ran on: then the file's name
// alone is tried beside the level.
FoundTexture find_texture(const std::string& authored, const std::filesystem::path& folder,
                          TextureAccess access);

// The pictures that the mesh's materials name outside `folder` and that are there, each once, in the order of
// the materials.
std::vector<std::string> outside_textures(const Mesh& mesh, const std::filesystem::path& folder);

}  // namespace slipface
