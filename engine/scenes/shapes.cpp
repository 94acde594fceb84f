#include "shapes.h"

#include <algorithm>
#include <cmath>

namespace slipface {

namespace {

Vec3f colour_of(const std::string& material) {
    struct Named {
        const char* name;
        Vec3f colour;
    };
    static const std::array<Named, 5> named{{{"stone", {0.72F, 0.70F, 0.66F}},
                                             {"brick", {0.66F, 0.45F, 0.36F}},
                                             {"wood", {0.62F, 0.49F, 0.33F}},
                                             {"metal", {0.55F, 0.58F, 0.62F}},
                                             {"plaster", {0.85F, 0.83F, 0.78F}}}};
    const auto found = std::find_if(named.begin(), named.end(),
                                    [&](const Named& n) { return material.starts_with(n.name); });
    return found == named.end() ? Vec3f(0.7F, 0.7F, 0.7F) : found->colour;
}

// Rounds to tenths of a millimetre: short numbers are read back from an OBJ file exactly.
double tidy(double coordinate) {
    return std::round(coordinate * 1e4) / 1e4;
}

}  // namespace

Shapes& Shapes::group(const std::string& name) {
    const auto found = std::find(soup_.groups.begin(), soup_.groups.end(), name);
    group_ = static_cast<std::uint32_t>(found - soup_.groups.begin());
    if (found == soup_.groups.end()) soup_.groups.push_back(name);
    return *this;
}

Shapes& Shapes::material(const std::string& name) {
    const auto found = std::find_if(soup_.materials.begin(), soup_.materials.end(),
                                    [&](const Material& material) { return material.name == name; });
    material_ = static_cast<std::uint32_t>(found - soup_.materials.begin());
    if (found == soup_.materials.end())
        soup_.materials.push_back({.name = name, .diffuse = colour_of(name), .texture = {}});
    return *this;
}

Shapes& Shapes::polygon(const std::vector<Vec3>& corners) {
    if (soup_.groups.empty()) group("level");
    if (soup_.materials.empty()) material("stone");
    for (const Vec3& corner : corners)
        soup_.corner_position.push_back(corner.unaryExpr(&tidy).cast<float>());
    soup_.face_first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_position.size()));
    soup_.face_material.push_back(material_);
    soup_.face_group.push_back(group_);
    return *this;
}

Shapes& Shapes::box(const Vec3& a, const Vec3& b) {
    polygon({{a.x(), b.y(), a.z()}, {a.x(), b.y(), b.z()}, {b.x(), b.y(), b.z()}, {b.x(), b.y(), a.z()}});
    polygon({{a.x(), a.y(), a.z()}, {b.x(), a.y(), a.z()}, {b.x(), a.y(), b.z()}, {a.x(), a.y(), b.z()}});
    polygon({{a.x(), a.y(), b.z()}, {b.x(), a.y(), b.z()}, {b.x(), b.y(), b.z()}, {a.x(), b.y(), b.z()}});
    polygon({{b.x(), a.y(), a.z()}, {a.x(), a.y(), a.z()}, {a.x(), b.y(), a.z()}, {b.x(), b.y(), a.z()}});
    polygon({{b.x(), a.y(), b.z()}, {b.x(), a.y(), a.z()}, {b.x(), b.y(), a.z()}, {b.x(), b.y(), b.z()}});
    return polygon(
        {{a.x(), a.y(), a.z()}, {a.x(), a.y(), b.z()}, {a.x(), b.y(), b.z()}, {a.x(), b.y(), a.z()}});
}

Shapes& Shapes::floor(const Vec3& low, const Vec3& high_xz, double tile) {
    const auto cuts = [tile](double from, double to) {
        return std::max(1, static_cast<int>(std::lround((to - from) / tile)));
    };
    const int columns = cuts(low.x(), high_xz.x());
    const int rows = cuts(low.z(), high_xz.z());
    const auto corner = [&](int i, int k) {
        return Vec3(low.x() + (high_xz.x() - low.x()) * i / columns, low.y(),
                    low.z() + (high_xz.z() - low.z()) * k / rows);
    };
    for (int k = 0; k < rows; ++k) {
        for (int i = 0; i < columns; ++i)
            polygon({corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)});
    }
    return *this;
}

Shapes& Shapes::ramp(const Vec3& low, double width, double length, double rise) {
    const Vec3 a = low, b = low + Vec3(width, 0, 0);
    const Vec3 up(0, rise, -length), back(0, 0, -length);
    polygon({a, b, b + up, a + up});
    polygon({a + back, b + back, b, a});
    polygon({b + back, a + back, a + up, b + up});
    polygon({a, a + up, a + back});
    return polygon({b, b + back, b + up});
}

Shapes& Shapes::stairs(const Vec3& foot, double width, int steps, double rise, double run) {
    for (int i = 0; i < steps; ++i) {
        const Vec3 low = foot + Vec3(0, 0, -run * (i + 1));
        box(low, foot + Vec3(width, rise * (i + 1), -run * i));
    }
    return *this;
}

Level Shapes::level() const {
    Level level;
    // The shapes in this module always fit together.
    level.mesh = build_mesh(soup_).value();
    level.overrides.resize(level.mesh.face_count());
    return level;
}

}  // namespace slipface
