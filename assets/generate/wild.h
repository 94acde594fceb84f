// Natural things: rocks, spikes, crystals, palms, terrain.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model.h"

namespace slipface::generate {

// A repeatable fraction in [0, 1) for the n-th detail of a thing.
double scatter(std::uint32_t thing, std::uint32_t n);

// A boulder standing on `foot`.
void wild_rock(Model& model, const std::string& material, const Vec3& foot, double radius, double height,
               std::uint32_t seed);

// A pointed cone of flat faces from `foot` along `axis`, its foot sunk by a fifth of its length.
void spike(Model& model, const std::string& material, const Vec3& foot, const Vec3& axis, double radius,
           double length, int sides, std::uint32_t seed);

// A six-sided crystal with a pointed end.
void shard(Model& model, const std::string& material, const Vec3& foot, const Vec3& axis, double radius,
           double length);

// A beam from `a` to `b`, `width` wide and `height` high below the line.
void beam(Model& model, const std::string& material, const Vec3& a, const Vec3& b, double width,
          double height);

// A palm with a bent trunk; its leaves are `foliage`.
void palm(Model& model, const Vec3& foot, double height, std::uint32_t seed);

// A grass tuft or bush of upright leaves.
void tuft(Model& model, const Vec3& foot, double size, int leaves, std::uint32_t seed);

// An open ring of flat wall pieces seen from outside: a round tower from y0 (radius r0) to y1 (radius r1).
void tower(Model& model, const std::string& material, const Vec3& centre, double y0, double r0, double y1,
           double r1, int sides, double first_deg = 0);

// A ring seen from above (or from below) between two radii.
void ring(Model& model, const std::string& material, const Vec3& centre, double inner, double outer,
          int sides, bool up, double first_deg = 0);

// Ground as a grid of triangles. A cell whose material is empty is left out.
struct Ground {
    double x0 = 0, z0 = 0, step = 2.5;
    int columns = 0, rows = 0;  // cells
    std::function<double(double x, double z)> height{};
    std::function<std::string(double x, double z, double steepness)> material{};
    double jitter = 0.0;  // fraction of `step` by which inner corners move sideways
    bool faces_up = true;
    // With it, triangles all of whose corners are outside are left out, and diagonals do not depend on the
    // height: two sheets that meet where `outside` begins then have the same border.
    std::function<bool(double x, double z)> outside{};
};
void ground(Model& model, const Ground& shape);

}  // namespace slipface::generate
