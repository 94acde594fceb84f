#include "slipface/mesh/formats.h"

#include <array>

#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::array<MeshFormat, 13> formats{{
    {"obj", "Wavefront OBJ"},
    {"bsp", "Quake 3 map"},
    {"gltf", "glTF"},
    {"glb", "glTF"},
    {"fbx", "FBX"},
    {"ply", "PLY"},
    {"3ds", "3D Studio"},
    {"dae", "COLLADA"},
    {"lwo", "LightWave"},
    {"x", "DirectX"},
    {"ac", "AC3D"},
    {"stl", "STL"},
    {"off", "OFF"},
}};

}  // namespace

std::span<const MeshFormat> mesh_formats() {
    return formats;
}

const MeshFormat* mesh_format_of(const std::filesystem::path& path) {
    const std::string extension = to_lower(path.extension().string());
    for (const MeshFormat& format : formats)
        if (extension.size() == format.ending.size() + 1 && extension.ends_with(format.ending))
            return &format;
    return nullptr;
}

std::string mesh_formats_text() {
    std::string text;
    for (std::size_t i = 0; i < formats.size(); ++i) {
        if (i > 0) text += i + 1 == formats.size() ? " or " : ", ";
        text += "*." + std::string(formats[i].ending);
    }
    return text;
}

}  // namespace slipface
