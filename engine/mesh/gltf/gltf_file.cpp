// Source: glTF 2.0, sections 3.6 (buffers, views, accessors), 4.4 (GLB) and 3.12 (extensions).
#include "gltf/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "gltf/decompress.h"
#include "obj/obj_text.h"
#include "slipface/base/base64.h"
#include "slipface/base/files.h"
#include "slipface/base/named_file.h"

namespace slipface {
namespace {

// Those that change what geometry a file has, and that are read. What only concerns how light falls on a
// material or where lamps are does not matter to a level.
constexpr std::string_view read_extensions[] = {"KHR_mesh_quantization",      "EXT_mesh_gpu_instancing",
                                                "KHR_texture_transform",      "EXT_texture_webp",
                                                "KHR_draco_mesh_compression", "EXT_meshopt_compression"};

bool is_read(std::string_view name) {
    return std::find(std::begin(read_extensions), std::end(read_extensions), name) !=
               std::end(read_extensions) ||
           name.starts_with("KHR_materials_") || name == "KHR_lights_punctual" || name.starts_with("KHR_xmp");
}

std::size_t length_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

constexpr std::uint64_t largest_list = std::uint64_t{1} << 27;  // numbers of an accessor without bytes

// Of a number in an accessor.
struct Component {
    std::size_t bytes = 0;
    float (*normalised)(const char*) = nullptr;
    double (*plain)(const char*) = nullptr;
};

template <class Number>
double plain(const char* from) {
    Number value;
    std::memcpy(&value, from, sizeof value);
    return static_cast<double>(value);
}

// Section 3.6.2.2: c / 127, at least -1, and so on.
template <class Number>
float normalised(const char* from) {
    constexpr auto largest = static_cast<float>(std::numeric_limits<Number>::max());
    return std::max(static_cast<float>(plain<Number>(from)) / largest, -1.0F);
}

Component component_of(const GltfValue& type) {
    switch (type.whole()) {
        case 5120: return {1, normalised<std::int8_t>, plain<std::int8_t>};
        case 5121: return {1, normalised<std::uint8_t>, plain<std::uint8_t>};
        case 5122: return {2, normalised<std::int16_t>, plain<std::int16_t>};
        case 5123: return {2, normalised<std::uint16_t>, plain<std::uint16_t>};
        case 5125: return {4, nullptr, plain<std::uint32_t>};
        case 5126: return {4, nullptr, plain<float>};
        default: type.refuse(fmt::format("found {}; expected 5120 to 5123, 5125 or 5126", type.json()));
    }
}

// An element of a matrix type has columns, each of which begins at a multiple of four bytes.
struct Shape {
    std::size_t rows = 0, columns = 0;
    std::size_t components() const { return rows * columns; }
    std::size_t column_bytes(std::size_t component) const {
        return columns == 1 ? rows * component : (rows * component + 3) / 4 * 4;
    }
};

Shape shape_of(const GltfValue& type) {
    const std::string name = type.text();
    if (name == "SCALAR") return {1, 1};
    for (std::size_t n = 2; n <= 4; ++n) {
        if (name == fmt::format("VEC{}", n)) return {n, 1};
        if (name == fmt::format("MAT{}", n)) return {n, n};
    }
    type.refuse(fmt::format("found {}; expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4", in_quotes(name)));
}

void check_extensions(const GltfValue& root) {
    const GltfValue required = root["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string name = required.at(i).text();
        if (!is_read(name))
            required.at(i).refuse(
                fmt::format("the file requires the extension {}, which is not read; "
                            "export it without this extension",
                            in_quotes(name)));
    }
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path, std::string bytes)
    : folder_(path.parent_path()), location_(path.string()), bytes_(std::move(bytes)) {
    const auto refuse = [&](std::string message) { throw GltfRefused({location_, std::move(message)}); };
    std::string_view text = bytes_;
    if (text.starts_with("glTF")) {
        if (text.size() < 20)
            refuse(fmt::format("is cut short: {} bytes; a .glb has at least 20", text.size()));
        if (length_at(text, 4) == 1) throw GltfTooOld({location_, "is glTF 1; expected version 2"});
        if (length_at(text, 4) != 2)
            refuse(fmt::format("is glTF {}; expected version 2", length_at(text, 4)));
        const std::size_t length = length_at(text, 8);
        if (length < 20 || length > text.size())
            refuse(fmt::format("is cut short: {} bytes of {}", text.size(), length));
        std::string_view rest = text.substr(12, length - 12);
        std::string_view chunks[2];
        for (int i = 0; i < 2 && rest.size() >= 8; ++i) {
            const std::size_t size = length_at(rest, 0);
            const std::string_view type = rest.substr(4, 4);
            if (size > rest.size() - 8)
                refuse(fmt::format("chunk {} has {} bytes; {} are left", i, size, rest.size() - 8));
            const bool expected = type == (i == 0 ? std::string_view("JSON") : std::string_view("BIN\0", 4));
            if (i == 0 && !expected) refuse("found another chunk; expected JSON first");
            if (expected) chunks[i] = rest.substr(8, size);
            rest.remove_prefix(std::min(rest.size(), 8 + (size + 3) / 4 * 4));
        }
        text = chunks[0];
        binary_ = chunks[1];
    } else if (text.starts_with("\xef\xbb\xbf")) {
        text.remove_prefix(3);
    }
    try {
        json_ = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        refuse(fmt::format("is not JSON from byte {} on", error.byte));
    }
    if (!json_.is_object()) refuse("is no glTF; expected a JSON object");
    const GltfValue asset = root()["asset"];
    const std::string version = asset["minVersion"].text(asset["version"].text());
    if (version.starts_with("1."))
        throw GltfTooOld({location_, fmt::format("is glTF {}; expected 2.0", in_quotes(version))});
    if (!version.starts_with("2.") || version.size() > 3 || (asset["minVersion"] && version != "2.0"))
        refuse(fmt::format("is glTF {}; expected 2.0", in_quotes(version)));
    check_extensions(root());
}

GltfValue GltfFile::element(std::string_view list, const GltfValue& reference) const {
    const std::uint64_t index = reference.whole();
    const GltfValue all = root()[list];
    if (index >= all.size())
        reference.refuse(
            fmt::format("index {} is out of range; the file has {} {}", index, all.size(), list));
    return all.at(index);
}

std::optional<std::string> GltfFile::data_of(const GltfValue& uri) {
    const std::string address = uri.text();
    if (!address.starts_with("data:")) return std::nullopt;
    const std::size_t comma = address.find(',');
    if (comma == std::string::npos) uri.refuse("found a data address without a comma");
    std::string_view data = std::string_view(address).substr(comma + 1);
    if (!std::string_view(address).substr(0, comma).ends_with(";base64")) return without_escapes(data);
    while (data.ends_with('='))
        data.remove_suffix(1);
    std::optional<std::string> bytes = from_base64(data, Base64::plain);
    if (!bytes) uri.refuse("found a data address that is not base64");
    return bytes;
}

std::string GltfFile::without_escapes(std::string_view uri) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        const char upper = static_cast<char>(c & ~0x20);
        return upper >= 'A' && upper <= 'F' ? upper - 'A' + 10 : -1;
    };
    std::string plain;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        plain += escape ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
        if (escape) i += 2;
    }
    return plain;
}

std::string_view GltfFile::buffer(const GltfValue& reference) {
    const GltfValue buffer = element("buffers", reference);
    const std::size_t index = reference.whole(), length = buffer["byteLength"].whole();
    const auto checked = [&](std::string_view bytes) {
        if (bytes.size() < length)
            buffer.refuse(fmt::format("has {} bytes; expected {}", bytes.size(), length));
        return bytes.substr(0, length);
    };
    const GltfValue uri = buffer["uri"];
    if (!uri) {
        if (index != 0 || binary_.data() == nullptr) buffer.refuse("has no bytes");
        return checked(binary_);
    }
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return checked(known->second);
    std::optional<std::string> bytes = data_of(uri);
    if (!bytes) {
        const NamedFile file = named_file(without_escapes(uri.text()), folder_);
        if (file.state != NamedFile::State::outside) other_files.push_back(file.path.string());
        if (!file) uri.refuse(fmt::format("{}: {}", in_quotes(uri.text()), file.error().message));
        Result<std::string> read = read_file(file.path);
        if (!read) uri.refuse(fmt::format("{}: {}", in_quotes(file.path.string()), read.error().message));
        bytes = std::move(*read);
    }
    return checked(buffers_.emplace(index, std::move(*bytes)).first->second);
}

std::string_view GltfFile::slice(const GltfValue& view, const GltfValue& from) {
    const std::string_view all = buffer(from["buffer"]);
    const std::uint64_t offset = from["byteOffset"].whole(0), length = from["byteLength"].whole();
    if (offset > all.size() || length > all.size() - offset)
        view.refuse(fmt::format("bytes {} to {} are out of range; the buffer has {}", offset, offset + length,
                                all.size()));
    return all.substr(offset, length);
}

std::string_view GltfFile::view(const GltfValue& reference) {
    const GltfValue view = element("bufferViews", reference);
    const GltfValue packed = view.extension("EXT_meshopt_compression");
    if (!packed) return slice(view, view);
    const std::size_t index = reference.whole();
    const auto known = decompressed_.find(index);
    if (known != decompressed_.end()) return known->second;
    return decompressed_.emplace(index, decompress_meshopt(packed, slice(packed, packed))).first->second;
}

template <class Number>
void GltfFile::read_accessor(const GltfValue& accessor, std::vector<Number>& values, std::size_t components) {
    const Component component = component_of(accessor["componentType"]);
    const Shape shape = shape_of(accessor["type"]);
    if (components != 0 && shape.components() != components)
        accessor["type"].refuse(
            fmt::format("found {}; expected {} numbers", in_quotes(accessor["type"].text()), components));
    const std::uint64_t count = accessor["count"].whole();
    const bool normal = accessor["normalized"].truth(false);
    const auto read = [&](const char* from) {
        if constexpr (std::is_same_v<Number, float>)
            if (normal && component.normalised != nullptr) return component.normalised(from);
        return static_cast<Number>(component.plain(from));
    };
    const auto read_element = [&](const char* from, Number* to) {
        for (std::size_t column = 0; column < shape.columns; ++column)
            for (std::size_t row = 0; row < shape.rows; ++row)
                *to++ = read(from + column * shape.column_bytes(component.bytes) + row * component.bytes);
    };
    const std::size_t size = shape.columns * shape.column_bytes(component.bytes);
    // Elements of `view` from `offset` on, checked.
    const auto elements = [&](const GltfValue& place, const GltfValue& view, std::uint64_t offset,
                              std::uint64_t number, std::uint64_t bytes, std::uint64_t stride) {
        const std::string_view all = this->view(view);
        const bool fits = offset <= all.size() && bytes <= all.size() - offset &&
                          number - 1 <= (all.size() - offset - bytes) / stride;
        if (number > 0 && !fits)
            place.refuse(
                fmt::format("{} elements of {} bytes from {} on are out of range; the view has {} bytes",
                            number, bytes, offset, all.size()));
        return all.data() + offset;
    };
    if (const GltfValue view = accessor["bufferView"]) {
        const GltfValue stride_value = element("bufferViews", view)["byteStride"];
        // Some writers say 0 for elements without a gap.
        const std::uint64_t given = stride_value.whole(0), stride = given == 0 ? size : given;
        if (stride < size || stride > 252)
            stride_value.refuse(fmt::format("found {}; expected {} to 252", stride, size));
        const char* const from =
            elements(accessor, view, accessor["byteOffset"].whole(0), count, size, stride);
        values.resize(count * shape.components());
        for (std::size_t i = 0; i < count; ++i)
            read_element(from + i * stride, values.data() + i * shape.components());
    } else {
        if (count > largest_list / shape.components())
            accessor["count"].refuse(fmt::format("found {} elements without bytes; too many", count));
        values.assign(count * shape.components(), Number{});
    }
    if (const GltfValue sparse = accessor["sparse"]) {
        const std::uint64_t changed = sparse["count"].whole();
        const GltfValue places = sparse["indices"], numbers = sparse["values"];
        const Component index = component_of(places["componentType"]);
        const char* const at = elements(places, places["bufferView"], places["byteOffset"].whole(0), changed,
                                        index.bytes, index.bytes);
        const char* const from =
            elements(numbers, numbers["bufferView"], numbers["byteOffset"].whole(0), changed, size, size);
        for (std::size_t i = 0; i < changed; ++i) {
            const double place = index.plain(at + i * index.bytes);
            if (!(place >= 0.0 && place < static_cast<double>(count)))
                places.refuse(fmt::format("index {} is out of range; there are {} elements", place, count));
            read_element(from + i * size,
                         values.data() + static_cast<std::size_t>(place) * shape.components());
        }
    }
}

GltfNumbers GltfFile::numbers(const GltfValue& reference, std::size_t components) {
    const GltfValue accessor = element("accessors", reference);
    GltfNumbers numbers;
    read_accessor(accessor, numbers.values, components);
    numbers.components = shape_of(accessor["type"]).components();
    numbers.count = numbers.values.size() / numbers.components;
    const auto odd = std::find_if_not(numbers.values.begin(), numbers.values.end(),
                                      [](float value) { return std::isfinite(value); });
    if (odd != numbers.values.end())
        accessor.refuse(
            fmt::format("element {} is not finite",
                        static_cast<std::size_t>(odd - numbers.values.begin()) / numbers.components));
    return numbers;
}

std::vector<std::uint32_t> GltfFile::indices(const GltfValue& reference) {
    const GltfValue accessor = element("accessors", reference);
    const std::uint64_t type = accessor["componentType"].whole();
    if (type != 5121 && type != 5123 && type != 5125)
        accessor["componentType"].refuse(fmt::format("found {}; expected 5121, 5123 or 5125", type));
    std::vector<std::uint32_t> indices;
    read_accessor(accessor, indices, 1);
    return indices;
}

}  // namespace slipface
