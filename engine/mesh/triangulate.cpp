#include "slipface/mesh/triangulate.h"

#include <algorithm>
#include <cmath>

#include "newell.h"

namespace slipface {
namespace {

// Twice the signed area of a triangle. Differences of floats are exact in double unless the floats differ
// very much in size, so collinear corners give zero.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The corners projected along the largest component of the normal, counter-clockwise.
std::vector<Vec2> project(std::span<const Vec3f> corners, const Vec3& normal) {
    Eigen::Index dropped = 0;
    normal.cwiseAbs().maxCoeff(&dropped);
    Eigen::Index u = (dropped + 1) % 3;
    Eigen::Index v = (dropped + 2) % 3;
    if (normal[dropped] < 0.0) std::swap(u, v);
    std::vector<Vec2> flat;
    flat.reserve(corners.size());
    for (const Vec3f& corner : corners)
        flat.emplace_back(corner[u], corner[v]);
    return flat;
}

// The remaining polygon while ears are cut off, as a ring of corners.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<Vec2>& points)
        : points_(points),
          next_(points.size()),
          previous_(points.size()),
          ear_(points.size()),
          blocks_(points.size()) {
        const auto count = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            next_[i] = i + 1 == count ? 0 : i + 1;
            previous_[i] = i == 0 ? count - 1 : i - 1;
        }
        // Only a corner that is reflex or straight can lie in an ear.
        for (std::uint32_t i = 0; i < count; ++i) {
            blocks_[i] = corner_turn(i) <= 0.0;
            if (blocks_[i]) blockers_.push_back(i);
        }
        std::sort(blockers_.begin(), blockers_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return points_[a].x() < points_[b].x(); });
        for (std::uint32_t i = 0; i < count; ++i)
            ear_[i] = is_ear(i);
    }

    void cut(std::vector<std::array<std::uint32_t, 3>>& triangles) {
        std::uint32_t at = next_[0];
        for (std::size_t left = points_.size(); left > 2; --left) {
            const std::uint32_t tip = left == 3 ? at : choose(at, left);
            const std::uint32_t before = previous_[tip];
            const std::uint32_t after = next_[tip];
            triangles.push_back({before, tip, after});
            next_[before] = after;
            previous_[after] = before;
            blocks_[tip] = false;
            refresh(before);
            refresh(after);
            at = after;
        }
    }

  private:
    double corner_turn(std::uint32_t i) const {
        return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    bool is_ear(std::uint32_t i) const {
        const Vec2& a = points_[previous_[i]];
        const Vec2& b = points_[i];
        const Vec2& c = points_[next_[i]];
        if (!(turn(a, b, c) > 0.0)) return false;
        const Vec2 low = a.cwiseMin(b).cwiseMin(c);
        const Vec2 high = a.cwiseMax(b).cwiseMax(c);
        auto other =
            std::lower_bound(blockers_.begin(), blockers_.end(), low.x(),
                             [&](std::uint32_t corner, double x) { return points_[corner].x() < x; });
        for (; other != blockers_.end() && points_[*other].x() <= high.x(); ++other) {
            const Vec2& p = points_[*other];
            if (!blocks_[*other] || p.y() < low.y() || p.y() > high.y()) continue;
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
        }
        return true;
    }

    // The first ear from `at` on. A ring has none only if it crosses or touches itself or has no area: then a
    // straight corner, else the one with the largest turn.
    std::uint32_t choose(std::uint32_t at, std::size_t left) const {
        std::uint32_t straight = no_id;
        std::uint32_t sharpest = at;
        double maximum = corner_turn(at);
        for (std::size_t i = 0; i < left; ++i, at = next_[at]) {
            if (ear_[at]) return at;
            const double turned = corner_turn(at);
            if (turned == 0.0 && straight == no_id) straight = at;
            if (turned > maximum) {
                maximum = turned;
                sharpest = at;
            }
        }
        return straight != no_id ? straight : sharpest;
    }

    // Cutting an ear changes only its two neighbours. One that has become convex no longer blocks an ear.
    void refresh(std::uint32_t i) {
        if (corner_turn(i) > 0.0) blocks_[i] = false;
        ear_[i] = is_ear(i);
    }

    const std::vector<Vec2>& points_;
    std::vector<std::uint32_t> next_, previous_;
    std::vector<char> ear_;
    std::vector<char> blocks_;  // [corner] still in the ring and not convex
    std::vector<std::uint32_t>
        blockers_;  // corners that block at first, sorted by x; an ear tests only those in its range
};

void fan(std::size_t count, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    for (std::uint32_t i = 2; i < count; ++i)
        triangles.push_back({0, i - 1, i});
}

}  // namespace

void triangulate_polygon(std::span<const Vec3f> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() <= 3 || corners.size() > max_clipped_corners) return fan(corners.size(), triangles);
    const Vec3 normal = newell_sum(corners.size(), [&](std::size_t i) { return corners[i]; });
    if (normal.isZero(0.0)) return fan(corners.size(), triangles);
    const std::vector<Vec2> flat = project(corners, normal);
    EarClipper(flat).cut(triangles);
}

}  // namespace slipface
