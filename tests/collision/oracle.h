// The exact sweep of one triangle, found another way than the engine finds it: the distance of a moving point
// to a convex set is convex in time, so bracketing the zero of its slope finds the minimum and bracketing the
// fall of its value the first touch. Needs nothing but the closest point of a triangle (C. Ericson,
// "Real-Time Collision Detection", 5.1.5), in 113-bit arithmetic.
#pragma once

#include <array>
#include <cmath>

#include "slipface/base/types.h"

namespace slipface::oracle {

__extension__ typedef __float128 Quad;

struct QuadVec {
    Quad x, y, z;
};
inline QuadVec quad(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
inline QuadVec operator+(const QuadVec& a, const QuadVec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline QuadVec operator-(const QuadVec& a, const QuadVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline QuadVec operator*(Quad s, const QuadVec& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline QuadVec operator/(const QuadVec& a, const QuadVec& b) {
    return {a.x / b.x, a.y / b.y, a.z / b.z};
}
inline Quad dot(const QuadVec& a, const QuadVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 vec(const QuadVec& a) {
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

using Triangle = std::array<Vec3, 3>;

inline QuadVec closest_on_segment(const QuadVec& p, const QuadVec& a, const QuadVec& b) {
    const QuadVec e = b - a;
    const Quad ee = dot(e, e);
    if (ee == 0) return a;
    const Quad s = dot(p - a, e) / ee;
    return s <= 0 ? a : s >= 1 ? b : a + s * e;
}

inline QuadVec closest_on_triangle(const QuadVec& p, const QuadVec& a, const QuadVec& b, const QuadVec& c) {
    const QuadVec ab = b - a;
    const QuadVec ac = c - a;
    const QuadVec ap = p - a;
    const Quad d1 = dot(ab, ap);
    const Quad d2 = dot(ac, ap);
    const Quad d3 = dot(ab, p - b);
    const Quad d4 = dot(ac, p - b);
    const Quad d5 = dot(ab, p - c);
    const Quad d6 = dot(ac, p - c);
    const Quad va = d3 * d6 - d5 * d4;
    const Quad vb = d5 * d2 - d1 * d6;
    const Quad vc = d1 * d4 - d3 * d2;
    if (va > 0 && vb > 0 && vc > 0) {
        const Quad sum = va + vb + vc;
        return a + (vb / sum) * ab + (vc / sum) * ac;
    }
    const QuadVec on_ab = closest_on_segment(p, a, b);
    const QuadVec on_bc = closest_on_segment(p, b, c);
    const QuadVec on_ca = closest_on_segment(p, c, a);
    const Quad ab2 = dot(p - on_ab, p - on_ab);
    const Quad bc2 = dot(p - on_bc, p - on_bc);
    const Quad ca2 = dot(p - on_ca, p - on_ca);
    if (ab2 <= bc2 && ab2 <= ca2) return on_ab;
    return bc2 <= ca2 ? on_bc : on_ca;
}

// A triangle and the path of an ellipsoid's centre, in sphere space.
class Sweep {
  public:
    Sweep(const Triangle& triangle, const Vec3& radii, const Vec3& from, const Vec3& move)
        : radii_(quad(radii)), d_(quad(move) / quad(radii)) {
        for (std::size_t k = 0; k < 3; ++k)
            corners_[k] = (quad(triangle[k]) - quad(from)) / radii_;
    }

    // Centre less closest point at time t, sphere space.
    QuadVec gap(Quad t) const {
        const QuadVec p = t * d_;
        return p - closest_on_triangle(p, corners_[0], corners_[1], corners_[2]);
    }
    // Distance less 1: negative inside. The rounding of the double result is relative to itself.
    double clearance(Quad t) const {
        const QuadVec g = gap(t);
        const Quad square = dot(g, g);
        return static_cast<double>((square - 1) /
                                   (1 + static_cast<Quad>(std::sqrt(static_cast<double>(square)))));
    }
    // Half the change of the squared distance with t; grows with t because the distance is convex.
    Quad slope(Quad t) const { return dot(gap(t), d_); }

    // Time in [0, 1] of least distance.
    Quad nearest_time() const {
        if (slope(0) >= 0) return 0;
        if (slope(1) <= 0) return 1;
        return root([this](Quad t) { return -slope(t); }, 1);
    }
    // Time in [0, end] at which the distance falls to 1, given that it is more at 0 and less at `end`.
    Quad first_touch(Quad end) const {
        return root(
            [this](Quad t) {
                const QuadVec g = gap(t);
                return dot(g, g) - 1;
            },
            end);
    }
    // Contact normal at time t, world space, unit.
    Vec3 normal(Quad t) const { return vec(gap(t) / radii_).normalized(); }

  private:
    // The end of the last bracket around the place where `value`, positive at 0, stops being positive:
    // secants of the bracket (Illinois), and its middle every third time, so that it shrinks whatever the
    // function.
    template <class Value>
    static Quad root(Value&& value, Quad end) {
        Quad low = 0;
        Quad at_low = value(low);
        Quad at_end = value(end);
        int kept = 0;  // which end stayed last: -1 low, 1 end
        for (int i = 0; i < 150 && end - low > Quad(0x1p-90); ++i) {
            const bool halve = i % 3 == 2 || !(at_low > at_end);
            Quad middle = halve ? (low + end) / 2 : low + (end - low) * (at_low / (at_low - at_end));
            if (!(middle > low && middle < end)) middle = (low + end) / 2;
            const Quad here = value(middle);
            if (here > 0) {
                low = middle;
                at_low = here;
                if (kept == 1) at_end /= 2;
                kept = 1;
            } else {
                end = middle;
                at_end = here;
                if (kept == -1) at_low /= 2;
                kept = -1;
            }
        }
        return end;
    }

    QuadVec radii_;
    QuadVec d_;
    std::array<QuadVec, 3> corners_;
};

}  // namespace slipface::oracle
