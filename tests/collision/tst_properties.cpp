// Laws that hold for every triangle and every sweep.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>

#include "families.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::Soup;

// RapidCheck shrinks the seed and the family; the case is made from them.
families::Case some_case() {
    const auto family = *rc::gen::inRange<std::size_t>(0, families::all.size());
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    return families::all[family].make(random);
}

CollisionWorld world_of(const oracle::Triangle& t) {
    Soup soup;
    soup.add(t[0], t[1], t[2]);
    return soup.world();
}

std::optional<Contact> sweep(const families::Case& c) {
    return sweep_ellipsoid(world_of(c.triangle), c.radii, c.from, c.move);
}

void check(const char* what, const std::function<void()>& law) {
    EXPECT_TRUE(rc::check(what, law));
}

TEST(SweepProperty, ContactsAreWellFormed) {
    check("t in range, unit normal against the move, point on the ellipsoid", [] {
        const auto c = some_case();
        const auto contact = sweep(c);
        RC_PRE(contact.has_value());
        RC_ASSERT(contact->t >= 0.0 && contact->t <= 1.0);
        RC_ASSERT(std::abs(contact->normal.norm() - 1) < 1e-12);
        RC_ASSERT(contact->normal.dot(c.move) < 1e-6 * c.move.norm());
        const Vec3 centre = c.from + contact->t * c.move;
        const double distance = (contact->point - centre).cwiseQuotient(c.radii).norm();
        const double rounding = 1e-9 + 1e-14 * centre.norm() / c.radii.minCoeff();
        RC_ASSERT(distance < 1 + rounding);
        if (contact->t > 0) RC_ASSERT(distance > 1 - rounding);
    });
}

TEST(SweepProperty, MirroringMirrors) {
    check("mirroring the scene mirrors the contact bit for bit", [] {
        const auto c = some_case();
        const auto axis = *rc::gen::inRange(0, 3);
        families::Case mirrored = c;
        const auto flip = [axis](Vec3& v) { v[axis] = -v[axis]; };
        for (Vec3& corner : mirrored.triangle)
            flip(corner);
        flip(mirrored.from);
        flip(mirrored.move);
        const auto a = sweep(c);
        auto b = sweep(mirrored);
        // Where an answer hangs on which side the winding faces, a mirror changes it: only a centre in the
        // plane.
        const oracle::Sweep exact(c.triangle, c.radii, c.from, c.move);
        RC_PRE(exact.clearance(0) > -1 + 1e-9);
        RC_ASSERT(a.has_value() == b.has_value());
        if (!a) return;
        flip(b->normal);
        flip(b->point);
        RC_ASSERT(a->t == b->t);
        RC_ASSERT(a->normal == b->normal);
        RC_ASSERT(a->point == b->point);
        RC_ASSERT(a->feature == b->feature);
    });
}

TEST(SweepProperty, AShorterMoveAgrees) {
    check("cutting the move after the contact keeps it, cutting before loses it", [] {
        const auto c = some_case();
        const auto contact = sweep(c);
        RC_PRE(contact.has_value() && contact->t > 1e-3 && contact->t < 0.9);
        families::Case after = c;
        after.move *= std::min(1.0, contact->t * 1.05);
        const auto kept = sweep(after);
        RC_ASSERT(kept.has_value());
        RC_ASSERT(std::abs(kept->t * after.move.norm() - contact->t * c.move.norm()) < 1e-6);
        families::Case before = c;
        before.move *= contact->t * 0.999;
        RC_ASSERT(!sweep(before).has_value());
    });
}

TEST(SweepProperty, BeforeTheContactNothingOverlaps) {
    check("a centre short of the contact is outside, one past it is inside", [] {
        const auto c = some_case();
        const auto contact = sweep(c);
        RC_PRE(contact.has_value() && contact->t > 1e-3);
        const CollisionWorld world = world_of(c.triangle);
        const Vec3 before = c.from + (contact->t - 1e-4) * c.move;
        RC_ASSERT(!overlaps_any(world, c.radii, before));
    });
}

TEST(SweepProperty, SplittingATriangleChangesNothing) {
    check("a triangle cut in two at a point of its edge answers as the whole", [] {
        const auto c = some_case();
        // The middle of an edge is exact in float only if its corners are: snap them to a grid of 2^-10.
        families::Case snapped = c;
        for (Vec3& corner : snapped.triangle)
            corner = (corner * 512).array().round() / 512;
        const auto& t = snapped.triangle;
        const Vec3 middle = 0.5 * (t[0] + t[1]);
        RC_PRE(families::to_float(middle) == middle);
        for (const Vec3& corner : t)
            RC_PRE(families::to_float(corner) == corner);
        RC_PRE((t[1] - t[0]).cross(t[2] - t[0]).norm() > 1e-3);
        Soup halves;
        halves.add(t[0], middle, t[2]);
        halves.add(middle, t[1], t[2]);
        const auto whole = sweep(snapped);
        const auto cut = sweep_ellipsoid(halves.world(), c.radii, c.from, c.move);
        const oracle::Sweep exact(t, c.radii, c.from, c.move);
        // Overlapping from the start, each half has a nearest point and a way out of its own.
        RC_PRE(exact.clearance(0) > 0);
        // A graze within rounding may go either way.
        RC_PRE(std::abs(exact.clearance(exact.nearest_time())) > 1e-12);
        RC_ASSERT(whole.has_value() == cut.has_value());
        if (!whole) return;
        RC_ASSERT(std::abs(whole->t - cut->t) * c.move.norm() < 1e-6);
        RC_ASSERT((whole->normal - cut->normal).norm() < 1e-5);
    });
}

}  // namespace
}  // namespace slipface
