#include "assimp/scene_materials.h"

#include <assimp/commonMetaData.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "obj/obj_text.h"

namespace slipface {

std::string text_of(const aiString& text) {
    bool converted = false;
    return utf8_name({text.data, std::min<std::size_t>(text.length, sizeof text.data - 1)}, converted);
}

namespace {

struct Picture {
    std::string name;  // of a file; no other picture's
    std::shared_ptr<const std::string> bytes;
};

// The name in the file without folders, or "picture-N", with the ending of the format.
std::string picture_name(const aiTexture& texture, std::size_t number, std::set<std::string>& taken) {
    const std::string whole = text_of(texture.mFilename);
    std::string stem = whole.substr(whole.find_last_of("/\\") + 1);
    std::string ending = "." + std::string(texture.achFormatHint,
                                           strnlen(texture.achFormatHint, sizeof texture.achFormatHint));
    if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot > 0) {
        ending = stem.substr(dot);
        stem.resize(dot);
    }
    if (stem.empty()) stem = fmt::format("picture-{}", number + 1);
    std::string name = stem + ending;
    for (std::size_t next = 2; !taken.insert(name).second; ++next)
        name = fmt::format("{}-{}{}", stem, next, ending);
    return name;
}

// The image files in the scene's file. A picture of plain texels, which no format that is read has, is left
// out.
std::vector<Picture> pictures_of(const aiScene& scene) {
    std::vector<Picture> pictures(scene.mNumTextures);
    std::set<std::string> taken;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const aiTexture* const texture = scene.mTextures[i];
        if (texture == nullptr || texture->mHeight != 0 || texture->pcData == nullptr) continue;
        pictures[i] = {picture_name(*texture, i, taken),
                       std::make_shared<const std::string>(reinterpret_cast<const char*>(texture->pcData),
                                                           texture->mWidth)};
    }
    return pictures;
}

// FBX and COLLADA: a picture is repeated and moved. Its rotation, about whose centre programs differ, is
// left out. Blender moves first, others repeat first.
Eigen::Matrix<float, 2, 3> repeated(const aiUVTransform& from, bool moved_first) {
    const Vec2f repeat(from.mScaling.x, from.mScaling.y);
    Vec2f move(from.mTranslation.x, from.mTranslation.y);
    if (moved_first) move = -repeat.cwiseProduct(move);
    Eigen::Matrix<float, 2, 3> uv;
    uv << repeat.x(), 0, move.x(), 0, repeat.y(), move.y();
    return uv;
}

bool is_by_blender(const aiScene& scene) {
    aiString program;
    return scene.mMetaData != nullptr && scene.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, program) &&
           std::string_view(program.C_Str()).find("Blender") != std::string_view::npos;
}

SceneMaterial material_of(const aiScene& scene, const aiMaterial& source,
                          const std::vector<Picture>& pictures, const std::string& extension) {
    const bool fbx = extension == "fbx";
    SceneMaterial made;
    Material& material = made.material;
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
        const aiTexture* const embedded = scene.GetEmbeddedTexture(path.C_Str());
        const auto found = std::find(scene.mTextures, scene.mTextures + scene.mNumTextures, embedded);
        if (embedded != nullptr) {
            const Picture& picture = pictures[static_cast<std::size_t>(found - scene.mTextures)];
            material.texture = picture.name;
            material.picture = picture.bytes;
        } else if (path.length > 0 && path.data[0] != '*') {  // '*' stands for a picture in the file
            material.texture = text_of(path);
        }
        int uv_set = 0;
        if (source.Get(AI_MATKEY_UVWSRC(type, 0), uv_set) == aiReturn_SUCCESS && uv_set >= 0 &&
            uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS)
            made.uv_set = static_cast<unsigned>(uv_set);
        aiUVTransform transform;
        if ((fbx || extension == "dae") &&
            source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS) {
            made.uv_transform = repeated(transform, fbx && is_by_blender(scene));
            if (!made.uv_transform.allFinite()) made.uv_transform.setIdentity();
        }
        break;
    }
    return made;
}

}  // namespace

std::vector<SceneMaterial> scene_materials(const aiScene& scene, const std::string& extension) {
    const std::vector<Picture> pictures = pictures_of(scene);
    std::vector<SceneMaterial> materials;
    for (unsigned i = 0; i < scene.mNumMaterials; ++i)
        materials.push_back(material_of(scene, *scene.mMaterials[i], pictures, extension));
    return materials;
}

}  // namespace slipface
