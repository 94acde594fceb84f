#include "gltf/buffer.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace slipface {
namespace {

constexpr int component_float = 5126, component_u32 = 5125;
constexpr int no_target = 0, target_vertices = 34962, target_indices = 34963;

}  // namespace

std::string uri_text(const std::filesystem::path& path) {
    std::string uri;
    for (const char c : path.generic_string()) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
}

std::size_t GltfBuffer::positions(std::span<const Vec3f> positions) {
    const std::size_t begin = bytes_.size();
    Vec3f low = positions.front(), high = low;
    for (const Vec3f& position : positions) {
        low = low.cwiseMin(position);
        high = high.cwiseMax(position);
        for (const float coordinate : position)
            put(std::bit_cast<std::uint32_t>(coordinate));
    }
    return accessor({{"bufferView", view_from(begin, target_vertices)},
                     {"componentType", component_float},
                     {"count", positions.size()},
                     {"type", "VEC3"},
                     {"min", {low[0], low[1], low[2]}},
                     {"max", {high[0], high[1], high[2]}}});
}

std::size_t GltfBuffer::uvs(std::span<const Vec2f> uvs) {
    const std::size_t begin = bytes_.size();
    for (const Vec2f& uv : uvs) {
        put(std::bit_cast<std::uint32_t>(uv.x()));
        put(std::bit_cast<std::uint32_t>(1.0F - uv.y()));
    }
    return accessor({{"bufferView", view_from(begin, target_vertices)},
                     {"componentType", component_float},
                     {"count", uvs.size()},
                     {"type", "VEC2"}});
}

std::size_t GltfBuffer::indices(std::size_t view, std::size_t first, std::size_t count) {
    GltfJson json{{"bufferView", view}};
    if (first > 0) json["byteOffset"] = 4 * first;
    json["componentType"] = component_u32;
    json["count"] = count;
    json["type"] = "SCALAR";
    return accessor(std::move(json));
}

std::size_t GltfBuffer::index_view(std::span<const std::uint32_t> indices) {
    const std::size_t begin = bytes_.size();
    for (const std::uint32_t index : indices)
        put(index);
    return view_from(begin, target_indices);
}

std::size_t GltfBuffer::bytes_view(std::string_view bytes) {
    const std::size_t begin = bytes_.size();
    bytes_ += bytes;
    const std::size_t view = view_from(begin, no_target);
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');  // views of numbers begin at multiples of four
    return view;
}

void GltfBuffer::append_to(GltfJson& root, const std::string& uri) const {
    if (bytes_.empty()) return;
    root["accessors"] = accessors_;
    root["bufferViews"] = views_;
    GltfJson buffer{{"byteLength", bytes_.size()}};
    if (!uri.empty()) buffer["uri"] = uri;
    root["buffers"] = GltfJson::array({std::move(buffer)});
}

std::size_t GltfBuffer::view_from(std::size_t begin, int target) {
    GltfJson view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}};
    if (target != no_target) view["target"] = target;
    views_.push_back(std::move(view));
    return views_.size() - 1;
}

std::size_t GltfBuffer::accessor(GltfJson accessor) {
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

void GltfBuffer::put(std::uint32_t value) {
    for (int i = 0; i < 4; ++i)
        bytes_.push_back(static_cast<char>(value >> (8 * i)));
}

}  // namespace slipface
