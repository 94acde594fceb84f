#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slipface::generate {

void box(Model& model, const std::string& material, const Vec3& low, const Vec3& high, unsigned sides) {
    const double x0 = low.x(), y0 = low.y(), z0 = low.z(), x1 = high.x(), y1 = high.y(), z1 = high.z();
    if (sides & side_top) model.face(material, {{x0, y1, z1}, {x1, y1, z1}, {x1, y1, z0}, {x0, y1, z0}});
    if (sides & side_bottom) model.face(material, {{x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1}});
    if (sides & side_south) model.face(material, {{x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}});
    if (sides & side_north) model.face(material, {{x1, y0, z0}, {x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0}});
    if (sides & side_east) model.face(material, {{x1, y0, z1}, {x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}});
    if (sides & side_west) model.face(material, {{x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0}});
}

void grid_floor(Model& model, const std::vector<double>& xs, const std::vector<double>& zs, double y,
                const CellMaterial& material, bool faces_up) {
    for (std::size_t row = 0; row + 1 < zs.size(); ++row) {
        for (std::size_t column = 0; column + 1 < xs.size(); ++column) {
            const double x0 = xs[column], x1 = xs[column + 1], z0 = zs[row], z1 = zs[row + 1];
            const std::string name = material(0.5 * (x0 + x1), 0.5 * (z0 + z1));
            if (name.empty()) continue;
            if (faces_up) {
                model.face(name, {{x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0}});
            } else {
                model.face(name, {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}});
            }
        }
    }
}

void wall(Model& model, const std::string& material, const Vec3& from, const Vec3& to, double top) {
    model.face(material, {from, to, {to.x(), top, to.z()}, {from.x(), top, from.z()}});
}

void prism(Model& model, const std::string& material, const std::vector<Vec2>& plan, double y0, double y1,
           const std::string& top_material, bool bottom) {
    std::vector<Vec3> upper, lower;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const Vec2& a = plan[i];
        const Vec2& b = plan[(i + 1) % plan.size()];
        wall(model, material, {a.x(), y0, a.y()}, {b.x(), y0, b.y()}, y1);
        upper.push_back({a.x(), y1, a.y()});
        lower.insert(lower.begin(), Vec3(a.x(), y0, a.y()));
    }
    if (!top_material.empty()) model.face(top_material, upper);
    if (bottom) model.face(material, lower);
}

void disc(Model& model, const std::string& material, const Vec3& centre, double radius, int sides,
          double first_deg) {
    std::vector<Corner> corners;
    for (int i = 0; i < sides; ++i) {
        const double angle = first_deg + 360.0 * i / sides;
        const Vec2 around(cos_deg(angle), sin_deg(angle));
        corners.push_back(
            {centre + radius * Vec3(around.x(), 0, -around.y()), Vec2(0.5, 0.5) + 0.5 * around});
    }
    model.face_uv(material, std::move(corners));
}

void lathe(Model& model, const std::string& material, const Vec3& centre, const std::vector<Vec2>& profile,
           int sides, double first_deg, const std::string& cap_material) {
    const auto point = [&](int side, const Vec2& ring) {
        const double angle = first_deg + 360.0 * (side % sides) / sides;
        return Vec3(centre + Vec3(ring.x() * cos_deg(angle), ring.y(), -ring.x() * sin_deg(angle)));
    };
    // One texture tile for each quarter turn, and upward along the profile at the scale of a turn's widest
    // quarter.
    double widest = 0.0;
    for (const Vec2& ring : profile)
        widest = std::max(widest, ring.x());
    const double tile = 1.5708 * widest;
    double along = 0.0;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const Vec2& low = profile[i];
        const Vec2& high = profile[i + 1];
        const double next = along + (high - low).norm() / tile;
        for (int side = 0; side < sides; ++side) {
            const double u0 = 4.0 * side / sides, u1 = 4.0 * (side + 1) / sides;
            std::vector<Corner> corners;
            corners.push_back({point(side, low), {u0, along}});
            if (low.x() > 0) corners.push_back({point(side + 1, low), {u1, along}});
            corners.push_back({point(side + 1, high), {u1, next}});
            if (high.x() > 0) corners.push_back({point(side, high), {u0, next}});
            model.face_uv(material, std::move(corners));
        }
        along = next;
    }
    if (cap_material.empty()) return;
    std::vector<Vec3> cap;
    for (int side = 0; side < sides; ++side)
        cap.push_back(point(side, profile.back()));
    model.face(cap_material, cap);
}

void stairs(Model& model, const std::string& tread_material, const std::string& side_material,
            const StairShape& shape) {
    const Vec3 up = Vec3::UnitY();
    const Vec3 across = shape.width * shape.ahead.cross(up);
    std::vector<Vec3> outline{shape.left};
    for (int i = 0; i < shape.count; ++i) {
        const double depth = shape.tread + (i + 1 == shape.count ? shape.landing : 0.0);
        const Vec3 foot = outline.back();
        const Vec3 nose = foot + shape.rise * up;
        const Vec3 end = nose + depth * shape.ahead;
        model.face(side_material, {foot, foot + across, nose + across, nose});
        model.face(tread_material, {nose, nose + across, end + across, end});
        outline.push_back(nose);
        outline.push_back(end);
    }
    const Vec3 end = outline.back();
    const Vec3 back = {end.x(), shape.left.y(), end.z()};
    outline.push_back(back);
    if (shape.back) model.face(side_material, {back + across, back, end, end + across});
    std::vector<Vec3> other_side;
    for (const Vec3& point : outline)
        other_side.insert(other_side.begin(), point + across);
    if (shape.left_side) model.face(side_material, outline);
    if (shape.right_side) model.face(side_material, other_side);
}

void ramp(Model& model, const std::string& top_material, const std::string& side_material,
          const RampShape& shape) {
    const Vec3 up = Vec3::UnitY();
    const Vec3 across = shape.width * shape.ahead.cross(up);
    const Vec3 crest = shape.left + shape.run * shape.ahead + shape.height * up;
    const Vec3 end = crest + shape.landing * shape.ahead;
    const Vec3 back = {end.x(), shape.left.y(), end.z()};
    model.face(top_material, {shape.left, shape.left + across, crest + across, crest});
    std::vector<Vec3> outline{shape.left, crest};
    if (shape.landing > 0) {
        model.face(top_material, {crest, crest + across, end + across, end});
        outline.push_back(end);
    }
    outline.push_back(back);
    if (shape.back) model.face(side_material, {back + across, back, end, end + across});
    std::vector<Vec3> other_side;
    for (const Vec3& point : outline)
        other_side.insert(other_side.begin(), point + across);
    if (shape.left_side) model.face(side_material, outline);
    if (shape.right_side) model.face(side_material, other_side);
}

void coffer(Model& model, const std::string& rim_material, const std::string& inner_material,
            const std::array<Vec3, 4>& quad, double rim, double depth) {
    const Vec3 normal = (quad[1] - quad[0]).cross(quad[3] - quad[0]).normalized();
    const Vec3 u = (quad[1] - quad[0]).normalized();
    const Vec3 v = (quad[3] - quad[0]).normalized();
    const std::array<Vec3, 4> outer = quad;
    const std::array<Vec3, 4> edge{quad[0] + rim * (u + v), quad[1] + rim * (v - u), quad[2] - rim * (u + v),
                                   quad[3] + rim * (u - v)};
    std::array<Vec3, 4> inner = edge;
    for (Vec3& corner : inner)
        corner -= depth * normal;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        model.face(rim_material, {outer[i], outer[next], edge[next], edge[i]});
        model.face(rim_material, {edge[i], edge[next], inner[next], inner[i]});
    }
    model.face_uv(inner_material,
                  {{inner[0], {0, 0}}, {inner[1], {1, 0}}, {inner[2], {1, 1}}, {inner[3], {0, 1}}});
}

}  // namespace slipface::generate
