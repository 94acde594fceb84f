#include "tools/selection/surface_types.h"

#include <algorithm>
#include <array>
#include <limits>

namespace slipface {
namespace {

using Rgb = std::array<float, 3>;

constexpr std::array<Rgb, 14> safe_colors{{{0.34f, 0.71f, 0.91f},
                                           {0.90f, 0.62f, 0.00f},
                                           {0.80f, 0.47f, 0.65f},
                                           {0.00f, 0.62f, 0.45f},
                                           {0.94f, 0.89f, 0.26f},
                                           {0.00f, 0.45f, 0.70f},
                                           {0.84f, 0.37f, 0.00f},
                                           {0.55f, 0.83f, 0.78f},
                                           {0.99f, 0.80f, 0.55f},
                                           {0.45f, 0.22f, 0.42f},
                                           {0.13f, 0.33f, 0.24f},
                                           {0.74f, 0.76f, 0.98f},
                                           {0.42f, 0.17f, 0.05f},
                                           {0.95f, 0.95f, 0.95f}}};

float nearest_distance2(const Rgb& color, const std::vector<SurfaceType>& surfaces) {
    float nearest = std::numeric_limits<float>::max();
    for (const SurfaceType& type : surfaces) {
        float distance2 = 0.0f;
        for (std::size_t i = 0; i < 3; ++i)
            distance2 += (type.color[i] - color[i]) * (type.color[i] - color[i]);
        nearest = std::min(nearest, distance2);
    }
    return nearest;
}

std::string free_name(const Level& level) {
    for (std::size_t number = level.surfaces.size();; ++number) {
        std::string name = "surface " + std::to_string(number);
        if (!find_surface(level, name)) return name;
    }
}

int free_hotkey(const std::vector<SurfaceType>& surfaces) {
    for (int key = 1; key <= 9; ++key)
        if (std::none_of(surfaces.begin(), surfaces.end(),
                         [&](const SurfaceType& type) { return type.hotkey == key; }))
            return key;
    return 0;
}

}  // namespace

std::span<const std::array<float, 3>> safe_surface_colors() {
    return safe_colors;
}

std::optional<SurfaceId> add_surface_type(Editor& editor) {
    if (!editor.document) return std::nullopt;
    std::vector<SurfaceType> surfaces = editor.document->level().surfaces;
    if (surfaces.size() >= max_surface_types) return std::nullopt;
    SurfaceType type;
    type.name = free_name(editor.document->level());
    type.hotkey = free_hotkey(surfaces);
    type.color = *std::max_element(safe_colors.begin(), safe_colors.end(), [&](const Rgb& a, const Rgb& b) {
        return nearest_distance2(a, surfaces) < nearest_distance2(b, surfaces);
    });
    type.hatch = static_cast<Hatch>(surfaces.size() % hatch_names.size());
    const auto surface = static_cast<SurfaceId>(surfaces.size());
    surfaces.push_back(type);
    editor.document->set_surfaces(std::move(surfaces), "Add " + type.name);
    choose_brush(editor, surface);
    return surface;
}

void remove_brush_type(Editor& editor) {
    if (!editor.document || !editor.brush || !editor.document->removal_problem(*editor.brush).empty()) return;
    editor.document->remove_surface(*editor.brush);
    editor.brush = default_surface;
}

void change_surface_type(Document& document, SurfaceId surface, SurfaceType changed, std::string step_name) {
    std::vector<SurfaceType> surfaces = document.level().surfaces;
    if (surface >= surfaces.size()) return;
    if (changed.hotkey != 0)
        for (SurfaceType& other : surfaces)
            if (other.hotkey == changed.hotkey) other.hotkey = 0;
    changed.name = surfaces[surface].name;
    surfaces[surface] = std::move(changed);
    document.set_surfaces(std::move(surfaces), std::move(step_name));
}

}  // namespace slipface
