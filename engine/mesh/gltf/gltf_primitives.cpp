// Source: glTF 2.0, section 3.7.
#include "gltf/gltf_primitives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gltf/decompress.h"

namespace slipface {
namespace {

// Attributes by name, from accessors or from a compressed mesh.
class Attributes {
  public:
    Attributes(GltfFile& file, const GltfValue& primitive, const std::vector<std::string>& wanted)
        : file_(file), list_(primitive["attributes"]) {
        const GltfValue packed = primitive.extension("KHR_draco_mesh_compression");
        if (!packed) return;
        draco_ = decompress_draco(packed, file.view(packed["bufferView"]), wanted);
        packed_ = true;
    }

    bool has(const std::string& name) const { return list_[name] || draco_.attributes.count(name) > 0; }
    GltfNumbers numbers(const std::string& name, std::size_t components) {
        const auto packed = draco_.attributes.find(name);
        if (packed == draco_.attributes.end()) return file_.numbers(list_[name], components);
        GltfNumbers numbers = std::move(packed->second);
        if (numbers.components != components)
            list_[name].refuse(fmt::format("has {} numbers; expected {}", numbers.components, components));
        // What the accessor calls normalised is stored in the compressed mesh as it is.
        const GltfValue accessor = file_.element("accessors", list_[name]);
        if (accessor["normalized"].truth(false)) {
            const std::uint64_t type = accessor["componentType"].whole();
            const float largest = type == 5120   ? 127.0F
                                  : type == 5121 ? 255.0F
                                  : type == 5122 ? 32767.0F
                                                 : 65535.0F;
            for (float& value : numbers.values)
                if (type <= 5123) value = std::max(value / largest, -1.0F);
        }
        return numbers;
    }
    const std::vector<std::uint32_t>* indices() const { return packed_ ? &draco_.indices : nullptr; }

  private:
    GltfFile& file_;
    GltfValue list_;
    DracoMesh draco_;
    bool packed_ = false;
};

std::vector<Vec3f> as_points(const GltfNumbers& numbers) {
    std::vector<Vec3f> points(numbers.count);
    for (std::size_t i = 0; i < numbers.count; ++i)
        points[i] = {numbers.at(i)[0], numbers.at(i)[1], numbers.at(i)[2]};
    return points;
}

// The triangles of a list (4), a strip (5) or a fan (6).
std::vector<std::uint32_t> triangles(const std::vector<std::uint32_t>& indices, std::uint64_t mode) {
    if (mode == 4) return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(indices.size() % 3)};
    std::vector<std::uint32_t> list;
    for (std::size_t i = 2; i < indices.size(); ++i) {
        const std::size_t odd = mode == 5 ? i % 2 : 0;
        list.push_back(mode == 5 ? indices[i - 2 + odd] : indices[0]);
        list.push_back(indices[i - 1 - odd]);
        list.push_back(indices[i]);
    }
    return list;
}

// Pairs of all sets: JOINTS_0 and WEIGHTS_0, JOINTS_1 ...
void read_influences(const GltfValue& primitive, Attributes& attributes, GltfPrimitive& read) {
    std::vector<GltfNumbers> joints, weights;
    for (std::size_t set = 0; attributes.has(fmt::format("JOINTS_{}", set)); ++set) {
        joints.push_back(attributes.numbers(fmt::format("JOINTS_{}", set), 4));
        weights.push_back(attributes.numbers(fmt::format("WEIGHTS_{}", set), 4));
        if (joints.back().count != read.positions.size() || weights.back().count != read.positions.size())
            primitive.refuse(fmt::format("joints of {} and weights of {} vertices; expected {}",
                                         joints.back().count, weights.back().count, read.positions.size()));
    }
    read.influences = 4 * joints.size();
    for (std::size_t vertex = 0; vertex < read.positions.size(); ++vertex) {
        for (std::size_t set = 0; set < joints.size(); ++set) {
            for (std::size_t i = 0; i < 4; ++i) {
                const float joint = joints[set].at(vertex)[i];
                if (!(joint >= 0.0F && joint <= 65535.0F))
                    primitive.refuse(fmt::format("joint {} of vertex {} is out of range", joint, vertex));
                read.joints.push_back(static_cast<std::uint32_t>(joint));
                read.weights.push_back(std::max(weights[set].at(vertex)[i], 0.0F));
            }
        }
    }
}

}  // namespace

GltfPrimitive gltf_primitive(GltfFile& file, const GltfValue& primitive, const std::string& uv_set) {
    GltfPrimitive read;
    const std::uint64_t mode = primitive["mode"].whole(4);
    if (mode > 6) primitive["mode"].refuse(fmt::format("found {}; expected 0 to 6", mode));
    Attributes attributes(file, primitive,
                          {"POSITION", uv_set, "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"});
    if (!attributes.has("POSITION")) return read;
    read.positions = as_points(attributes.numbers("POSITION", 3));
    std::vector<std::uint32_t> indices;
    if (attributes.indices() != nullptr) {
        indices = *attributes.indices();
    } else if (const GltfValue list = primitive["indices"]) {
        indices = file.indices(list);
    } else {
        indices.resize(read.positions.size());
        for (std::size_t i = 0; i < indices.size(); ++i)
            indices[i] = static_cast<std::uint32_t>(i);
    }
    if (mode < 4) {
        read.dropped = mode == 1 ? indices.size() / 2 : indices.size();
        return read;
    }
    for (const std::uint32_t index : indices)
        if (index >= read.positions.size())
            primitive["indices"].refuse(
                fmt::format("index {} is out of range; there are {} vertices", index, read.positions.size()));
    read.corners = triangles(indices, mode);
    // A file whose material names texture positions that are not there uses the first ones.
    const std::string uv_name = attributes.has(uv_set) ? uv_set : "TEXCOORD_0";
    if (attributes.has(uv_name)) {
        const GltfNumbers uv = attributes.numbers(uv_name, 2);
        if (uv.count != read.positions.size())
            primitive.refuse(fmt::format("texture positions of {} vertices; expected {}", uv.count,
                                         read.positions.size()));
        for (std::size_t i = 0; i < uv.count; ++i)
            read.uv.emplace_back(uv.at(i)[0], uv.at(i)[1]);
    }
    const GltfValue targets = primitive["targets"];
    for (std::size_t i = 0; i < targets.size(); ++i) {
        std::vector<Vec3f>& target = read.targets.emplace_back();
        const GltfValue position = targets.at(i)["POSITION"];
        if (!position) continue;
        target = as_points(file.numbers(position, 3));
        if (target.size() != read.positions.size())
            position.refuse(
                fmt::format("moves {} vertices; expected {}", target.size(), read.positions.size()));
    }
    if (attributes.has("JOINTS_0")) read_influences(primitive, attributes, read);
    return read;
}

}  // namespace slipface
