// Small worlds for movement tests: faces are added one by one, each with a surface type.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "slipface/base/hash.h"
#include "slipface/movement/step.h"

namespace slipface::test {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double tick = 1.0 / 60.0;

enum Preset : SurfaceId { plain, ice, ladder, sticky, bouncy, conveyor, turntable, hazard };

inline double radians(double degrees) {
    return degrees * pi / 180.0;
}

// Faces first, then ready(); after that scene() may be asked.
class Lab {
  public:
    std::vector<SurfaceType> surfaces = preset_surface_types();

    FaceId polygon(const std::vector<Vec3>& corners, SurfaceId surface = plain) {
        const auto first = static_cast<std::uint32_t>(positions_.size());
        for (const Vec3& corner : corners)
            positions_.push_back(corner.cast<float>());
        const auto face = static_cast<FaceId>(face_surfaces_.size());
        face_surfaces_.push_back(surface);
        for (std::uint32_t i = 2; i < corners.size(); ++i) {
            triangles_.push_back({first, first + i - 1, first + i});
            faces_.push_back(face);
        }
        return face;
    }
    FaceId floor(double height = 0.0, SurfaceId surface = plain, double half = 50.0) {
        return polygon(
            {{-half, height, -half}, {-half, height, half}, {half, height, half}, {half, height, -half}},
            surface);
    }
    // A plane through the origin that rises along +X at `angle` from the horizontal.
    FaceId slope(double angle, SurfaceId surface = plain, double half = 100.0) {
        const Vec3 up(std::cos(angle), std::sin(angle), 0.0);
        const Vec3 across(0.0, 0.0, 1.0);
        return polygon(
            {half * (-up - across), half * (-up + across), half * (up + across), half * (up - across)},
            surface);
    }
    // A vertical rectangle from a to b, `low` to `high`.
    FaceId wall(const Vec2& a, const Vec2& b, double low = -5.0, double high = 20.0,
                SurfaceId surface = plain) {
        return polygon({{a.x(), low, a.y()}, {b.x(), low, b.y()}, {b.x(), high, b.y()}, {a.x(), high, a.y()}},
                       surface);
    }
    // Half a pipe along Z with its axis at height `radius`: faces from the left rim down and up to the right.
    void half_pipe(int segments, double radius, SurfaceId surface, double half_length = 50.0) {
        for (int i = 0; i < segments; ++i) {
            const double a = pi * (1.0 + static_cast<double>(i) / segments);
            const double b = pi * (1.0 + static_cast<double>(i + 1) / segments);
            const Vec3 p(radius * std::cos(a), radius + radius * std::sin(a), half_length);
            const Vec3 q(radius * std::cos(b), radius + radius * std::sin(b), half_length);
            const Vec3 back(0.0, 0.0, -2.0 * half_length);
            polygon({p, q, q + back, p + back}, surface);
        }
    }

    void ready() {
        Result<CollisionWorld> built =
            CollisionWorld::build({.positions = positions_, .triangles = triangles_, .faces = faces_});
        ASSERT_TRUE(built.ok()) << built.error().text();
        world_ = std::move(built).value();
        for (FaceId face = 0; face < face_surfaces_.size(); ++face)
            world_.set_face_surface(face, face_surfaces_[face]);
        apply_surface_rules(world_, surfaces);
    }
    CollisionWorld& world() { return world_; }
    MovementScene scene() const { return {.collision = world_, .surfaces = surfaces}; }

  private:
    std::vector<Vec3f> positions_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<FaceId> faces_;
    std::vector<SurfaceId> face_surfaces_;
    CollisionWorld world_;
};

// Height of the centre above a plane through the origin with the unit normal `n` at which the ellipsoid is
// `skin` off it: the ellipsoid's extent along n is |R n| (componentwise product), and the plane is met where
// n.c = |R n| + skin.
inline double centre_height(const MovementSettings& s, const Vec3& n) {
    return (s.radii.cwiseProduct(n).norm() + s.skin) / n.y();
}

inline MovementSettings every_hack() {
    MovementSettings s = basic_settings();
    s.push_out = PushOut::analytic;
    set_switches(s, true);
    return s;
}

inline Vec3 slope_normal(double angle) {
    return {-std::sin(angle), std::cos(angle), 0.0};
}

inline PlayerState at(const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
    PlayerState state;
    state.position = position;
    state.velocity = velocity;
    return state;
}

inline PlayerInput wish(double x, double z, bool jump = false) {
    return {.wish = Vec2(x, z), .buttons = {Button::jump, jump}};
}

inline PlayerState run(const Lab& lab, const MovementSettings& settings, PlayerState state,
                       const PlayerInput& input, int ticks, double dt = tick) {
    for (int i = 0; i < ticks; ++i)
        state = step(lab.scene(), settings, state, input, dt).state;
    return state;
}

// A player who has come to rest on the slope through the origin, at x = z = 0.
inline PlayerState standing_on_slope(const Lab& lab, const MovementSettings& settings, double angle) {
    const PlayerState above = at({0.0, centre_height(settings, slope_normal(angle)) + 0.01, 0.0});
    return run(lab, settings, above, {}, 30);
}

inline std::uint64_t hash_of(const PlayerState& s, std::uint64_t previous) {
    Hasher hasher;
    hasher.u64(previous);
    for (int i = 0; i < 3; ++i)
        hasher.f64(s.position[i]);
    for (int i = 0; i < 3; ++i)
        hasher.f64(s.velocity[i]);
    hasher.u64(static_cast<std::uint64_t>(s.grounded) * 4 + static_cast<std::uint64_t>(s.climbing) * 2 +
               static_cast<std::uint64_t>(s.stuck));
    return hasher.value();
}

// Reproducible numbers without a library's own distributions, which differ between compilers.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 2 + 1) {}
    double between(double low, double high) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * (static_cast<double>(state_ >> 11) * 0x1.0p-53);
    }
    int below(int count) { return static_cast<int>(between(0.0, static_cast<double>(count))); }

  private:
    std::uint64_t state_;
};

inline std::vector<DecisionRecord> decisions_of(const TraceRecorder& trace, Decision kind) {
    std::vector<DecisionRecord> found;
    for (const TraceRecord& record : trace.records) {
        const auto* decision = std::get_if<DecisionRecord>(&record);
        if (decision != nullptr && decision->kind == kind) found.push_back(*decision);
    }
    return found;
}

inline bool has_decision(const TraceRecorder& trace, const std::string& hack, bool acted,
                         const std::string& sentence_part) {
    for (const TraceRecord& record : trace.records) {
        const auto* decision = std::get_if<DecisionRecord>(&record);
        if (decision == nullptr) continue;
        const DecisionInfo& info = decision_info(decision->kind);
        if (hack == info.hack && (info.outcome == Outcome::acted) == acted &&
            std::string(info.sentence).find(sentence_part) != std::string::npos) {
            return true;
        }
    }
    return false;
}

}  // namespace slipface::test
