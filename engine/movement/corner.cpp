// Corners: one surface deflects the player into another.
//
// Deflecting at each contact alone sends the player to and fro between two walls; each return costs an
// iteration and shows as jitter. Contacts that follow each other without a way between them are one: what led
// to the first of them goes on as the vector nearest to it in the cone that all planes met so far leave. That
// is its projection on one plane or on the crease of two, or nothing: the player has arrived. It never leads
// against what led there and is never longer. A way between two contacts makes them two, as the facets of a
// pipe are, each of which takes its part. But nothing leads against the wish of the whole pass: walls at a
// wide angle would throw back a player that pushes into their corner.
#include <span>

#include "mover.h"

namespace slipface {

namespace {

// Leading into a plane by less than this fraction is rounding; the skin absorbs it.
constexpr double grazing = 1e-6;
// Square of the sine below which two planes have no crease.
constexpr double parallel = 1e-12;

// The planes that count for a displacement or a velocity that leads to `wish`. A horizontal move meets an
// overhang as a wall, and one that rises as the plane that it is (steep_walls.cpp).
struct Cone {
    std::array<Vec3, Corner::capacity> planes;
    int count = 0;

    template <class Counts>
    Cone(const Corner& corner, const Vec3& wish, const Counts& counts) {
        for (int i = 0; i < corner.count; ++i) {
            if (!counts(static_cast<std::size_t>(i))) continue;
            const Vec3& plane = corner.planes[static_cast<std::size_t>(i)];
            const bool flat = corner.pass == Pass::horizontal && plane.y() < 0.0 && !(wish.y() > 0.0);
            planes[static_cast<std::size_t>(count++)] = flat ? direction_of(horizontal(plane)) : plane;
        }
    }
    const Vec3& operator[](int i) const { return planes[static_cast<std::size_t>(i)]; }
    bool blocks(const Vec3& v) const {
        const double limit = -grazing * v.norm();
        for (int i = 0; i < count; ++i) {
            if (v.dot(planes[static_cast<std::size_t>(i)]) < limit) return true;
        }
        return false;
    }
    // The vector nearest to `v` that leads into no plane.
    Vec3 nearest(const Vec3& v, Rule& rule) const {
        if (!blocks(v)) return v;
        Vec3 best = Vec3::Zero();
        rule = Rule::stop;
        const auto consider = [&](const Vec3& candidate, Rule how) {
            if (!(candidate.squaredNorm() > best.squaredNorm()) || blocks(candidate)) return;
            best = candidate;
            rule = how;
        };
        for (int i = 0; i < count; ++i) {
            consider(slide_along(v, (*this)[i]), Rule::slide);
            for (int j = 0; j < i; ++j) {
                const Vec3 crease = (*this)[i].cross((*this)[j]);
                const double square = crease.squaredNorm();
                if (square >= parallel) consider(crease * (crease.dot(v) / square), Rule::crease);
            }
        }
        return best;
    }
};

// What becomes of a displacement or a velocity: nearest to what led here, unless that leads against the wish.
template <class Counts>
Vec3 freed(const Corner& corner, const Vec3& led, const Vec3& wish, const Counts& counts, Rule& rule) {
    const Vec3 next = Cone(corner, led, counts).nearest(led, rule);
    if (!(next.dot(wish) < -grazing * next.norm() * wish.norm())) return next;
    const Vec3 wished = Cone(corner, wish, counts).nearest(wish, rule);
    const double longest = led.norm();
    return wished.norm() > longest ? Vec3(direction_of(wished) * longest) : wished;
}

}  // namespace

Vec3 nearest_in_corner(const Corner& corner, const Vec3& velocity) {
    Rule ignored{};
    const auto of_velocity = [&](std::size_t i) { return corner.constrains_velocity[i]; };
    return Cone(corner, velocity, of_velocity).nearest(velocity, ignored);
}

void meet_others(Mover& mover, const Hit& hit, Corner& corner) {
    const double skin = mover.settings.skin;
    // So far ahead lies what the move grazes at seven degrees or more.
    const Vec3 ahead = mover.position + 8.0 * skin * direction_of(corner.led);
    std::array<SceneOverlap, 16> found;
    const std::size_t count = touched_in_scene(mover, mover.settings.radii, ahead, found);
    for (const SceneOverlap& other : std::span(found).first(count)) {
        if (other.feature != Feature::interior || other.face == hit.contact.face) continue;
        const SurfaceType& surface = surface_of(mover, other.surface);
        if (surface.keeps_energy || surface.climbable || sticks(mover, surface) ||
            restitution_of(mover, surface) > 0.0)
            continue;
        const double extent = mover.settings.radii.cwiseProduct(other.normal).norm();
        const double gap = other.normal.dot(mover.position - other.point) - extent;
        if (!(gap < 1.5 * skin)) continue;
        const bool walkable = is_walkable(mover, other.normal, surface);
        Vec3 plane = other.normal;
        if (hit.pass == Pass::horizontal) {
            plane = plane_of_wall(other.normal);
            if (walkable || plane.isZero(0.0)) continue;
            note_wall(mover, direction_of(horizontal(plane)));
        }
        corner.add(plane, true);
        mover.meet({.point = other.point,
                    .normal = other.normal,
                    .triangle = other.triangle,
                    .platform = other.platform,
                    .walkable = walkable});
    }
}

void respect_corner(Corner& corner, double left, Deflection& deflection) {
    const bool first = corner.count == 0;
    if (deflection.slides) {
        corner.add(deflection.plane, deflection.constrains_velocity);
    } else {
        // It turns the pass to something else, which only the planes met before may hinder.
        corner.wish = corner.led = left > 0.0 ? Vec3(deflection.remainder / left) : Vec3(Vec3::Zero());
        corner.wished_velocity = corner.led_velocity = deflection.velocity;
    }
    if (!first) {
        const auto all = [](std::size_t) { return true; };
        const auto of_velocity = [&](std::size_t i) { return corner.constrains_velocity[i]; };
        Rule ignored = deflection.rule;
        deflection.remainder = left * freed(corner, corner.led, corner.wish, all, deflection.rule);
        if (deflection.constrains_velocity)
            deflection.velocity =
                freed(corner, corner.led_velocity, corner.wished_velocity, of_velocity, ignored);
    }
    if (!deflection.slides) corner.add(deflection.plane, deflection.constrains_velocity);
}

}  // namespace slipface
