// Sources: FBX has GlobalSettings (UnitScaleFactor in centimetres, three axes with signs); COLLADA 1.4 has
// <unit meter> and <up_axis> in <asset>; glTF 2.0, section 3.4: metres, +Y up. 3DS Max, Blender and CAD
// programs write 3DS, STL and PLY with +Z up.
#include "assimp/scene_frame.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "obj/obj_text.h"

namespace slipface {
namespace {

using enum ImportSource;

constexpr UpAxis axes[2][3] = {{UpAxis::x, UpAxis::y, UpAxis::z},
                               {UpAxis::minus_x, UpAxis::minus_y, UpAxis::minus_z}};
constexpr std::string_view axis_names[2][3] = {{"X", "Y", "Z"}, {"-X", "-Y", "-Z"}};

bool usable_scale(double scale) {
    return scale >= smallest_import_scale && scale <= largest_import_scale;
}

std::optional<double> number_of(const aiMetadata& data, const char* key) {
    double number = 0;
    float short_number = 0;
    std::int32_t integer = 0;
    if (data.Get(key, number)) return number;
    if (data.Get(key, short_number)) return short_number;
    if (data.Get(key, integer)) return integer;
    return std::nullopt;
}

struct Axis {
    int axis = 0;  // 0 to 2
    bool minus = false;
};

std::optional<Axis> axis_of(const aiMetadata& data, const std::string& key) {
    const auto axis = number_of(data, key.c_str()), sign = number_of(data, (key + "Sign").c_str());
    if (!axis || !(*axis == 0 || *axis == 1 || *axis == 2)) return std::nullopt;
    return Axis{static_cast<int>(*axis), sign && *sign < 0};
}

FileFrame fbx_frame(const aiScene& scene) {
    FileFrame frame =
        frame_of(0.01, guessed, "no UnitScaleFactor: centimetres", UpAxis::y, guessed, "no axes in the file");
    if (scene.mMetaData == nullptr) return frame;
    const auto unit = number_of(*scene.mMetaData, "UnitScaleFactor");
    if (unit && usable_scale(*unit * 0.01)) {
        frame.scale = *unit * 0.01;
        frame.scale_from = declared;
        frame.scale_reason = fmt::format("FBX UnitScaleFactor {:.6g} cm", *unit);
    }
    const auto up = axis_of(*scene.mMetaData, "UpAxis"), front = axis_of(*scene.mMetaData, "FrontAxis"),
               right = axis_of(*scene.mMetaData, "CoordAxis");
    if (!up || !front || !right || up->axis == front->axis || up->axis == right->axis ||
        front->axis == right->axis)
        return frame;
    frame.upright.setZero();
    frame.upright(0, right->axis) = right->minus ? -1.0F : 1.0F;
    frame.upright(1, up->axis) = up->minus ? -1.0F : 1.0F;
    frame.upright(2, front->axis) = front->minus ? -1.0F : 1.0F;
    frame.up = axes[up->minus ? 1 : 0][up->axis];
    frame.up_from = declared;
    frame.up_reason = fmt::format("FBX: up {}, front {}, right {}", axis_names[up->minus ? 1 : 0][up->axis],
                                  axis_names[front->minus ? 1 : 0][front->axis],
                                  axis_names[right->minus ? 1 : 0][right->axis]);
    return frame;
}

// The text between `<name` and the next `>`, and from there to the next `<`, inside <asset>.
struct Element {
    std::string_view attributes, text;
};
std::optional<Element> asset_element(std::string_view asset, std::string_view name) {
    for (std::size_t at = asset.find('<'); at != std::string_view::npos; at = asset.find('<', at + 1)) {
        if (asset.substr(at).starts_with("<!--")) {
            at = asset.find("-->", at);
            if (at == std::string_view::npos) break;
            continue;
        }
        std::string_view rest = asset.substr(at + 1);
        if (!rest.starts_with(name)) continue;
        rest.remove_prefix(name.size());
        if (rest.empty() || std::string_view(" \t\r\n/>").find(rest[0]) == std::string_view::npos) continue;
        const std::size_t end = rest.find('>');
        if (end == std::string_view::npos) break;
        const std::string_view behind = rest.substr(end + 1);
        return Element{rest.substr(0, end), behind.substr(0, behind.find('<'))};
    }
    return std::nullopt;
}

// UTF-16 becomes its ASCII characters; the others do not matter here.
std::string ascii_of(std::string_view bytes) {
    std::string text(bytes);
    std::erase(text, '\0');
    return text;
}

FileFrame collada_frame(std::string_view bytes) {
    FileFrame frame = frame_of(1.0, guessed, "COLLADA without <unit>: metres", UpAxis::y, guessed,
                               "COLLADA without <up_axis>: Y");
    constexpr std::size_t longest = 1 << 16;  // <asset> is at the beginning
    const std::string text = ascii_of(bytes.substr(0, longest));
    std::string_view asset(text);
    const std::size_t begin = asset.find("<asset");
    if (begin == std::string_view::npos) return frame;
    asset = asset.substr(begin);
    asset = asset.substr(0, asset.find("</asset>"));
    if (const auto unit = asset_element(asset, "unit")) {
        const std::size_t meter = unit->attributes.find("meter=");
        if (meter != std::string_view::npos && meter + 7 < unit->attributes.size()) {
            const std::string_view value = unit->attributes.substr(meter + 7);
            const auto scale = read_number(value.substr(0, value.find(unit->attributes[meter + 6])));
            if (scale && usable_scale(*scale)) {
                frame.scale = *scale;
                frame.scale_from = declared;
                frame.scale_reason = fmt::format("COLLADA unit {:.6g} m", *scale);
            }
        }
    }
    if (const auto axis = asset_element(asset, "up_axis")) {
        for (const auto& [name, up] :
             {std::pair("X_UP", UpAxis::x), std::pair("Y_UP", UpAxis::y), std::pair("Z_UP", UpAxis::z)}) {
            if (axis->text.find(name) == std::string_view::npos) continue;
            return frame_of(frame.scale, frame.scale_from, frame.scale_reason, up, declared,
                            fmt::format("COLLADA {}", name));
        }
    }
    return frame;
}

}  // namespace

SceneFrame scene_frame(const aiScene& scene, const std::string& extension, std::string_view bytes) {
    if (extension == "fbx") return {fbx_frame(scene), true};
    if (extension == "dae") return {collada_frame(bytes), true};
    if (extension == "gltf" || extension == "glb")
        return {frame_of(1.0, declared, "glTF is in metres", UpAxis::y, declared, "glTF has Y up")};
    if (extension == "3ds")
        return {frame_of(1.0, guessed, "3DS files have no unit: metres", UpAxis::z, guessed,
                         "3DS files have Z up as a rule"),
                true};
    if (extension == "stl" || extension == "ply") {
        const std::string name = extension == "stl" ? "STL" : "PLY";
        return {frame_of(1.0, guessed, name + " files have no unit: metres", UpAxis::z, guessed,
                         name + " files have Z up as a rule")};
    }
    // The axes of these formats are fixed, as glTF's are.
    if (const std::string name = extension == "ac"    ? "AC3D"
                                 : extension == "lwo" ? "LightWave"
                                 : extension == "x"   ? "DirectX X"
                                                      : "";
        !name.empty())
        return {frame_of(1.0, guessed, name + " files have no unit: metres", UpAxis::y, declared,
                         name + " has Y up")};
    return {};
}

}  // namespace slipface
