#include "assimp/import_scene.h"

#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cmath>
#include <utility>

#include "assimp/scene_child.h"
#include "assimp/scene_frame.h"
#include "assimp/scene_materials.h"
#include "assimp/scene_rig.h"
#include "folder_io.h"
#include "gltf/import_gltf.h"
#include "material_names.h"
#include "obj/declared_counts.h"
#include "obj/obj_text.h"
#include "scene_nodes.h"
#include "slipface/base/counted.h"
#include "slipface/mesh/import.h"

namespace slipface {
namespace {

constexpr std::size_t max_faces = std::size_t{1} << 26;
constexpr float largest_coordinate = 1e7F;  // metres

// Names that assimp makes up: of a root above the file's own objects, and of the steps of an FBX object's
// transformation.
bool is_made_up(const aiNode& node) {
    const std::string_view name(node.mName.C_Str());
    return (node.mParent == nullptr && (name == "ROOT" || name == "RootNode" || name.starts_with('<'))) ||
           name.find("_$AssimpFbx$_") != std::string_view::npos;
}

// True if `second` has the corners of `first`, backwards.
bool is_back_of(const aiMesh& mesh, const aiFace& first, const aiFace& second) {
    const unsigned count = first.mNumIndices;
    if (second.mNumIndices != count) return false;
    const auto at = [&](const aiFace& face, unsigned k) -> const aiVector3D* {
        return face.mIndices[k] < mesh.mNumVertices ? &mesh.mVertices[face.mIndices[k]] : nullptr;
    };
    for (unsigned shift = 0; shift < count; ++shift) {
        unsigned k = 0;
        for (; k < count; ++k) {
            const aiVector3D *const a = at(first, k), *const b = at(second, (count + shift - k) % count);
            if (a == nullptr || b == nullptr || *a != *b) break;
        }
        if (k == count) return true;
    }
    return false;
}

class SceneReader {
  public:
    SceneReader(const aiScene& scene, const SceneFrame& frame, const std::string& extension,
                const std::string& location, WarningList& warnings)
        : scene_(scene),
          root_is_frame_(frame.root_is_frame),
          two_sided_twice_(extension == "ac" && aiGetVersionMajor() >= 6),
          location_(location),
          warnings_(warnings),
          materials_(scene_materials(scene, extension)),
          nodes_(scene_nodes(scene, frame.root_is_frame)),
          rig_(scene, nodes_) {}

    Result<PolygonSoup> run() {
        for (const SceneMaterial& material : materials_)
            soup_.materials.push_back(material.material);
        soup_.face_first_corner.push_back(0);

        std::vector<std::uint32_t> object_of(nodes_.size(), no_id);
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const SceneNode& node = nodes_[i];
            const std::uint32_t parent = node.parent == no_id ? no_id : object_of[node.parent];
            object_of[i] = parent;
            const bool skipped = root_is_frame_ && node.parent == no_id;
            if (node.node->mNumMeshes == 0 && (skipped || is_made_up(*node.node))) continue;
            object_of[i] = static_cast<std::uint32_t>(soup_.nodes.size());
            soup_.nodes.push_back({.name = text_of(node.node->mName), .parent = parent});
            for (unsigned row = 0; row < 4; ++row)
                for (unsigned column = 0; column < 4; ++column)
                    soup_.nodes.back().world(row, column) = node.world[row][column];
            if (node.node->mNumMeshes == 0) continue;
            if (auto status = add_node(i, object_of[i]); !status) return status.error();
        }
        if (soup_.face_material.empty()) return Error{location_, "has no faces"};
        if (dropped_ > 0)
            warnings_.add(location_, fmt::format("dropped {} of {}",
                                                 counted(dropped_, "point or line", "points and lines"),
                                                 counted(meshes_with_dropped_, "mesh", "meshes")));
        drop_empty_nodes(soup_, shapes_);
        soup_.rig = rig_.take();
        return std::move(soup_);
    }

  private:
    Status add_node(std::uint32_t index, std::uint32_t number) {
        const aiNode& node = *nodes_[index].node;
        MeshNode& object = soup_.nodes[number];
        if (object.group == no_id) {
            object.group = static_cast<std::uint32_t>(soup_.groups.size());
            soup_.groups.push_back(object.name);
        }
        group_ = object.group;
        shapes_[number].insert(shapes_[number].end(), node.mMeshes, node.mMeshes + node.mNumMeshes);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= scene_.mNumMeshes)
                return Error{location_, "a node refers to a missing mesh"};
            if (auto status = add_mesh(*scene_.mMeshes[node.mMeshes[i]], index); !status) return status;
        }
        return {};
    }

    Status add_mesh(const aiMesh& mesh, std::uint32_t node) {
        rig_.begin_mesh(mesh, node);
        const bool mirrored = rig_.mirrored();
        const unsigned number = std::min(mesh.mMaterialIndex, std::max(scene_.mNumMaterials, 1U) - 1);
        static const SceneMaterial none;
        const SceneMaterial& material = number < materials_.size() ? materials_[number] : none;
        const std::size_t dropped_before = dropped_;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices < 3) {
                ++dropped_;
                continue;
            }
            if (two_sided_twice_ && i > 0 && is_back_of(mesh, mesh.mFaces[i - 1], face)) continue;
            // A polygon may visit a vertex twice, where a bridge leads to a hole in it.
            if (face.mNumIndices > 3 + 2 * std::uint64_t{mesh.mNumVertices})
                return Error{
                    location_,
                    fmt::format("face {} of mesh {} has {} corners, but the mesh has {} vertices", i,
                                in_quotes(text_of(mesh.mName)), face.mNumIndices, mesh.mNumVertices)};
            if (soup_.face_material.size() == max_faces)
                return Error{location_, fmt::format("has more than {} faces", max_faces)};
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                // A mirroring transformation reverses the winding; reading the polygon backwards preserves
                // its front.
                const unsigned vertex = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
                if (auto status = add_corner(mesh, vertex, material); !status) return status;
            }
            soup_.face_first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_position.size()));
            soup_.face_material.push_back(number);
            soup_.face_group.push_back(group_);
        }
        if (dropped_ > dropped_before) ++meshes_with_dropped_;
        return {};
    }

    Status add_corner(const aiMesh& mesh, unsigned vertex, const SceneMaterial& material) {
        if (vertex >= mesh.mNumVertices) {
            return Error{location_, fmt::format("index {} is out of range; mesh {} has {} vertices", vertex,
                                                in_quotes(text_of(mesh.mName)), mesh.mNumVertices)};
        }
        const aiVector3D position = rig_.placed(vertex);
        rig_.add_corner(vertex);
        soup_.corner_position.emplace_back(position.x, position.y, position.z);
        if (!(soup_.corner_position.back().cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <=
              largest_coordinate)) {
            return Error{location_, fmt::format("vertex {} of mesh {} is not within {} m of the origin",
                                                vertex, in_quotes(text_of(mesh.mName)), largest_coordinate)};
        }
        const unsigned set = mesh.HasTextureCoords(material.uv_set) ? material.uv_set : 0;
        Vec2f uv = Vec2f::Zero();
        if (mesh.HasTextureCoords(set)) {
            const aiVector3D& at = mesh.mTextureCoords[set][vertex];
            uv = material.uv_transform * Vec3f(at.x, at.y, 1.0F);
        }
        soup_.corner_uv.push_back(uv.allFinite() ? uv : Vec2f(0, 0));
        return {};
    }

    const aiScene& scene_;
    const bool root_is_frame_;    // assimp corrects axes and unit there; this code does so itself
    const bool two_sided_twice_;  // assimp 6 gives a two-sided polygon of AC3D a second time, backwards
    const std::string& location_;
    WarningList& warnings_;
    const std::vector<SceneMaterial> materials_;
    const std::vector<SceneNode> nodes_;
    SceneRig rig_;
    PolygonSoup soup_;
    std::size_t dropped_ = 0, meshes_with_dropped_ = 0;  // faces of fewer than three corners
    std::uint32_t group_ = 0;                            // of the faces being added
    NodeShapes shapes_;                                  // meshes of each node
};

class CancelledByProgress final : public Assimp::ProgressHandler {
  public:
    explicit CancelledByProgress(Progress* progress) : progress_(progress) {}
    bool Update(float fraction) override {
        if (fraction >= 0.0F) advance(progress_, std::min(fraction, 1.0F));
        return !cancelled(progress_);
    }

  private:
    Progress* progress_;
};

}  // namespace

Result<ImportedSoup> import_scene(const std::filesystem::path& path, const std::string& extension,
                                  std::string bytes, WarningList& warnings, Progress* progress) {
    if (auto status = check_declared_counts(extension, bytes, path.string()); !status) return status.error();
    auto answered = import_scene_in_child(path, bytes, warnings, progress);
    return answered ? std::move(*answered)
                    : read_scene(path, extension, std::move(bytes), warnings, progress);
}

bool reads_scenes() {
    return true;
}

Result<ImportedSoup> read_scene(const std::filesystem::path& path, const std::string& extension,
                                std::string bytes, WarningList& warnings, Progress* progress) {
    if (extension == "gltf" || extension == "glb") {
        bool too_old = false;  // assimp has a reader of the older format
        Result<ImportedSoup> read = import_gltf(path, bytes, warnings, progress, &too_old);
        if (!too_old) return read;
    }
    const std::string location = path.string();
    std::vector<std::string> asked_for;
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderIo(path.parent_path(), asked_for));  // the importer deletes it
    importer.SetProgressHandler(new CancelledByProgress(progress));      // and this
    const aiScene* scene = importer.ReadFile(location, 0);
    if (cancelled(progress)) return cancelled_error(path);
    if (scene == nullptr)
        return Error{location, fmt::format("assimp cannot read it: {}", importer.GetErrorString())};
    const SceneFrame frame = scene_frame(*scene, extension, bytes);
    std::string().swap(bytes);
    auto soup = SceneReader(*scene, frame, extension, location, warnings).run();
    if (!soup) return soup.error();
    std::erase(asked_for, location);
    soup->other_files = std::move(asked_for);
    ImportedSoup imported{.soup = std::move(*soup), .frame = frame.frame};
    name_materials(imported.soup);
    return imported;
}

}  // namespace slipface
