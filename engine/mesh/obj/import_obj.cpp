#include "obj/import_obj.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "obj/material_library.h"
#include "obj/obj_parallel.h"
#include "obj/obj_scan.h"
#include "obj/obj_text.h"

namespace slipface {
namespace {

// Appends the corners of `mesh` to `soup`. Returns false if a face differs from the scan.
bool add_corners(const aiMesh& mesh, const std::vector<std::uint32_t>& face_first_corner, std::size_t& face,
                 PolygonSoup& soup) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i, ++face) {
        const aiFace& polygon = mesh.mFaces[i];
        if (face + 1 >= face_first_corner.size() ||
            polygon.mNumIndices != face_first_corner[face + 1] - face_first_corner[face]) {
            return false;
        }
        for (unsigned k = 0; k < polygon.mNumIndices; ++k) {
            const unsigned vertex = polygon.mIndices[k];
            const aiVector3D& position = mesh.mVertices[vertex];
            soup.corner_position.emplace_back(position.x, position.y, position.z);
            if (!mesh.HasTextureCoords(0)) continue;
            const aiVector3D& uv = mesh.mTextureCoords[0][vertex];
            soup.corner_uv.emplace_back(uv.x, uv.y);
        }
    }
    return true;
}

// The clean text has no objects, groups or materials of the file: assimp would make a mesh of thousands of
// bytes for each and search their names linearly. So faces come back in the order in which they were written.
Status read_polygons(const ObjScan& scan, const std::string& location, PolygonSoup& soup) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(scan.clean.data(), scan.clean.size(), 0, "obj");
    if (scene == nullptr)
        return Error{location, fmt::format("assimp cannot read it: {}", importer.GetErrorString())};

    soup.corner_position.reserve(scan.face_first_corner.back());
    if (scene->mNumMeshes > 0 && scene->mMeshes[0]->HasTextureCoords(0)) {
        soup.corner_uv.reserve(scan.face_first_corner.back());
    }
    std::size_t face = 0;
    bool fits = true;
    for (unsigned i = 0; i < scene->mNumMeshes && fits; ++i) {
        fits = add_corners(*scene->mMeshes[i], scan.face_first_corner, face, soup);
    }
    if (fits && face + 1 == scan.face_first_corner.size()) return {};
    return Error{location, fmt::format("assimp reads other polygons than the {} in the file",
                                       scan.face_material.size())};
}

std::vector<Material> materials_of(const std::filesystem::path& path, const std::vector<NameOnLine>& names,
                                   const std::vector<NameOnLine>& libraries, WarningList& warnings) {
    MaterialsByName known;
    const bool any_library = load_libraries(path, libraries, known, warnings);
    std::vector<Material> materials;
    materials.reserve(names.size());
    for (const NameOnLine& used : names) {
        const auto found = known.find(used.name);
        materials.push_back(found != known.end() ? found->second : named_material(used.name));
        if (found == known.end() && any_library && !used.name.empty()) {
            warnings.add(
                fmt::format("{}:{}", path.string(), used.line),
                fmt::format("material {} is in no material library: grey is used", in_quotes(used.name)));
        }
    }
    return materials;
}

// Reads any OBJ, line by line and through assimp.
Result<PolygonSoup> read_carefully(const std::filesystem::path& path, std::string text,
                                   WarningList& warnings) {
    const std::string location = path.string();
    auto scan = scan_obj(std::move(text), location, warnings);
    if (!scan) return scan.error();

    PolygonSoup soup;
    if (const auto status = read_polygons(*scan, location, soup); !status) return status.error();
    std::string().swap(scan->clean);
    soup.materials = materials_of(path, scan->materials, scan->libraries, warnings);
    soup.face_first_corner = std::move(scan->face_first_corner);
    soup.face_material = std::move(scan->face_material);
    soup.face_group = std::move(scan->face_group);
    for (NameOnLine& group : scan->groups)
        soup.groups.push_back(std::move(group.name));
    return soup;
}

}  // namespace

Result<ImportedObj> import_obj(const std::filesystem::path& path, std::string text, WarningList& warnings,
                               Progress* progress) {
    if (auto polygons = read_ordinary_obj(text, progress)) {
        std::string().swap(text);
        polygons->soup.materials = materials_of(path, polygons->materials, polygons->libraries, warnings);
        return ImportedObj{std::move(polygons->soup), false};
    }
    if (cancelled(progress)) return cancelled_error(path);
    auto soup = read_carefully(path, std::move(text), warnings);
    if (!soup) return soup.error();
    return ImportedObj{std::move(*soup), true};
}

}  // namespace slipface
