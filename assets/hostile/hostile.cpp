// slipface_generate_hostile OUT.obj [SEED]: a closed hall full of what breaks character controllers: needles,
// acute wedges, cracks narrower than the player, fans of edges, slivers, and triangles thrown in at random.
// Not a level to play in: `slipface audit` walks through it.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "slipface/base/files.h"
#include "slipface/base/types.h"

namespace slipface::generate {
namespace {

constexpr double half_size = 30.0, height = 16.0;
constexpr double free_around_spawn = 2.5;
constexpr double floor_below_origin = 1.0;  // walkers begin at the origin; heights below are above the floor

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double between(double low, double high) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 point(between(-1, 1), between(-1, 1), between(-1, 1));
            if (point.norm() > 0.01 && point.norm() <= 1.0) return point.normalized();
        }
    }
    Vec3 position(double lowest) {
        const double r = half_size - 1.0;
        return {between(-r, r), lowest, between(-r, r)};
    }

  private:
    std::uint64_t state_;
};

class Obj {
  public:
    void face(const std::vector<Vec3>& corners) {
        // Kept away from where the walkers begin.
        for (const Vec3& corner : corners) {
            if (corner.y() > 1e-9 && corner.y() < 4.0 &&
                Vec2(corner.x(), corner.z()).norm() < free_around_spawn)
                return;
        }
        std::string face = "f";
        for (const Vec3& corner : corners) {
            vertices_ += fmt::format("v {:.4f} {:.4f} {:.4f}\n", corner.x(), corner.y() - floor_below_origin,
                                     corner.z());
            face += fmt::format(" {}", ++count_);
        }
        text_ += face + "\n";
    }
    void tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        face({a, b, c});
        face({a, d, b});
        face({b, d, c});
        face({c, d, a});
    }
    void slab(const Vec3& a, const Vec3& b, double top) {  // a wall of no thickness from a to b
        face({a, b, Vec3(b.x(), top, b.z()), Vec3(a.x(), top, a.z())});
    }
    std::string text() const { return vertices_ + text_; }

  private:
    std::string vertices_, text_;
    std::size_t count_ = 0;
};

void hall(Obj& obj) {
    const double s = half_size;
    obj.face({{-s, 0, -s}, {-s, 0, s}, {s, 0, s}, {s, 0, -s}});
    obj.face({{-s, height, -s}, {s, height, -s}, {s, height, s}, {-s, height, s}});
    obj.face({{-s, 0, -s}, {s, 0, -s}, {s, height, -s}, {-s, height, -s}});
    obj.face({{s, 0, s}, {-s, 0, s}, {-s, height, s}, {s, height, s}});
    obj.face({{-s, 0, s}, {-s, 0, -s}, {-s, height, -s}, {-s, height, s}});
    obj.face({{s, 0, -s}, {s, 0, s}, {s, height, s}, {s, height, -s}});
}

// Spikes from the floor, the ceiling, and lying about.
void needles(Obj& obj, Random& random) {
    for (int i = 0; i < 160; ++i) {
        const Vec3 foot = random.position(i % 4 == 3 ? height : 0.0);
        Vec3 axis = random.direction();
        axis.y() = i % 4 == 3 ? -std::abs(axis.y()) : std::abs(axis.y());
        const double width = random.between(0.001, 0.4);
        obj.tetrahedron(foot + Vec3(width, 0, 0), foot + Vec3(-width, 0, width),
                        foot + Vec3(-width, 0, -width), foot + axis * random.between(0.2, 6.0));
    }
}

// Two walls that meet at 2 to 60 degrees, upright or leaning over the player.
void wedges(Obj& obj, Random& random) {
    for (int i = 0; i < 120; ++i) {
        const Vec3 tip = random.position(0.0);
        const Vec3 along = random.direction().cwiseProduct(Vec3(1, 0, 1)).normalized();
        const Vec3 aside(-along.z(), 0, along.x());
        const double length = random.between(1.0, 5.0), top = random.between(0.3, 5.0);
        const double opening = length * random.between(0.03, 1.0);
        const Vec3 lean = random.direction() * random.between(0.0, 1.5);
        for (const double side : {-0.5, 0.5}) {
            const Vec3 end = tip + along * length + aside * (side * opening);
            const Vec3 up(lean.x(), top, lean.z());
            obj.face({tip, end, end + up});
            obj.face({tip, end + up, tip + up});
        }
    }
}

// Pairs of walls from a hand's breadth to a player's width apart.
void cracks(Obj& obj, Random& random) {
    for (int i = 0; i < 60; ++i) {
        const Vec3 a = random.position(0.0);
        const Vec3 along = random.direction().cwiseProduct(Vec3(1, 0, 1)).normalized();
        const Vec3 aside(-along.z(), 0, along.x());
        const double gap = random.between(0.02, 0.85), length = random.between(1.0, 6.0);
        obj.slab(a, a + along * length, random.between(0.5, 4.0));
        obj.slab(a + aside * gap, a + aside * (gap * random.between(0.5, 1.5)) + along * length,
                 random.between(0.5, 4.0));
    }
}

// Edges that meet in one point at every angle: low pyramids of many sides, some of them pits' rims.
void fans(Obj& obj, Random& random) {
    for (int i = 0; i < 60; ++i) {
        const Vec3 foot = random.position(0.0);
        const Vec3 tip =
            foot + Vec3(random.between(-0.5, 0.5), random.between(0.05, 3.0), random.between(-0.5, 0.5));
        std::vector<Vec3> ring;
        const double radius = random.between(0.3, 3.0);
        for (int k = 0; k < 24; ++k) {
            const double fraction = k / 24.0,
                         turn = 4.0 * fraction;  // around a square: no sine, the same bits anywhere
            const double u = turn - std::floor(turn);
            const Vec3 corners[] = {{1, 0, 1}, {-1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}};
            const int side = static_cast<int>(turn);
            const Vec3 at = corners[side] * (1 - u) + corners[side + 1] * u;
            ring.emplace_back(foot + at * (radius * random.between(0.3, 1.0)));
        }
        for (std::size_t k = 0; k < ring.size(); ++k)
            obj.face({tip, ring[k], ring[(k + 1) % ring.size()]});
    }
}

// Slivers of a millimetre and triangles that nobody built.
void debris(Obj& obj, Random& random) {
    for (int i = 0; i < 900; ++i) {
        const Vec3 at = random.position(random.between(0.0, 8.0));
        const double size = i % 3 == 0 ? random.between(0.01, 0.3) : random.between(0.3, 4.0);
        const Vec3 b = at + random.direction() * size;
        const Vec3 c = i % 5 == 0 ? Vec3(0.5 * (at + b) + random.direction() * 0.001)
                                  : Vec3(at + random.direction() * size);
        if (b.y() > 0 && c.y() > 0) obj.face({at, b, c});
    }
}

}  // namespace

std::string hostile_obj(std::uint64_t seed) {
    Obj obj;
    Random random(seed);
    hall(obj);
    needles(obj, random);
    wedges(obj, random);
    cracks(obj, random);
    fans(obj, random);
    debris(obj, random);
    return "# A hall full of what breaks character controllers.\n" + obj.text();
}

}  // namespace slipface::generate

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        fmt::print(stderr, "usage: slipface_generate_hostile OUT.obj [SEED]\n");
        return 2;
    }
    const std::uint64_t seed = argc == 3 ? std::strtoull(argv[2], nullptr, 10) : 1;
    const slipface::Status status =
        slipface::write_file_atomic(argv[1], slipface::generate::hostile_obj(seed));
    if (status.ok()) return 0;
    fmt::print(stderr, "slipface_generate_hostile: {}\n", status.error().text());
    return 1;
}
