#include "overlay_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipface {

namespace {

constexpr int circle_segments = 72;
constexpr double pi = std::numbers::pi;

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

Color faded(Color color, float fraction) {
    color.alpha *= fraction;
    return color;
}

}  // namespace

LineInstance line_instance(const Vec3& a, const Vec3& b, const Color& color, float width, LineKind kind) {
    const Vec3f af = a.cast<float>(), bf = b.cast<float>();
    return {{af.x(), af.y(), af.z()},
            {bf.x(), bf.y(), bf.z()},
            {byte_of(color.red), byte_of(color.green), byte_of(color.blue), byte_of(color.alpha)},
            width,
            static_cast<float>(kind),
            {0, 0}};
}

// In the space where the ellipsoid is the unit sphere, the silhouette seen from e (at distance d > 1) is the
// circle of radius sqrt(1 - 1/d^2) about e / d^2; seen from infinity it is the unit circle across the
// direction of view.
void append_ellipsoid_outline(const Overlay::Ellipsoid& ellipsoid, const Camera& camera, const Vec3& origin,
                              std::vector<LineInstance>& lines) {
    const Vec3& radii = ellipsoid.radii;
    const Vec3 centre = ellipsoid.centre - origin;
    const Vec3 view =
        camera.orthographic ? Vec3(camera.eye - camera.target) : Vec3(camera.eye - ellipsoid.centre);
    const Vec3 eye = view.cwiseQuotient(radii);
    const double distance = eye.norm();
    const bool outside = camera.orthographic || distance > 1.0;

    const auto circle = [&](const Vec3& middle, const Vec3& u, const Vec3& v, const auto& add) {
        Vec3 previous = middle + u;
        for (int i = 1; i <= circle_segments; ++i) {
            const double angle = 2.0 * pi * i / circle_segments;
            const Vec3 next = middle + u * std::cos(angle) + v * std::sin(angle);
            add(previous, next);
            previous = next;
        }
    };
    const auto world = [&](const Vec3& sphere) { return Vec3(centre + sphere.cwiseProduct(radii)); };
    for (int axis = 0; axis < 3; ++axis) {
        circle(Vec3::Zero(), Vec3::Unit((axis + 1) % 3), Vec3::Unit((axis + 2) % 3),
               [&](const Vec3& a, const Vec3& b) {
                   const bool far_side =
                       outside && (camera.orthographic ? a.dot(eye) < 0.0 : a.dot(eye) < 1.0);
                   lines.push_back(line_instance(world(a), world(b),
                                                 faded(ellipsoid.outline, far_side ? 0.12f : 0.5f), 1.2f,
                                                 LineKind::butt));
               });
    }
    if (!outside || !(distance > 0.0)) return;
    const Vec3 direction = eye / distance;
    const Vec3 size = direction.cwiseAbs();
    const int least = size.x() <= size.y() && size.x() <= size.z() ? 0 : size.y() <= size.z() ? 1 : 2;
    const Vec3 u = Vec3::Unit(least).cross(direction).normalized();
    const Vec3 v = direction.cross(u);
    const Vec3 middle = camera.orthographic ? Vec3(Vec3::Zero()) : Vec3(direction / distance);
    const double radius = camera.orthographic ? 1.0 : std::sqrt(1.0 - 1.0 / (distance * distance));
    circle(middle, u * radius, v * radius, [&](const Vec3& a, const Vec3& b) {
        lines.push_back(line_instance(world(a), world(b), ellipsoid.outline, 1.8f, LineKind::butt));
    });
}

SphereMesh unit_sphere(int rings, int sectors) {
    SphereMesh mesh;
    for (int ring = 0; ring <= rings; ++ring) {
        const double polar = pi * ring / rings;
        for (int sector = 0; sector <= sectors; ++sector) {
            const double angle = 2.0 * pi * sector / sectors;
            mesh.positions.push_back(
                Vec3(std::sin(polar) * std::cos(angle), std::cos(polar), std::sin(polar) * std::sin(angle))
                    .cast<float>());
        }
    }
    const auto index = [&](int ring, int sector) {
        return static_cast<std::uint16_t>(ring * (sectors + 1) + sector);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int sector = 0; sector < sectors; ++sector) {
            const std::array<std::uint16_t, 4> quad{index(ring, sector), index(ring, sector + 1),
                                                    index(ring + 1, sector + 1), index(ring + 1, sector)};
            for (const std::size_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
                mesh.indices.push_back(quad[corner]);
        }
    }
    return mesh;
}

}  // namespace slipface
