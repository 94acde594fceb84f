#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "export_parts.h"
#include "pictures_beside.h"
#include "slipface/base/parallel.h"
#include "slipface/base/system.h"

namespace slipface {

namespace fs = std::filesystem;

std::string texture_from(const Level& level, const Material& material, const fs::path& folder) {
    if (material.texture.empty()) return {};
    std::error_code error;
    const fs::path texture = fs::absolute(level.mesh_path.parent_path() / path_of(material.texture), error);
    const fs::path relative = texture.lexically_normal().lexically_relative(
        fs::absolute(folder.empty() ? fs::path(".") : folder, error).lexically_normal());
    return relative.empty() ? texture.generic_string() : relative.generic_string();
}

bool textured(const Mesh& mesh) {
    return std::any_of(mesh.corner_uv.begin(), mesh.corner_uv.end(),
                       [](const Vec2f& uv) { return !uv.isZero(0.0F); });
}

namespace {

std::string mtl_text(const Level& level, const TypedMaterials& materials, PicturesBeside& beside) {
    std::map<const std::string*, std::string> written;
    std::string text = "# materials of the level, named MATERIAL__TYPE\n";
    for (std::size_t i = 0; i < materials.names.size(); ++i) {
        if (materials.names[i].empty()) continue;
        const Material& base = level.mesh->materials[materials.base[i]];
        const Vec3f color =
            materials.of_type[i] ? tinted(base.diffuse, level.surfaces[*materials.of_type[i]]) : base.diffuse;
        text += fmt::format("\nnewmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", materials.names[i], color[0], color[1],
                            color[2]);
        std::string texture;
        if (base.picture) {
            const auto [name, added] = written.try_emplace(base.picture.get());
            if (added) name->second = beside.add(base.texture, *base.picture).string();
            texture = name->second;
        } else {
            texture = texture_from(level, base, beside.folder());
        }
        if (!texture.empty()) text += "map_Kd " + texture + "\n";
    }
    return text;
}

// Adds the vertices, those of each object by themselves, as modelling tools write and number them. Returns
// the number of each corner's.
std::vector<std::uint32_t> add_vertices(const Mesh& mesh, std::string& text) {
    struct Vertex {
        std::uint32_t in_file, vertex, corner;
    };
    std::vector<std::uint32_t> numbers(mesh.corner_vertex.size());
    std::vector<Vertex> vertices;  // of one group, once for each corner
    std::uint32_t count = 0;
    const auto write_group = [&] {
        std::sort(vertices.begin(), vertices.end(), [](const Vertex& a, const Vertex& b) {
            return std::pair(a.in_file, a.corner) < std::pair(b.in_file, b.corner);
        });
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            if (i == 0 || vertices[i].vertex != vertices[i - 1].vertex) {
                const Vec3f& p = mesh.positions[vertices[i].vertex];
                fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x(), p.y(), p.z());
                ++count;
            }
            numbers[vertices[i].corner] = count;
        }
        vertices.clear();
    };
    std::uint32_t group = 0;
    for (const FaceId face : faces_by_group(mesh)) {
        if (mesh.face_group[face] != group) write_group();
        group = mesh.face_group[face];
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c)
            vertices.push_back(
                {mesh.number_in_group(group, mesh.corner_vertex[c]), mesh.corner_vertex[c], c});
    }
    write_group();
    return numbers;
}

// `numbers`: of the corners' vertices.
void add_face(const Mesh& mesh, FaceId face, const std::vector<std::uint32_t>& numbers, bool with_uv,
              std::string& text) {
    text += 'f';
    for (std::uint32_t corner = mesh.face_first_corner[face]; corner < mesh.face_first_corner[face + 1];
         ++corner) {
        fmt::format_to(std::back_inserter(text), " {}", numbers[corner]);
        if (with_uv) fmt::format_to(std::back_inserter(text), "/{}", corner + 1);
    }
    text += '\n';
}

std::string obj_text(const Level& level, const TypedMaterials& materials, const std::string& library) {
    const Mesh& mesh = *level.mesh;
    std::string text = "mtllib " + library + "\n";
    const std::vector<std::uint32_t> numbers = add_vertices(mesh, text);
    const bool with_uv = textured(mesh);
    if (with_uv)
        for (const Vec2f& uv : mesh.corner_uv)
            fmt::format_to(std::back_inserter(text), "vt {} {}\n", uv.x(), uv.y());
    std::uint32_t group = no_id;
    std::uint32_t name = no_id;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        if (mesh.face_group[face] != group) {
            group = mesh.face_group[face];
            if (!mesh.groups[group].empty()) text += "o " + mesh.groups[group] + "\n";
            name = no_id;  // said again for readers that forget it at a new object
        }
        if (materials.face_name[face] != name) {
            name = materials.face_name[face];
            const std::string& wanted = materials.names[name];
            text += "usemtl " + (wanted.empty() ? std::string("none") : wanted) + "\n";
        }
        add_face(mesh, face, numbers, with_uv, text);
    }
    return text;
}

}  // namespace

Result<std::vector<ExportedFile>> obj_files(const Level& level, const fs::path& path) {
    const Result<TypedMaterials> materials = typed_materials(level, true);
    if (!materials) return materials.error();
    fs::path library = path;
    library.replace_extension(".mtl");
    PicturesBeside beside(path);
    std::string mtl = mtl_text(level, *materials, beside);
    std::string obj = obj_text(level, *materials, library.filename().string());
    std::vector<ExportedFile> files = beside.take();
    files.push_back({library, std::move(mtl)});
    files.push_back({path, std::move(obj)});
    return files;
}

}  // namespace slipface
