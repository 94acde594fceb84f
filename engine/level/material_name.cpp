#include "slipface/level/material_name.h"

#include <algorithm>

#include "slipface/base/text.h"

namespace slipface {
namespace {

std::string lower_without_spaces(std::string_view name) {
    std::string text = to_lower(name);
    std::replace(text.begin(), text.end(), ' ', '_');
    return text;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// An ending such as ".001", which modelling tools give to copies.
bool has_number(std::string_view text) {
    const std::size_t size = text.size();
    return size > 4 && text[size - 4] == '.' && is_digit(text[size - 3]) && is_digit(text[size - 2]) &&
           is_digit(text[size - 1]);
}

}  // namespace

std::string normal_name(std::string_view name) {
    std::string text = lower_without_spaces(name);
    while (has_number(text))
        text.resize(text.size() - 4);
    return text;
}

std::string normal_pattern(std::string_view pattern) {
    return pattern.find_first_of("*?") == std::string_view::npos ? normal_name(pattern)
                                                                 : lower_without_spaces(pattern);
}

std::optional<SurfaceId> suffix_surface(std::string_view name, SurfaceTable surfaces) {
    const std::string text = normal_name(name);
    const std::size_t mark = text.rfind("__");
    if (mark == std::string::npos) return std::nullopt;
    const std::string_view wanted = std::string_view(text).substr(mark + 2);
    for (std::size_t i = 0; i < surfaces.size() && i < max_surface_types; ++i) {
        if (lower_without_spaces(surfaces[i].name) == wanted) return static_cast<SurfaceId>(i);
    }
    return std::nullopt;
}

std::optional<std::string> typed_material(std::string_view material, SurfaceId surface,
                                          SurfaceTable surfaces) {
    if (suffix_surface(material, surfaces)) material = material.substr(0, material.rfind("__"));
    std::string type = surfaces[surface].name;
    std::replace(type.begin(), type.end(), ' ', '_');
    const bool one_word = std::none_of(type.begin(), type.end(), [](char c) {
        return static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\';
    });
    std::string name = std::string(material) + "__" + type;
    if (!one_word || suffix_surface(name, surfaces) != surface) return std::nullopt;
    return name;
}

std::string base_material(std::string_view name, SurfaceTable surfaces) {
    std::string text = normal_name(name);
    if (suffix_surface(name, surfaces)) text.resize(text.rfind("__"));
    return text;
}

}  // namespace slipface
