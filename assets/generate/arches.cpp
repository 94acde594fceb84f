#include <algorithm>
#include <vector>

#include "shapes.h"

namespace slipface::generate {
namespace {

// The opening's outline from the lower left end over the arch to the lower right end, as (along, y).
std::vector<Vec2> opening(const ArchShape& shape) {
    const double middle = 0.5 * (shape.to - shape.from).norm();
    std::vector<Vec2> outline;
    if (shape.sill < shape.spring) outline.emplace_back(middle - shape.half_width, shape.sill);
    for (int i = 0; i <= shape.segments; ++i) {
        const double angle = 180.0 - 180.0 * i / shape.segments;
        outline.emplace_back(middle + shape.half_width * cos_deg(angle),
                             shape.spring + shape.rise * sin_deg(angle));
    }
    if (shape.sill < shape.spring) outline.emplace_back(middle + shape.half_width, shape.sill);
    return outline;
}

Vec3 along_wall(const ArchShape& shape, const Vec2& point) {
    const Vec3 direction = (shape.to - shape.from).normalized();
    return Vec3(shape.from.x(), 0, shape.from.z()) + point.x() * direction + point.y() * Vec3::UnitY();
}

Vec3 behind(const ArchShape& shape, double depth) {
    return -depth * (shape.to - shape.from).normalized().cross(Vec3::UnitY());
}

}  // namespace

void arch_wall(Model& model, const std::string& material, const ArchShape& shape) {
    const double length = (shape.to - shape.from).norm();
    const std::vector<Vec2> outline = opening(shape);
    const auto add = [&](const std::vector<Vec2>& points) {
        std::vector<Vec3> corners;
        corners.reserve(points.size());
        for (const Vec2& point : points)
            corners.push_back(along_wall(shape, point));
        model.face(material, corners);
    };
    std::vector<Vec2> around = outline;
    if (shape.sill > shape.y0) {
        // The part below the sill is a face of its own, so that the rest stays a polygon without a hole.
        add({{0, shape.y0},
             {length, shape.y0},
             {length, shape.sill},
             outline.back(),
             outline.front(),
             {0, shape.sill}});
    }
    const double base = std::max(shape.y0, shape.sill);
    around.emplace_back(length, base);
    around.emplace_back(length, shape.y1);
    around.emplace_back(0.0, shape.y1);
    around.emplace_back(0.0, base);
    add(around);
}

void arch_reveal(Model& model, const std::string& material, const ArchShape& shape, double depth,
                 bool jambs) {
    const std::vector<Vec2> outline = opening(shape);
    const Vec3 back = behind(shape, depth);
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const bool straight = outline[i].x() == outline[i + 1].x();
        if (straight && !jambs) continue;
        const Vec3 a = along_wall(shape, outline[i]);
        const Vec3 b = along_wall(shape, outline[i + 1]);
        model.face(material, {a + back, b + back, b, a});
    }
    if (jambs && shape.sill > shape.y0) {
        const Vec3 a = along_wall(shape, outline.front());
        const Vec3 b = along_wall(shape, outline.back());
        model.face(material, {a + back, a, b, b + back});
    }
}

void arch_panel(Model& model, const std::string& material, const ArchShape& shape, double depth) {
    const std::vector<Vec2> outline = opening(shape);
    const Vec3 back = behind(shape, depth);
    std::vector<Vec3> corners;
    for (const Vec2& point : outline)
        corners.insert(corners.begin(), along_wall(shape, point) + back);
    model.face(material, corners);
}

}  // namespace slipface::generate
