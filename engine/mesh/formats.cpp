#include "slipface/mesh/formats.h"

#include <array>

#include "assimp/import_scene.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t own_readers = 4;  // the first formats; assimp reads the others
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
    return std::span(formats).first(reads_scenes() ? formats.size() : own_readers);
}

const MeshFormat* mesh_format_of(const std::filesystem::path& path) {
    const std::string extension = to_lower(path.extension().string());
    for (const MeshFormat& format : mesh_formats())
        if (extension.size() == format.ending.size() + 1 && extension.ends_with(format.ending))
            return &format;
    return nullptr;
}

std::string mesh_formats_text() {
    const std::span<const MeshFormat> readable = mesh_formats();
    std::string text;
    for (std::size_t i = 0; i < readable.size(); ++i) {
        if (i > 0) text += i + 1 == readable.size() ? " or " : ", ";
        text += "*." + std::string(readable[i].ending);
    }
    return text;
}

}  // namespace slipface
