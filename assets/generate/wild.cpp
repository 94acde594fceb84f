#include "wild.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slipface::generate {
namespace {

// Two unit directions across `axis`.
std::array<Vec3, 2> across(const Vec3& axis) {
    const Vec3 side = (std::abs(axis.y()) < 0.9 ? Vec3::UnitY() : Vec3::UnitX()).cross(axis).normalized();
    return {side, axis.cross(side)};
}

void two_sided(Model& model, const std::string& material, const std::vector<Corner>& corners) {
    model.face_uv(material, corners);
    model.face_uv(material, {corners.rbegin(), corners.rend()});
}

}  // namespace

double scatter(std::uint32_t thing, std::uint32_t n) {
    std::uint32_t bits = thing * 0x9e3779b9U + n * 0x85ebca6bU + 0x27d4eb2fU;
    bits = (bits ^ (bits >> 15U)) * 0x2c1b3c6dU;
    bits = (bits ^ (bits >> 12U)) * 0x297a2d39U;
    return static_cast<double>((bits ^ (bits >> 15U)) >> 8U) / 16777216.0;
}

void wild_rock(Model& model, const std::string& material, const Vec3& foot, double radius, double height,
               std::uint32_t seed) {
    const int sides = 7;
    const auto point = [&](int side, int row) {
        const auto n = static_cast<std::uint32_t>(row * sides + side % sides);
        const std::array<double, 3> swell{1.0, 1.05, 0.6}, level{-0.25, 0.42, 0.85};
        const double angle = 360.0 * (side % sides) / sides + 18.0 * (scatter(seed, n) - 0.5);
        const double r = radius * swell[static_cast<std::size_t>(row)] * (0.8 + 0.35 * scatter(seed, n + 40));
        const double y = height * level[static_cast<std::size_t>(row)] * (0.85 + 0.3 * scatter(seed, n + 80));
        return Vec3(foot + Vec3(r * cos_deg(angle), y, -r * sin_deg(angle)));
    };
    const Vec3 top = foot + Vec3(0.1 * radius, height, 0.05 * radius);
    for (int side = 0; side < sides; ++side) {
        for (int row = 0; row < 2; ++row) {
            const Vec3 a = point(side, row), b = point(side + 1, row), c = point(side + 1, row + 1),
                       d = point(side, row + 1);
            model.face(material, {a, b, c});
            model.face(material, {a, c, d});
        }
        model.face(material, {point(side, 2), point(side + 1, 2), top});
    }
}

void spike(Model& model, const std::string& material, const Vec3& foot, const Vec3& axis, double radius,
           double length, int sides, std::uint32_t seed) {
    const Vec3 along = axis.normalized();
    const std::array<Vec3, 2> axes = across(along);
    const Vec3 &u = axes[0], &v = axes[1];
    const auto point = [&](int side, double at, double r) {
        const auto n = static_cast<std::uint32_t>(side % sides);
        const double angle = 360.0 * (side % sides) / sides + 20.0 * (scatter(seed, n) - 0.5);
        const double reach = r * (0.8 + 0.4 * scatter(seed, n + 30));
        return Vec3(foot + at * along + reach * (cos_deg(angle) * u + sin_deg(angle) * v));
    };
    const Vec3 tip = foot + length * along;
    for (int side = 0; side < sides; ++side) {
        const Vec3 a = point(side, -0.2 * length, 1.1 * radius),
                   b = point(side + 1, -0.2 * length, 1.1 * radius);
        const Vec3 c = point(side + 1, 0.4 * length, 0.62 * radius),
                   d = point(side, 0.4 * length, 0.62 * radius);
        model.face(material, {a, b, c});
        model.face(material, {a, c, d});
        model.face(material, {d, c, tip});
    }
}

void shard(Model& model, const std::string& material, const Vec3& foot, const Vec3& axis, double radius,
           double length) {
    const Vec3 along = axis.normalized();
    const std::array<Vec3, 2> axes = across(along);
    const Vec3 &u = axes[0], &v = axes[1];
    const auto point = [&](int i, double r, double h) {
        const double angle = 60.0 * (i % 6);
        return Vec3(foot + h * along + r * (cos_deg(angle) * u + sin_deg(angle) * v));
    };
    for (int i = 0; i < 6; ++i) {
        const double low = -0.12 * length, high = 0.72 * length;
        const double u0 = i / 3.0, u1 = (i + 1) / 3.0;
        model.face_uv(material, {{point(i, 0.8 * radius, low), {u0, 0}},
                                 {point(i + 1, 0.8 * radius, low), {u1, 0}},
                                 {point(i + 1, radius, high), {u1, 1}},
                                 {point(i, radius, high), {u0, 1}}});
        model.face_uv(material, {{point(i, radius, high), {u0, 0}},
                                 {point(i + 1, radius, high), {u1, 0}},
                                 {foot + length * along, {0.5 * (u0 + u1), 0.6}}});
    }
}

void beam(Model& model, const std::string& material, const Vec3& a, const Vec3& b, double width,
          double height) {
    const Vec3 along = (b - a).normalized();
    const Vec3 side = 0.5 * width * along.cross(Vec3::UnitY()).normalized();
    const Vec3 down = height * side.normalized().cross(along).normalized() * -1.0;
    const Vec3 al = a - side, ar = a + side, bl = b - side, br = b + side;
    model.face(material, {al, ar, br, bl});
    model.face(material, {ar + down, al + down, bl + down, br + down});
    model.face(material, {al + down, al, bl, bl + down});
    model.face(material, {ar, ar + down, br + down, br});
    model.face(material, {al + down, ar + down, ar, al});
    model.face(material, {br + down, bl + down, bl, br});
}

void palm(Model& model, const Vec3& foot, double height, std::uint32_t seed) {
    const int sides = 6, rows = 4;
    const double turn = 360.0 * scatter(seed, 1), bend = 0.18 + 0.2 * scatter(seed, 2);
    const Vec3 lean(cos_deg(turn), 0, sin_deg(turn));
    const auto centre = [&](double t) {
        return Vec3(foot + t * height * Vec3::UnitY() + bend * height * t * t * lean);
    };
    const auto point = [&](int side, int row) {
        const double t = static_cast<double>(row) / rows, angle = 60.0 * (side % sides);
        const double r = 0.05 * height * (1.0 - 0.45 * t);
        return Vec3(centre(t) + Vec3(r * cos_deg(angle), row == 0 ? -0.4 : 0.0, -r * sin_deg(angle)));
    };
    for (int row = 0; row < rows; ++row) {
        for (int side = 0; side < sides; ++side) {
            const double v0 = row, v1 = row + 1.0, u0 = side / 3.0, u1 = (side + 1) / 3.0;
            model.face_uv("palm_trunk", {{point(side, row), {u0, v0}},
                                         {point(side + 1, row), {u1, v0}},
                                         {point(side + 1, row + 1), {u1, v1}},
                                         {point(side, row + 1), {u0, v1}}});
        }
    }
    const Vec3 crown = centre(1.0);
    const int leaves = 8;
    for (int i = 0; i < leaves; ++i) {
        const auto n = static_cast<std::uint32_t>(i);
        const double angle = 360.0 * i / leaves + 20.0 * scatter(seed, n + 10);
        const double reach = 0.42 * height * (0.85 + 0.3 * scatter(seed, n + 20)), width = 0.085 * height;
        const double rise = 0.10 * height * (0.6 + 0.9 * scatter(seed, n + 30));
        const Vec3 out(cos_deg(angle), 0, -sin_deg(angle)), side(sin_deg(angle), 0, cos_deg(angle));
        const Vec3 up = Vec3::UnitY();
        const Vec3 middle = crown + 0.5 * reach * out + rise * up;
        const Vec3 tip = crown + reach * out - 0.10 * height * up;
        two_sided(model, "foliage",
                  {{crown - 0.25 * width * side, {0.4, 0}},
                   {crown + 0.25 * width * side, {0.6, 0}},
                   {middle + width * side - 0.03 * height * up, {1, 0.5}},
                   {middle, {0.5, 0.5}}});
        two_sided(model, "foliage",
                  {{crown - 0.25 * width * side, {0.4, 0}},
                   {middle, {0.5, 0.5}},
                   {middle - width * side - 0.03 * height * up, {0, 0.5}}});
        two_sided(
            model, "foliage",
            {{middle, {0.5, 0.5}}, {middle + width * side - 0.03 * height * up, {1, 0.5}}, {tip, {0.5, 1}}});
        two_sided(
            model, "foliage",
            {{middle, {0.5, 0.5}}, {tip, {0.5, 1}}, {middle - width * side - 0.03 * height * up, {0, 0.5}}});
    }
}

void tuft(Model& model, const Vec3& foot, double size, int leaves, std::uint32_t seed) {
    for (int i = 0; i < leaves; ++i) {
        const auto n = static_cast<std::uint32_t>(i);
        const double angle = 360.0 * i / leaves + 30.0 * scatter(seed, n);
        const double lift = 40.0 + 35.0 * scatter(seed, n + 20),
                     reach = size * (0.7 + 0.5 * scatter(seed, n + 40));
        const Vec3 out(cos_deg(angle), 0, -sin_deg(angle)), side(sin_deg(angle), 0, cos_deg(angle));
        const Vec3 middle = foot + 0.55 * reach * (cos_deg(lift) * out + sin_deg(lift) * Vec3::UnitY());
        const Vec3 tip =
            middle + 0.5 * reach * (cos_deg(0.5 * lift) * out + sin_deg(0.5 * lift) * Vec3::UnitY());
        const double width = 0.12 * size;
        two_sided(model, "foliage",
                  {{foot - 0.5 * width * side - 0.1 * Vec3::UnitY(), {0.3, 0}},
                   {foot + 0.5 * width * side - 0.1 * Vec3::UnitY(), {0.7, 0}},
                   {middle + width * side, {1, 0.5}},
                   {middle - width * side, {0, 0.5}}});
        two_sided(model, "foliage",
                  {{middle - width * side, {0, 0.5}}, {middle + width * side, {1, 0.5}}, {tip, {0.5, 1}}});
    }
}

void tower(Model& model, const std::string& material, const Vec3& centre, double y0, double r0, double y1,
           double r1, int sides, double first_deg) {
    const auto point = [&](int side, double y, double r) {
        const double angle = first_deg + 360.0 * (side % sides) / sides;
        return Vec3(centre + Vec3(r * cos_deg(angle), y, -r * sin_deg(angle)));
    };
    for (int side = 0; side < sides; ++side) {
        model.face(material, {point(side, y0, r0), point(side + 1, y0, r0), point(side + 1, y1, r1),
                              point(side, y1, r1)});
    }
}

void ring(Model& model, const std::string& material, const Vec3& centre, double inner, double outer,
          int sides, bool up, double first_deg) {
    const auto point = [&](int side, double r) {
        const double angle = first_deg + 360.0 * (side % sides) / sides;
        return Vec3(centre + Vec3(r * cos_deg(angle), 0, -r * sin_deg(angle)));
    };
    for (int side = 0; side < sides; ++side) {
        std::vector<Vec3> corners{point(side, outer), point(side + 1, outer)};
        if (inner > 0) {
            corners.push_back(point(side + 1, inner));
            corners.push_back(point(side, inner));
        } else {
            corners.push_back(centre);
        }
        if (!up) std::reverse(corners.begin(), corners.end());
        model.face(material, corners);
    }
}

void ground(Model& model, const Ground& shape) {
    const auto corner = [&](int i, int j) {
        double x = shape.x0 + shape.step * i, z = shape.z0 + shape.step * j;
        if (shape.jitter > 0 && i > 0 && j > 0 && i < shape.columns && j < shape.rows) {
            const auto n = static_cast<std::uint32_t>(i * 1021 + j);
            x += shape.step * shape.jitter * (scatter(501, n) - 0.5);
            z += shape.step * shape.jitter * (scatter(502, n) - 0.5);
        }
        return Vec3(x, shape.height(x, z), z);
    };
    const auto add = [&](std::array<Vec3, 3> t) {
        if (shape.outside &&
            std::all_of(t.begin(), t.end(), [&](const Vec3& at) { return shape.outside(at.x(), at.z()); }))
            return;
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
        const double up = std::abs((t[1] - t[0]).cross(t[2] - t[0]).normalized().y());
        const std::string name = shape.material(middle.x(), middle.z(), 1.0 - up);
        if (name.empty()) return;
        if (!shape.faces_up) std::swap(t[1], t[2]);
        model.face(name, {t[0], t[1], t[2]});
    };
    for (int j = 0; j < shape.rows; ++j) {
        for (int i = 0; i < shape.columns; ++i) {
            const Vec3 a = corner(i, j + 1), b = corner(i + 1, j + 1), c = corner(i + 1, j), d = corner(i, j);
            // The shorter diagonal in height keeps ridges and gullies sharp.
            const bool first = shape.outside ? scatter(503, static_cast<std::uint32_t>(i * 1021 + j)) < 0.5
                                             : std::abs(a.y() - c.y()) <= std::abs(b.y() - d.y());
            if (first) {
                add({a, b, c});
                add({a, c, d});
            } else {
                add({a, b, d});
                add({b, c, d});
            }
        }
    }
}

}  // namespace slipface::generate
