// A half-pipe of 768 faces: nearly round, and still flat faces.
//
// Each of the 767 edges turns the way by a = pi / 768. A slide there keeps cos a of the speed, so without the
// hack the fraction cos(a)^767 = exp(-767 a a / 2) = 0.9936 is left: pi * pi / (2 * 768) = 0.64 % is lost,
// and the loss goes to 0 only as fast as the faces grow in number.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {
namespace {

constexpr int faces = 768;
constexpr double pipe_radius = 5.0;

struct Pipe {
    Lab lab;
    MovementSettings s = basic_settings();
    Vec3 start;  // on the first face at the left rim, a skin off
    Vec3 down;   // along that face
};

Pipe make_pipe() {
    Pipe pipe;
    pipe.lab.half_pipe(faces, pipe_radius, ice);
    pipe.lab.ready();
    pipe.s.radii = Vec3(0.4, 0.4, 0.4);
    // A face is 2 cm long and a tick at 10 m/s passes eight of them: parts of 1/720 s, so that no part needs
    // more than max_slides. A player who meets a face at pi / 768 is turned by it only once the skin is used
    // up, which with 2 mm is after some faces, by all their angles at once; 1e-5 m are used up within one.
    pipe.s.sub_step = 1.0 / 720;
    pipe.s.skin = 1e-5;
    const double half = pi / faces / 2;  // the first face leans by this from the vertical
    const Vec3 normal(std::cos(half), std::sin(half), 0.0);
    pipe.down = Vec3(std::sin(half), -std::cos(half), 0.0);
    const double apothem = pipe_radius * std::cos(half) - pipe.s.radii.x() - pipe.s.skin;
    pipe.start = Vec3(0.0, pipe_radius, 0.0) - apothem * normal;
    return pipe;
}

// Through the pipe and out of it at the right rim, where nothing turns any more.
PlayerState ride_through(const Pipe& pipe, double speed) {
    PlayerState state = at(pipe.start, speed * pipe.down);
    for (int i = 0; i < 600 && state.position.y() < pipe_radius + 1.0; ++i)
        state = step(pipe.lab.scene(), pipe.s, state, {}, tick).state;
    EXPECT_GT(state.position.y(), pipe_radius + 1.0);
    EXPECT_GT(state.position.x(), 4.0);
    return state;
}

TEST(HalfPipe, Of768FacesKeepsTheSpeed) {
    // Turning keeps the length but for rounding: 767 turns of a few units in the last place.
    Pipe pipe = make_pipe();
    pipe.s.gravity = 0.0;
    EXPECT_NEAR(ride_through(pipe, 10.0).velocity.norm(), 10.0, 767 * 8e-16 * 10.0);
}

TEST(HalfPipe, Of768FacesTakesTheProductOfTheCosinesWithoutKeepEnergy) {
    Pipe pipe = make_pipe();
    pipe.s.gravity = 0.0;
    pipe.s.keep_energy = false;
    const double left = std::pow(std::cos(pi / faces), faces - 1);
    EXPECT_NEAR(left, 1.0 - pi * pi / (2.0 * faces), 1e-4);
    EXPECT_NEAR(ride_through(pipe, 10.0).velocity.norm(), 10.0 * left, 1e-5);
}

struct Swing {
    double least = 1.0, maximum = 1.0;  // energy by mass above the lowest point, as a fraction of the first
    double first_loss = -1.0;           // the fraction lost at the first turn on the far side
};

// 10 s from rim to rim under gravity, from rest.
Swing swing(const Pipe& pipe) {
    PlayerState state = at(pipe.start);
    const double apothem = pipe_radius * std::cos(pi / faces / 2) - pipe.s.radii.x() - pipe.s.skin;
    const auto fraction = [&](const PlayerState& p) {
        const double height = p.position.y() - (pipe_radius - apothem);
        const double above = pipe.start.y() - (pipe_radius - apothem);
        return (0.5 * p.velocity.squaredNorm() + pipe.s.gravity * height) / (pipe.s.gravity * above);
    };
    Swing result;
    for (int i = 0; i < 600; ++i) {
        const bool to_the_right = state.velocity.x() > 1e-3;
        state = step(pipe.lab.scene(), pipe.s, state, {}, tick).state;
        const double now = fraction(state);
        result.least = std::min(result.least, now);
        result.maximum = std::max(result.maximum, now);
        if (result.first_loss < 0.0 && to_the_right && state.position.x() > 0.0 &&
            state.velocity.x() <= 0.0) {
            result.first_loss = 1.0 - now;
        }
    }
    return result;
}

TEST(HalfPipe, Of768FacesKeepsTheEnergyOfASwing) {
    // 7200 parts, each of which rounds a few units in the last place, 3e-16: less than 1e-11.
    const Swing kept = swing(make_pipe());
    EXPECT_NEAR(kept.least, 1.0, 1e-11);
    EXPECT_NEAR(kept.maximum, 1.0, 1e-11);
}

TEST(HalfPipe, Of768FacesTakesEnergyFromASwingWithoutKeepEnergy) {
    // At each edge the fraction sin(a)^2 of the kinetic energy is lost. At the angle b below the rim that
    // energy is g r sin b of the g r of the fall, so a pass loses the sum of a a sin b over the edges, which
    // lie a apart: a times the integral of sin b from 0 to pi, 2 a = 0.0082. A part of 1/2880 s still cuts
    // some corners, where gravity and not a face bends the way: up to a fifth less.
    Pipe pipe = make_pipe();
    pipe.s.keep_energy = false;
    pipe.s.sub_step = 1.0 / 2880;
    const double loss = 2.0 * pi / faces;
    EXPECT_NEAR(swing(pipe).first_loss, 0.9 * loss, 0.1 * loss);
    EXPECT_LT(swing(pipe).maximum, 1.0 + 1e-11);
}

}  // namespace
}  // namespace slipface::test
