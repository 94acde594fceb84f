// Any bytes as triangles, bodies, moves of triangles and queries: the build and every query must stay within
// memory and give well-formed answers, and a world of many triangles must answer as its triangles one by one.
#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "collision/brute_force.h"
#include "slipface/collision/neighbourhood.h"

namespace {

using namespace slipface;

class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool empty() const { return bytes_.empty(); }
    template <class T>
    T take() {
        T value{};
        const std::size_t size = std::min(sizeof(T), bytes_.size());
        std::memcpy(&value, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
        return value;
    }
    // Half of the numbers are small and on a grid, where triangles share corners and moves graze them.
    double number() {
        const auto kind = take<std::uint8_t>();
        if (kind < 160) return static_cast<double>(take<std::int8_t>()) / 8;
        if (kind < 240) return static_cast<double>(take<float>());
        return take<double>();
    }
    Vec3 vector() {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const std::optional<Contact>& contact, const CollisionWorld& world) {
    if (!contact) return;
    require(contact->t >= 0.0 && contact->t <= 1.0);
    require(contact->point.allFinite() && std::abs(contact->normal.norm() - 1.0) < 1e-9);
    require(contact->triangle < world.triangle_count());
}

void check_batch(const CollisionWorld& world, std::span<const Sweep> sweeps,
                 std::span<const std::optional<Contact>> contacts) {
    std::vector<std::optional<Contact>> out(sweeps.size());
    sweep_ellipsoids(world, sweeps, out);
    for (std::size_t i = 0; i < out.size(); ++i)
        require(scenes::same(out[i], contacts[i]));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    scenes::Soup soup;
    std::vector<std::uint32_t> bodies;
    const auto count = bytes.take<std::uint8_t>() % 40U;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a = bytes.vector();
        const Vec3 b = bytes.vector();
        soup.add(a, b, bytes.vector());
        bodies.push_back(bytes.take<std::uint8_t>() & 3U);
    }
    auto built = CollisionWorld::build({soup.positions, soup.triangles, soup.faces, bodies});
    if (!built) return 0;
    CollisionWorld& world = *built;
    std::vector<Sweep> sweeps;
    std::vector<std::optional<Contact>> contacts;
    while (!bytes.empty()) {
        const auto what = count > 0 ? bytes.take<std::uint8_t>() : 255;
        if (what < 48) {
            check_batch(world, sweeps, contacts);
            sweeps.clear();
            contacts.clear();
            // One triangle, or all of them.
            const auto first = static_cast<TriangleId>(what < 32 ? bytes.take<std::uint8_t>() % count : 0);
            const auto end = what < 32 ? first + 1 : static_cast<TriangleId>(count);
            std::vector<TriangleId> moved;
            std::vector<std::array<Vec3f, 3>> corners;
            for (TriangleId i = first; i < end; ++i) {
                moved.push_back(i);
                std::array<Vec3f, 3>& to = corners.emplace_back();
                for (Vec3f& corner : to)
                    corner = bytes.vector().cast<float>();
            }
            if (world.move_triangles(moved, corners)) {
                for (std::size_t i = 0; i < moved.size(); ++i) {
                    for (std::size_t k = 0; k < 3; ++k)
                        soup.positions[soup.triangles[moved[i]][k]] = corners[i][k];
                }
            }
        }
        const Vec3 radii = bytes.vector().cwiseAbs();
        const Vec3 from = bytes.vector();
        const Vec3 move = bytes.vector();
        const scenes::BruteForce brute(soup);
        const auto contact = sweep_ellipsoid(world, radii, from, move);
        check(contact, world);
        sweeps.push_back({radii, from, move});
        contacts.push_back(contact);
        require(scenes::same(contact, brute.sweep(radii, from, move)));
        require(scenes::same(cast_ray(world, from, move), brute.ray(from, move, HUGE_VAL)));
        // Squares that differ may have the same root, so two triangles may share a distance.
        const auto closest = closest_point(world, from);
        const auto expected = brute.closest(from, HUGE_VAL);
        require(closest.has_value() == expected.has_value());
        require(!closest || closest->distance == expected->distance);
        const auto overlaps = brute.overlaps(radii, from);
        require(overlaps_any(world, radii, from) == !overlaps.empty());
        // Around another place for another body, which mostly holds what the query needs and sometimes not.
        const auto larger = static_cast<double>(what % 5 + 1) / 2;
        const Vec3 body = what % 2 == 0 ? radii : larger * radii;
        const Neighbourhood near(world, body, from + (larger - 1) * move, larger * radii);
        require(scenes::same(sweep_ellipsoid(near, radii, from, move), contact));
        require(overlaps_any(near, radii, from) == !overlaps.empty());
        require(find_overlaps(near, radii, from, {}) == overlaps.size());
    }
    check_batch(world, sweeps, contacts);
    return 0;
}
