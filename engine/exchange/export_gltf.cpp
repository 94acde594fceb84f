#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "export_parts.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

using GltfJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int component_float = 5126, component_u32 = 5125;
constexpr int target_vertices = 34962, target_indices = 34963;

// Builds the scene's JSON and its binary buffer.
class GltfWriter {
  public:
    GltfWriter(const Level& level, const TypedMaterials& materials, fs::path folder)
        : level_(level), mesh_(*level.mesh), materials_(materials), folder_(std::move(folder)) {}

    void write(std::span<const GltfNode> nodes) {
        root_["asset"] = {{"version", "2.0"}, {"generator", "Slipface"}};
        root_["scene"] = 0;
        root_["scenes"] = {{{"nodes", {0}}, {"extras", {{"slipface_types", types_json()}}}}};
        root_["nodes"] = {{{"name", level_.mesh_path.stem().string()}, {"mesh", 0}}};
        for (const GltfNode& node : nodes) {
            const Vec3& at = node.position;
            root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
            root_["nodes"].push_back({{"name", node.name},
                                      {"translation", {at.x(), at.y(), at.z()}},
                                      {"extras", GltfJson::parse(node.extras, nullptr, false)}});
        }
        write_materials();
        write_primitives();
    }

    GltfJson root_ = GltfJson::object();
    std::string bytes_;

  private:
    GltfJson types_json() const {
        GltfJson types = GltfJson::array();
        for (const SurfaceType& type : level_.surfaces) {
            GltfJson json{{"name", type.name}};
            for (const SurfaceField& field : surface_fields()) {
                if (const auto* flag = std::get_if<bool SurfaceType::*>(&field.member)) {
                    json[field.name] = type.**flag;
                } else if (const auto* value = std::get_if<double SurfaceType::*>(&field.member)) {
                    json[field.name] = type.**value;
                } else if (const auto* vector = std::get_if<Vec3 SurfaceType::*>(&field.member)) {
                    const Vec3& v = type.**vector;
                    json[field.name] = {v.x(), v.y(), v.z()};
                } else if (const auto* maybe =
                               std::get_if<std::optional<double> SurfaceType::*>(&field.member)) {
                    if (type.**maybe) json[field.name] = *(type.**maybe);
                }
            }
            types.push_back(std::move(json));
        }
        return types;
    }

    void write_materials() {
        for (std::size_t i = 0; i < materials_.names.size(); ++i) {
            const Material& base = mesh_.materials[materials_.base[i]];
            const auto& type = materials_.of_type[i];
            const Vec3f color = type ? tinted(base.diffuse, level_.surfaces[*type]) : base.diffuse;
            GltfJson pbr{{"baseColorFactor", {color[0], color[1], color[2], 1.0}}, {"metallicFactor", 0.0}};
            if (const std::string uri = texture_from(level_, base, folder_); !uri.empty())
                pbr["baseColorTexture"] = {{"index", texture(uri)}};
            GltfJson material{{"name", materials_.names[i]}, {"pbrMetallicRoughness", std::move(pbr)}};
            if (type) material["extras"] = {{"slipface_type", level_.surfaces[*type].name}};
            root_["materials"].push_back(std::move(material));
        }
    }

    // The index of a texture, in the order of first use; each image once.
    std::size_t texture(const std::string& uri) {
        const auto known = std::find(uris_.begin(), uris_.end(), uri);
        const auto index = static_cast<std::size_t>(known - uris_.begin());
        if (known != uris_.end()) return index;
        uris_.push_back(uri);
        root_["images"].push_back({{"uri", uri}});
        root_["textures"].push_back({{"source", index}});
        return index;
    }

    void write_primitives() {
        const ResolvedSurfaces resolved = resolve_surfaces(level_);
        std::vector<std::vector<FaceId>> faces(materials_.names.size());
        for (FaceId face = 0; face < mesh_.face_count(); ++face)
            faces[materials_.face_name[face]].push_back(face);
        std::vector<std::uint32_t> number(mesh_.corner_vertex.size(), no_id);
        GltfJson primitives = GltfJson::array();
        for (std::size_t i = 0; i < faces.size(); ++i) {
            // Faces with the same entry of `materials_` have the same type.
            const std::string& type = level_.surfaces[resolved.surface[faces[i].front()]].name;
            GltfJson primitive = primitive_of(faces[i], number);
            primitive["material"] = i;
            primitive["extras"] = {{"slipface_type", type}};
            primitives.push_back(std::move(primitive));
        }
        root_["meshes"] = {{{"name", level_.mesh_path.stem().string()}, {"primitives", primitives}}};
        root_["buffers"] = {{{"byteLength", bytes_.size()}}};
    }

    GltfJson primitive_of(const std::vector<FaceId>& faces, std::vector<std::uint32_t>& number) {
        std::vector<std::uint32_t> corners, indices;
        for (const FaceId face : faces) {
            for (std::uint32_t t = mesh_.face_first_triangle[face]; t < mesh_.face_first_triangle[face + 1];
                 ++t) {
                for (const std::uint32_t corner : mesh_.triangles[t]) {
                    if (number[corner] == no_id) {
                        number[corner] = static_cast<std::uint32_t>(corners.size());
                        corners.push_back(corner);
                    }
                    indices.push_back(number[corner]);
                }
            }
        }
        GltfJson attributes{{"POSITION", positions(corners)}, {"TEXCOORD_0", uvs(corners)}};
        const std::size_t begin = bytes_.size();
        for (const std::uint32_t index : indices)
            put(index);
        return {{"attributes", std::move(attributes)},
                {"indices", accessor(begin, target_indices, component_u32, "SCALAR", indices.size())}};
    }

    std::size_t positions(const std::vector<std::uint32_t>& corners) {
        const std::size_t begin = bytes_.size();
        Vec3f low = mesh_.corner_position(corners.front());
        Vec3f high = low;
        for (const std::uint32_t corner : corners) {
            const Vec3f position = mesh_.corner_position(corner);
            low = low.cwiseMin(position);
            high = high.cwiseMax(position);
            for (const float coordinate : position)
                put(std::bit_cast<std::uint32_t>(coordinate));
        }
        const std::size_t index = accessor(begin, target_vertices, component_float, "VEC3", corners.size());
        root_["accessors"][index]["min"] = {low[0], low[1], low[2]};
        root_["accessors"][index]["max"] = {high[0], high[1], high[2]};
        return index;
    }

    // In glTF V points downwards.
    std::size_t uvs(const std::vector<std::uint32_t>& corners) {
        const std::size_t begin = bytes_.size();
        for (const std::uint32_t corner : corners) {
            put(std::bit_cast<std::uint32_t>(mesh_.corner_uv[corner].x()));
            put(std::bit_cast<std::uint32_t>(1.0F - mesh_.corner_uv[corner].y()));
        }
        return accessor(begin, target_vertices, component_float, "VEC2", corners.size());
    }

    std::size_t accessor(std::size_t begin, int target, int component, const char* type, std::size_t count) {
        // One array after the other: adding a key invalidates references to others.
        root_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", begin},
                                        {"byteLength", bytes_.size() - begin},
                                        {"target", target}});
        const std::size_t view = root_["bufferViews"].size() - 1;
        GltfJson& accessors = root_["accessors"];
        accessors.push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return accessors.size() - 1;
    }

    void put(std::uint32_t value) {
        for (int i = 0; i < 4; ++i)
            bytes_.push_back(static_cast<char>(value >> (8 * i)));
    }

    const Level& level_;
    const Mesh& mesh_;
    const TypedMaterials& materials_;
    fs::path folder_;
    std::vector<std::string> uris_;
};

std::string json_text(const GltfJson& root) {
    return root.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
}

std::string u32_text(std::size_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text.push_back(static_cast<char>(value >> (8 * i)));
    return text;
}

// Header, JSON chunk, binary chunk.
std::string glb_bytes(const GltfJson& root, const std::string& binary) {
    std::string json = json_text(root);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return "glTF" + u32_text(2) + u32_text(12 + 8 + json.size() + 8 + binary.size()) + u32_text(json.size()) +
           "JSON" + json + u32_text(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace

Status export_gltf(const Level& level, const fs::path& path) {
    return export_gltf(level, path, {});
}

Status export_gltf(const Level& level, const fs::path& path, std::span<const GltfNode> nodes) {
    if (Status status = check_target(level, path); !status) return status;
    const Result<TypedMaterials> materials = typed_materials(level, true);
    if (!materials) return materials.error();
    GltfWriter writer(level, *materials, path.parent_path());
    writer.write(nodes);
    if (to_lower(path.extension().string()) == ".glb")
        return write_file_atomic(path, glb_bytes(writer.root_, writer.bytes_));
    fs::path binary = path;
    binary.replace_extension(".bin");
    writer.root_["buffers"][0]["uri"] = binary.filename().string();
    if (Status status = write_file_atomic(binary, writer.bytes_); !status) return status;
    return write_file_atomic(path, json_text(writer.root_) + "\n");
}

}  // namespace slipface
