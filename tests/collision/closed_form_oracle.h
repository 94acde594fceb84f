// The exact sweep of one triangle once more, as the roots of quadratics in 113-bit arithmetic: the plane, the
// lines of three edges and three corners, each asked for itself. Shares neither the search of oracle.h, which
// knows of no feature, nor the formulas of the engine, which start from the foot of a perpendicular.
#pragma once

#include <limits>
#include <optional>

#include "oracle.h"

namespace slipface::oracle {

// Infinity for 113-bit numbers that stand for "never" and "nowhere".
inline Quad never() {
    return static_cast<Quad>(std::numeric_limits<double>::infinity());
}
// Newton's steps from the double root double its 53 good bits twice.
inline Quad square_root(Quad x) {
    if (x == 0) return 0;
    Quad root = std::sqrt(static_cast<double>(x));
    for (int step = 0; step < 2; ++step)
        root = (root + x / root) / 2;
    return root;
}
inline QuadVec cross(const QuadVec& a, const QuadVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Quad length(const QuadVec& a) {
    return square_root(dot(a, a));
}
// The time at which a t^2 + 2 b t + c, positive at t = 0, first falls to 0.
inline Quad first_fall(Quad a, Quad b, Quad c) {
    const Quad disc = b * b - a * c;
    // -b and the root have one sign: nothing is subtracted.
    return b < 0 && c >= 0 && disc > 0 ? c / (square_root(disc) - b) : never();
}

class ClosedForm {
  public:
    ClosedForm(const Triangle& triangle, const Vec3& radii, const Vec3& from, const Vec3& move)
        : radii_(quad(radii)), d_(quad(move) / quad(radii)) {
        for (std::size_t k = 0; k < 3; ++k) {
            corners_[k] = (quad(triangle[k]) - quad(from)) / radii_;
            edges_[k] = (quad(triangle[(k + 1) % 3]) - quad(triangle[k])) / radii_;
        }
        n_ = cross(edges_[0], edges_[1]);
    }

    // Time, before or after the move's end, at which a sphere of this radius that starts apart first touches;
    // never() if it does not. Whatever touches a part of the triangle touches the triangle, and its first
    // touch is one of these: so the least of them is it. One that rounding puts beside its part by e comes
    // too early by what changes the distance by e^2 / 2, and the neighbouring part has the right one.
    Quad first_touch(Quad radius = 1) const {
        Quad first = plane_touch(radius);
        for (std::size_t k = 0; k < 3; ++k) {
            first = least(first, edge_touch(k, radius));
            const QuadVec& a = corners_[k];
            first = least(first, first_fall(dot(d_, d_), -dot(d_, a), dot(a, a) - radius * radius));
        }
        return first;
    }

    // Centre less nearest point at time t, sphere space.
    QuadVec gap(Quad t) const {
        const QuadVec p = t * d_;
        QuadVec nearest{never(), 0, 0};
        const auto offer = [&nearest](const QuadVec& other) {
            if (dot(other, other) < dot(nearest, nearest)) nearest = other;
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const QuadVec w = p - corners_[k];
            offer(w);
            const Quad position = dot(w, edges_[k]);
            const Quad square = dot(edges_[k], edges_[k]);
            if (position > 0 && position < square) offer(cross(edges_[k], cross(w, edges_[k])) / all(square));
        }
        if (above_triangle(p)) offer((dot(n_, p - corners_[0]) / dot(n_, n_)) * n_);
        return nearest;
    }
    QuadVec move() const { return d_; }

    // How large the numbers are that a distance is made from: errors of distances, in radii, are roundings of
    // this.
    double reach() const {
        const Quad far = length(corners_[0]) + length(corners_[1]) + length(corners_[2]);
        return static_cast<double>(far + length(d_));
    }
    // How much more a normal errs than the edges that it is made from: 1 / sine of the angle between the two
    // that meet at the second corner. Large for slivers.
    double sharpness() const {
        return static_cast<double>(length(edges_[0]) * length(edges_[1]) / length(n_));
    }

  private:
    static Quad least(Quad a, Quad b) { return b < a ? b : a; }
    static QuadVec all(Quad x) { return {x, x, x}; }

    // Inner side of all three edges; never without an area.
    bool above_triangle(const QuadVec& p) const {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k)
            inside = inside && dot(n_, cross(edges_[k], p - corners_[k])) > 0;
        return inside;
    }
    Quad plane_touch(Quad radius) const {
        const Quad height = dot(n_, corners_[0]);  // of the plane above the start, times |n|
        const Quad gap = (height < 0 ? -height : height) - radius * length(n_);
        const Quad speed = height < 0 ? -dot(n_, d_) : dot(n_, d_);  // towards it
        if (gap < 0 || speed <= 0) return never();
        const Quad t = gap / speed;
        return above_triangle(t * d_) ? t : never();
    }
    // |(t d - a) x e| = radius |e|
    Quad edge_touch(std::size_t k, Quad radius) const {
        const QuadVec& e = edges_[k];
        const QuadVec de = cross(d_, e);
        const QuadVec ae = cross(corners_[k], e);
        const Quad ee = dot(e, e);
        const Quad t = first_fall(dot(de, de), -dot(de, ae), dot(ae, ae) - radius * radius * ee);
        if (!(t < never())) return never();
        const Quad position = dot(t * d_ - corners_[k], e);
        return position >= 0 && position <= ee ? t : never();
    }

    QuadVec radii_;
    QuadVec d_;
    std::array<QuadVec, 3> corners_;
    std::array<QuadVec, 3> edges_;  // from corner k to the next
    QuadVec n_;
};

}  // namespace slipface::oracle
