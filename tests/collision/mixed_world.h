// Random worlds of very mixed density, as no level designer would make them: clusters inside clusters,
// triangles of a whole world beside crumbs, needles, layers, copies, points, far from the origin or not.
#pragma once

#include <algorithm>

#include "scenes.h"

namespace slipface::scenes {

struct MixedWorld {
    Soup soup;
    std::vector<std::uint32_t> bodies;  // may be empty
    std::vector<SurfaceId> types;       // [face] 0 to 3
};

class MixedParts {
  public:
    MixedParts(Random& random, std::size_t triangles) : random_(random), most_(triangles) {}

    Soup draw() {
        const Vec3 away = random_.below(3) == 0 ? Vec3(power(0, 6) * random_.direction()) : Vec3::Zero();
        for (std::size_t parts = 1 + random_.below(6); parts > 0 && left() > 0; --parts) {
            const std::size_t count = parts == 1 ? left() : random_.below(left()) + 1;
            add_part(away + power(0, 5) * random_.direction(), power(-3, 3), count);
        }
        return std::move(soup_);
    }

  private:
    double power(double low, double high) { return std::pow(10.0, random_.uniform(low, high)); }
    std::size_t left() const { return most_ - std::min(most_, soup_.triangles.size()); }

    void add_small(const Vec3& at, double size) {
        const Vec3 a = at + random_.in_box(size), b = at + random_.in_box(size);
        soup_.add(a, b, at + random_.in_box(size));
    }
    void add_cluster(const Vec3& at, double half, std::size_t count) {
        const double size = half * power(-3, 0);
        for (std::size_t i = 0; i < count; ++i)
            add_small(at + random_.in_box(half), size);
    }
    // Each a part of the size of the one around it.
    void add_nested(const Vec3& at, double half, std::size_t count) {
        const double shrink = power(-2, -0.1);
        const std::size_t levels = 2 + random_.below(40);
        for (std::size_t k = 0; k < levels; ++k, half = std::max(half * shrink, 1e-18))
            add_cluster(at, half, std::max<std::size_t>(count / levels, 1));
    }
    void add_needles(const Vec3& at, double half, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 tip = at + random_.in_box(half), far = tip + half * power(-2, 1) * random_.direction();
            soup_.add(tip, far, far + half * power(-6, -2) * random_.direction());
        }
    }
    // Of shared corners: flat, or one float above the other.
    void add_layers(const Vec3& at, double half, std::size_t count) {
        const auto side = static_cast<std::uint32_t>(1 + random_.below(60));
        const int flat = static_cast<int>(random_.below(3));
        const double step = half / side;
        for (double level = 0; count > 0 && level < 1000; ++level) {
            const auto first = static_cast<std::uint32_t>(soup_.positions.size());
            for (std::uint32_t j = 0; j <= side; ++j) {
                for (std::uint32_t i = 0; i <= side; ++i) {
                    Vec3 p = at;
                    p[(flat + 1) % 3] += i * step;
                    p[(flat + 2) % 3] += j * step;
                    p[flat] += level * 1e-3 * step;
                    soup_.positions.push_back(p.cast<float>());
                }
            }
            for (std::uint32_t j = 0; j < side && count > 0; ++j) {
                for (std::uint32_t i = 0; i < side && count > 0; ++i) {
                    const std::uint32_t a = first + j * (side + 1) + i, b = a + side + 1;
                    add_indexed({a, b, b + 1});
                    add_indexed({a, b + 1, a + 1});
                    count -= std::min<std::size_t>(count, 2);
                }
            }
        }
    }
    void add_indexed(const std::array<std::uint32_t, 3>& corners) {
        soup_.triangles.push_back(corners);
        soup_.faces.push_back(static_cast<FaceId>(soup_.faces.size()));
    }
    void add_copies(std::size_t count) {
        const std::size_t first = random_.below(soup_.triangles.size());
        const std::size_t among =
            1 + random_.below(std::min<std::size_t>(soup_.triangles.size() - first, 50));
        for (std::size_t i = 0; i < count; ++i)
            add_indexed(std::array(soup_.triangles[first + random_.below(among)]));
    }
    void add_giants(const Vec3& at, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            add_small(at, power(3, 6));
    }
    // Triangle after triangle further out and larger.
    void add_series(const Vec3& at, double half, std::size_t count) {
        const double grow = 1 + power(-4, -0.5);
        const Vec3 along = random_.below(2) == 0 ? random_.direction() : Vec3(Vec3::UnitX());
        double r = half * 1e-6;
        for (std::size_t i = 0; i < count; ++i, r = r < 1e7 ? r * grow : half * 1e-6)
            add_small(at + r * along, 0.3 * r);
    }
    void add_points(const Vec3& at, double half, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 p = at + random_.in_box(half);
            soup_.add(p, p, random_.below(2) == 0 ? p : Vec3(p + random_.in_box(half * 0.01)));
        }
    }
    void add_part(const Vec3& at, double half, std::size_t count) {
        switch (random_.below(soup_.triangles.empty() ? 8 : 10)) {
            case 0:
            case 1: return add_cluster(at, half, count);
            case 2:
            case 3: return add_nested(at, half, count);
            case 4: return add_needles(at, half, count);
            case 5: return add_layers(at, half, count);
            case 6: return add_series(at, half, count);
            case 7: return add_points(at, half, 1 + count / 10);
            case 8: return add_copies(1 + count / 4);
            default: return add_giants(at, 1 + std::min<std::size_t>(count, 20));
        }
    }

    Random& random_;
    std::size_t most_;
    Soup soup_;
};

inline MixedWorld mixed_world(Random& random, std::size_t triangles) {
    MixedWorld world;
    world.soup = MixedParts(random, triangles).draw();
    Soup& soup = world.soup;
    const std::size_t count = soup.triangles.size();
    if (random.below(2) == 0) {
        for (std::size_t i = count; i > 1; --i)
            std::swap(soup.triangles[i - 1], soup.triangles[random.below(i)]);
    }
    // Faces of some triangles each, in ascending order or in any.
    FaceId face = 0;
    const std::size_t longest = 1 + random.below(6), gap = 1 + random.below(2);
    for (FaceId& of : soup.faces) {
        if (random.below(longest) == 0) face += static_cast<FaceId>(1 + random.below(gap));
        of = face;
    }
    if (random.below(3) == 0) {
        for (std::size_t i = count; i > 1; --i)
            std::swap(soup.faces[i - 1], soup.faces[random.below(i)]);
    }
    world.types.resize(face + 1);
    for (SurfaceId& type : world.types)
        type = static_cast<SurfaceId>(random.below(4));
    const std::size_t bodies = std::array<std::size_t, 4>{0, 3, 200, count}[random.below(4)];
    for (std::size_t i = 0; bodies > 0 && i < count; ++i)
        world.bodies.push_back(static_cast<std::uint32_t>(
            random.below(3) == 0 ? random.below(bodies) : i * std::min<std::size_t>(bodies, 1000) / count));
    return world;
}

}  // namespace slipface::scenes
