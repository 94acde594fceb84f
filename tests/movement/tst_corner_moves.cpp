// Moves in acute corners against the exact answer: the projection of the move on the cone of the directions
// that lead into no plane.
//
// A sweep hits a plane only where the move would come nearer to it than the skin, so a move that grazes a
// plane may use up the skin there instead of being deflected. The end then lies in the cone shifted out by a
// skin, and the answers of both cones differ by no more than their points do: `reach_of_skin`. That bound
// shrinks with the skin, so the same moves are made with a skin of 2 mm and one of 1e-6 m.
#include <algorithm>

#include "cone.h"

namespace slipface::test {
namespace {

struct CornerMove {
    double error = 0.0;          // metres between the end and the exact one
    double reach_of_skin = 0.0;  // what the skin may make of it
};

// The player stands a skin off every plane.
CornerMove corner_move(const std::vector<Vec3>& normals, const MovementSettings& s, const Vec3& move) {
    Lab lab = corner_of(normals);
    const std::vector<HalfSpace> room = room_in(lab, s);
    std::vector<HalfSpace> cone, shifted;
    for (const HalfSpace& space : room) {
        cone.push_back({space.normal, 0.0});
        shifted.push_back({space.normal, s.skin});
    }
    const Vec3 from = common_point(room);
    const SlideResult result = slide_move(lab.scene(), s, from, move);
    EXPECT_FALSE(overlaps_any(lab.world(), s.radii, result.position));
    // The shifted cone's own point, or what of its line is nearest to the origin.
    const Vec3 point = common_point(shifted);
    return {.error = (result.position - from - nearest_in(cone, move).value()).norm(),
            .reach_of_skin = point.norm()};
}

TEST(CornerMoves, InAcuteWedgesAreTheExactProjection) {
    for (const double skin : {0.002, 1e-6}) {
        Random random(31);
        MovementSettings s = basic_settings();
        s.skin = skin;
        int exact = 0, all = 0;
        for (int degrees = 5; degrees <= 85; degrees += 5) {
            for (int i = 0; i < 60; ++i) {
                const Vec3 move = random.between(0.01, 0.5) * random_direction(random);
                const CornerMove made = corner_move(wedge_normals(random, radians(degrees)), s, move);
                // corner.cpp takes 1e-6 of a move for rounding.
                EXPECT_LT(made.error, made.reach_of_skin + 1e-6) << degrees << ", move " << i;
                exact += made.error < 1e-6 ? 1 : 0;
                ++all;
            }
        }
        EXPECT_GE(exact, (skin < 1e-5 ? 1.0 : 0.95) * all) << "skin " << skin;
    }
}

TEST(CornerMoves, InAcuteCornersOfThreeFacesAreTheExactProjection) {
    // Three planes may each turn the move once, and the way along the last crease is a fourth sweep.
    for (const double skin : {0.002, 1e-6}) {
        Random random(32);
        MovementSettings s = basic_settings();
        s.skin = skin;
        s.max_slides = 4;
        int exact = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec3 move = random.between(0.01, 0.5) * random_direction(random);
            const CornerMove made = corner_move(acute_corner_normals(random), s, move);
            EXPECT_LT(made.error, made.reach_of_skin + 1e-6) << "move " << i;
            exact += made.error < 1e-6 ? 1 : 0;
        }
        EXPECT_GE(exact, skin < 1e-5 ? 1000 : 950) << "skin " << skin;
    }
}

}  // namespace
}  // namespace slipface::test
