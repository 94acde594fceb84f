#include "assimp/import_scene.h"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cmath>
#include <utility>

#include "assimp/scene_child.h"
#include "assimp/scene_frame.h"
#include "folder_io.h"
#include "obj/declared_counts.h"
#include "obj/obj_text.h"
#include "slipface/mesh/import.h"

namespace slipface {
namespace {

constexpr std::size_t max_faces = std::size_t{1} << 26;
constexpr float largest_coordinate = 1e7F;  // metres

std::string text_of(const aiString& text) {
    bool converted = false;
    return utf8_name({text.data, std::min<std::size_t>(text.length, MAXLEN - 1)}, converted);
}

Material material_of(const aiMaterial& source) {
    Material material;
    material.name = text_of(const_cast<aiMaterial&>(source).GetName());
    if (material.name == AI_DEFAULT_MATERIAL_NAME) material.name.clear();
    aiColor3D color;
    if (source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
        const Vec3f diffuse(color.r, color.g, color.b);
        if (diffuse.allFinite()) material.diffuse = diffuse.cwiseMax(0.0F).cwiseMin(1.0F);
    }
    for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}) {
        aiString path;
        if (source.GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
        material.texture = text_of(path);
        // '*' stands for an image inside the file.
        if (material.texture.starts_with('*')) material.texture.clear();
        break;
    }
    return material;
}

class SceneReader {
  public:
    SceneReader(const aiScene& scene, bool root_is_frame, const std::string& location, WarningList& warnings)
        : scene_(scene), root_is_frame_(root_is_frame), location_(location), warnings_(warnings) {}

    Result<PolygonSoup> run() {
        for (unsigned i = 0; i < scene_.mNumMaterials; ++i)
            soup_.materials.push_back(material_of(*scene_.mMaterials[i]));
        soup_.face_first_corner.push_back(0);

        // Children before siblings, in the order of the file. Not recursive, because the file determines the
        // depth.
        std::vector<std::pair<const aiNode*, aiMatrix4x4>> open{{scene_.mRootNode, aiMatrix4x4()}};
        while (!open.empty()) {
            const auto [node, parent] = open.back();
            open.pop_back();
            if (node == nullptr) continue;
            const bool skipped = root_is_frame_ && node == scene_.mRootNode;
            const aiMatrix4x4 world = skipped ? parent : parent * node->mTransformation;
            if (auto status = add_node(*node, world); !status) return status.error();
            for (unsigned i = node->mNumChildren; i-- > 0;)
                open.emplace_back(node->mChildren[i], world);
        }
        if (soup_.face_material.empty()) return Error{location_, "has no faces"};
        return std::move(soup_);
    }

  private:
    Status add_node(const aiNode& node, const aiMatrix4x4& world) {
        if (node.mNumMeshes == 0) return {};
        soup_.groups.push_back(text_of(node.mName));
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= scene_.mNumMeshes)
                return Error{location_, "a node has a mesh that is not there"};
            if (auto status = add_mesh(*scene_.mMeshes[node.mMeshes[i]], world); !status) return status;
        }
        return {};
    }

    Status add_mesh(const aiMesh& mesh, const aiMatrix4x4& world) {
        const bool mirrored = world.Determinant() < 0.0F;
        std::size_t dropped = 0;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices < 3) {
                ++dropped;
                continue;
            }
            if (soup_.face_material.size() == max_faces)
                return Error{location_, fmt::format("has more than {} faces", max_faces)};
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                // A mirroring transformation reverses the winding; reading the polygon backwards preserves
                // its front.
                const unsigned vertex = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
                if (auto status = add_corner(mesh, vertex, world); !status) return status;
            }
            soup_.face_first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_position.size()));
            soup_.face_material.push_back(
                std::min(mesh.mMaterialIndex, std::max(scene_.mNumMaterials, 1U) - 1));
            soup_.face_group.push_back(static_cast<std::uint32_t>(soup_.groups.size() - 1));
        }
        if (dropped > 0) {
            warnings_.add(location_, fmt::format("dropped {} points and lines of mesh {}", dropped,
                                                 in_quotes(text_of(mesh.mName))));
        }
        return {};
    }

    Status add_corner(const aiMesh& mesh, unsigned vertex, const aiMatrix4x4& world) {
        if (vertex >= mesh.mNumVertices) {
            return Error{location_, fmt::format("index {} is out of range; mesh {} has {} vertices", vertex,
                                                in_quotes(text_of(mesh.mName)), mesh.mNumVertices)};
        }
        const aiVector3D position = world * mesh.mVertices[vertex];
        soup_.corner_position.emplace_back(position.x, position.y, position.z);
        if (!(soup_.corner_position.back().cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <=
              largest_coordinate)) {
            return Error{location_, fmt::format("vertex {} of mesh {} is not within {} m of the origin",
                                                vertex, in_quotes(text_of(mesh.mName)), largest_coordinate)};
        }
        const bool has_uv = mesh.HasTextureCoords(0);
        const Vec2f uv =
            has_uv ? Vec2f(mesh.mTextureCoords[0][vertex].x, mesh.mTextureCoords[0][vertex].y) : Vec2f(0, 0);
        soup_.corner_uv.push_back(uv.allFinite() ? uv : Vec2f(0, 0));
        return {};
    }

    const aiScene& scene_;
    const bool root_is_frame_;  // assimp corrects axes and unit there; this code does so itself
    const std::string& location_;
    WarningList& warnings_;
    PolygonSoup soup_;
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
    const std::string location = path.string();
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderIo(path.parent_path()));         // the importer deletes it
    importer.SetProgressHandler(new CancelledByProgress(progress));  // and this
    const aiScene* scene = importer.ReadFile(location, 0);
    if (cancelled(progress)) return cancelled_error(path);
    if (scene == nullptr)
        return Error{location, fmt::format("assimp cannot read it: {}", importer.GetErrorString())};
    const SceneFrame frame = scene_frame(*scene, extension, bytes);
    std::string().swap(bytes);
    auto soup = SceneReader(*scene, frame.root_is_frame, location, warnings).run();
    if (!soup) return soup.error();
    return ImportedSoup{.soup = std::move(*soup), .frame = frame.frame};
}

}  // namespace slipface
