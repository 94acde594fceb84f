// Sources: EXT_meshopt_compression and KHR_draco_mesh_compression of the glTF registry.
#include "gltf/decompress.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "obj/obj_text.h"

namespace slipface {
namespace {

constexpr std::uint64_t largest_view = std::uint64_t{1} << 30;  // bytes after decompression

}  // namespace

std::string decompress_meshopt(const GltfValue& extension, std::string_view compressed) {
    const std::uint64_t count = extension["count"].whole(), stride = extension["byteStride"].whole();
    const std::string mode = extension["mode"].text(), filter = extension["filter"].text("NONE");
    if (stride == 0 || stride > 256 || count > largest_view / stride)
        extension.refuse(fmt::format("{} elements of {} bytes are too many", count, stride));
    std::string bytes(count * stride, '\0');
    const auto* const from = reinterpret_cast<const unsigned char*>(compressed.data());
    int failed = 0;
    if (mode == "ATTRIBUTES") {
        if (stride % 4 != 0)
            extension["byteStride"].refuse(fmt::format("found {}; expected a multiple of 4", stride));
        failed = meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, compressed.size());
    } else if (mode == "TRIANGLES" || mode == "INDICES") {
        if (stride != 2 && stride != 4)
            extension["byteStride"].refuse(fmt::format("found {}; expected 2 or 4", stride));
        if (mode == "TRIANGLES" && count % 3 != 0)
            extension["count"].refuse(fmt::format("found {}; expected a multiple of 3", count));
        failed = mode == "TRIANGLES"
                     ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, compressed.size())
                     : meshopt_decodeIndexSequence(bytes.data(), count, stride, from, compressed.size());
    } else {
        extension["mode"].refuse(
            fmt::format("found {}; expected ATTRIBUTES, TRIANGLES or INDICES", in_quotes(mode)));
    }
    if (failed != 0) extension.refuse("the compressed bytes are damaged");
    const auto need_stride = [&](bool fits) {
        if (!fits)
            extension["filter"].refuse(fmt::format("{} does not fit elements of {} bytes", filter, stride));
    };
    if (filter == "OCTAHEDRAL") {
        need_stride(stride == 4 || stride == 8);
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    } else if (filter == "QUATERNION") {
        need_stride(stride == 8);
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    } else if (filter == "EXPONENTIAL") {
        need_stride(stride % 4 == 0);
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    } else if (filter != "NONE") {
        extension["filter"].refuse(
            fmt::format("found {}; expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL", in_quotes(filter)));
    }
    return bytes;
}

DracoMesh decompress_draco(const GltfValue& extension, std::string_view compressed,
                           const std::vector<std::string>& wanted) {
    draco::DecoderBuffer buffer;
    buffer.Init(compressed.data(), compressed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        extension.refuse(fmt::format("draco cannot read it: {}", decoded.status().error_msg_string()));
    const draco::Mesh& mesh = *decoded.value();
    DracoMesh result;
    result.indices.reserve(3 * std::size_t{mesh.num_faces()});
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(face))
            result.indices.push_back(point.value());
    for (const std::string& name : wanted) {
        const GltfValue id = extension["attributes"][name];
        if (!id) continue;
        const draco::PointAttribute* const attribute =
            mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.whole()));
        if (attribute == nullptr) id.refuse("the compressed mesh has no such attribute");
        GltfNumbers numbers{.count = mesh.num_points(),
                            .components = static_cast<std::size_t>(attribute->num_components()),
                            .values = {}};
        numbers.values.resize(numbers.count * numbers.components);
        for (draco::PointIndex point(0); point < mesh.num_points(); ++point)
            if (!attribute->ConvertValue<float>(attribute->mapped_index(point),
                                                static_cast<std::int8_t>(numbers.components),
                                                &numbers.values[point.value() * numbers.components]))
                id.refuse("the compressed numbers cannot be read");
        result.attributes.emplace(name, std::move(numbers));
    }
    return result;
}

}  // namespace slipface
