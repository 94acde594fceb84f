// The binary buffer of a glTF file, with the views and accessors into it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>

#include "slipface/base/types.h"

namespace slipface {

using GltfJson = nlohmann::ordered_json;

// The path as a URI: everything but letters, digits and "-._~/" as %XX.
std::string uri_text(const std::filesystem::path& path);

class GltfBuffer {
  public:
    // Each returns the index of its accessor.
    std::size_t positions(std::span<const Vec3f> positions);
    std::size_t uvs(std::span<const Vec2f> uvs);  // V up; in glTF it points downwards
    std::size_t indices(std::size_t view, std::size_t first, std::size_t count);

    // Each returns the index of its view.
    std::size_t index_view(std::span<const std::uint32_t> indices);
    std::size_t bytes_view(std::string_view bytes);

    const std::string& bytes() const { return bytes_; }
    std::string take() { return std::move(bytes_); }
    // Adds `accessors`, `bufferViews` and `buffers` to the file, if there are any.
    void append_to(GltfJson& root, const std::string& uri) const;

  private:
    std::size_t view_from(std::size_t begin, int target);
    std::size_t accessor(GltfJson accessor);
    void put(std::uint32_t value);

    std::string bytes_;
    GltfJson views_ = GltfJson::array(), accessors_ = GltfJson::array();
};

}  // namespace slipface
