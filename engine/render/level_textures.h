// The textures of a level's materials on the graphics card.
#pragma once

#include <filesystem>
#include <vector>

#include "gl_util.h"
#include "slipface/mesh/mesh.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

class LevelTextures {
  public:
    // Texture 0 means none: the material's colour is used.
    static constexpr std::uint32_t none = 0;

    explicit LevelTextures(GlTable gl) : gl_(std::move(gl)) {}
    ~LevelTextures() { clear(); }
    LevelTextures(const LevelTextures&) = delete;
    LevelTextures& operator=(const LevelTextures&) = delete;

    // Loads each file once, even if several materials name it. A file that cannot be loaded gives a checker
    // and a warning.
    Warnings load(const Mesh& mesh, const std::filesystem::path& folder);
    void clear();

    const std::vector<std::uint32_t>& material_texture() const { return material_texture_; }  // [material]
    std::size_t count() const { return names_.size() + 1; }
    unsigned name(std::uint32_t texture) const { return texture == none ? 0 : names_[texture - 1]; }
    bool opaque(std::uint32_t texture) const { return texture == none || opaque_[texture - 1]; }

  private:
    void add(const Image& image);

    GlTable gl_;
    std::vector<std::uint32_t> material_texture_;
    std::vector<unsigned> names_;
    std::vector<bool> opaque_;
};

// The same mesh with one image on all its faces.
MeshPtr with_texture(const Mesh& mesh, const std::string& texture);

}  // namespace slipface
