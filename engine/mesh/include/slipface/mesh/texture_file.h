// Finds and reads the images that a mesh's materials name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

struct FoundTexture {
    std::optional<std::filesystem::path> path;
    bool refused = false;  // a matching image exists, but outside the folder
};

// Finds the image `authored` relative to `folder`, by the rule of named_file(). Windows tools write
// backslashes, and many write paths of their own machine: so the file name alone is tried next, in the
// folders on the way and in `folder`. `path` is empty if there is none.
FoundTexture find_texture(const std::string& authored, const std::filesystem::path& folder);

struct TextureBytes {
    std::string bytes;           // of an image file in any format; decode_image() reads them
    std::filesystem::path file;  // empty: the material has the picture itself
    std::string location;        // of the image, for messages
    std::string note;            // empty, or what to tell the user although there is a picture
};

// The image of a material that names a texture: its own picture, or the file in `folder` or below. Errors,
// whose location is the material: no such image, one outside the folder, one that cannot be read or is larger
// than 512 MiB.
Result<TextureBytes> read_texture(const Material& material, const std::filesystem::path& folder);

// For messages: material "stone", or a material without a name.
std::string location_of(const Material& material);

}  // namespace slipface
