// The parts of a glTF file: its JSON, its buffers, views of them, and accessors, which are arrays of numbers.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/gltf_value.h"

namespace slipface {

// Numbers of an accessor: `count` elements of `components` each, normalised integers as -1..1 or 0..1.
struct GltfNumbers {
    std::size_t count = 0, components = 0;
    std::vector<float> values;
    const float* at(std::size_t element) const { return values.data() + element * components; }
};

class GltfFile {
  public:
    // Splits a .glb, parses the JSON, and checks version and required extensions. Buffers are read when they
    // are used, in the folder of `path` and below. All functions throw GltfRefused.
    GltfFile(const std::filesystem::path& path, std::string bytes);

    GltfValue root() const { return {&json_, location_}; }
    const std::string& location() const { return location_; }
    // The element of "nodes", "meshes" ... whose index `reference` is.
    GltfValue element(std::string_view list, const GltfValue& reference) const;

    // The bytes of a buffer view, decompressed; valid as long as the file.
    std::string_view view(const GltfValue& reference);
    // The accessor whose index `reference` is. Its elements have `components` numbers; 0: any.
    GltfNumbers numbers(const GltfValue& reference, std::size_t components = 0);
    // Likewise, of whole numbers that are not normalised.
    std::vector<std::uint32_t> indices(const GltfValue& reference);

    // The bytes that a "data:" address holds; nothing if it is another one.
    static std::optional<std::string> data_of(const GltfValue& uri);
    // "a%20b.png" is "a b.png".
    static std::string without_escapes(std::string_view uri);

    // Files besides this one that it names, found or not, in the order in which they were first used.
    std::vector<std::string> other_files;

  private:
    std::string_view buffer(const GltfValue& reference);
    std::string_view slice(const GltfValue& view, const GltfValue& from);
    template <class Number>
    void read_accessor(const GltfValue& accessor, std::vector<Number>& values, std::size_t components);

    std::filesystem::path folder_;
    std::string location_, bytes_;
    std::string_view binary_;  // the second chunk of a .glb
    nlohmann::json json_;
    std::map<std::size_t, std::string> buffers_, decompressed_;
};

}  // namespace slipface
