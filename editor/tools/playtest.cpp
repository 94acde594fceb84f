#include "tools/playtest.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr double steepest_look = 1.5;   // radians
constexpr double fall_limit_m = 60.0;   // below the level
constexpr double camera_radius = 0.15;  // metres kept between the third-person camera and walls
constexpr double eye_height = 0.7;      // shares of the vertical radius above the centre
constexpr double shoulder_height = 0.5;

Vec3 forward_direction(double yaw, double pitch) {
    return {-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

Vec2 world_wish(const Vec2& stick, double yaw) {
    if (!stick.allFinite()) return Vec2::Zero();
    const Vec2 right(std::cos(yaw), -std::sin(yaw));
    const Vec2 forward(-std::sin(yaw), -std::cos(yaw));
    const Vec2 wish = right * stick.x() + forward * stick.y();
    const double length = wish.norm();
    return length > 1.0 ? Vec2(wish / length) : wish;
}

std::vector<std::string> changed_settings(const MovementSettings& settings) {
    std::vector<std::string> changed;
    const MovementSettings defaults;
    for (const SettingInfo& info : settings_table()) {
        const double value = get_setting(settings, info);
        if (value != get_setting(defaults, info))
            changed.push_back(std::string(info.name) + "=" + to_text(value));
    }
    return changed;
}

}  // namespace

void Playtest::start(const Vec3& spawn, double spawn_yaw) {
    spawn_ = spawn;
    state_ = PlayerState{};
    state_.position = spawn;
    previous_ = state_;
    yaw = spawn_yaw;
    pitch = -0.2;
    unspent_s_ = 0.0;
    jump_pressed_ = false;
    trace_.clear();
    tape_.start = spawn;
    tape_.settings.clear();
    tape_.segments.clear();
    tape_repeats_ = true;
}

void Playtest::name_level(std::string name, std::uint64_t fingerprint) {
    tape_.level_name = std::move(name);
    tape_.level_fingerprint = fingerprint;
}

int Playtest::advance(const MovementScene& scene, const MovementSettings& settings,
                      const PlaytestInput& input, double seconds) {
    if (input.look.allFinite()) {
        yaw = std::remainder(yaw - input.look.x(), 2.0 * std::numbers::pi);
        pitch = std::clamp(pitch + input.look.y(), -steepest_look, steepest_look);
    }
    jump_pressed_ = jump_pressed_ || input.jump;
    if (!(seconds > 0.0)) return 0;

    unspent_s_ += seconds;
    int ticks = 0;
    for (; unspent_s_ >= tick_s; ++ticks) {
        if (ticks == max_ticks_per_frame) {
            unspent_s_ = 0.0;
            break;
        }
        unspent_s_ -= tick_s;

        if (tape_.segments.empty()) {
            tape_settings_ = settings;
            tape_.settings = changed_settings(settings);
        } else if (!(tape_settings_ == settings)) {
            tape_repeats_ = false;
        }
        const PlayerInput tick_input{world_wish(input.stick, yaw), jump_pressed_ || input.jump};
        jump_pressed_ = false;
        append_tick(tape_, tick_input);

        TraceRecorder recorder;
        previous_ = state_;
        state_ = step(scene, settings, state_, tick_input, tick_s, &recorder).state;
        trace_ = std::move(recorder.records);
        if (state_.hazard) {
            state_ = PlayerState{};
            state_.position = spawn_;
            state_.jump_held = tick_input.jump;
            previous_ = state_;
        }
        const Aabb bounds = scene.collision.bounds();
        if (!bounds.empty() && state_.position.y() < std::min(bounds.min.y(), spawn_.y()) - fall_limit_m) {
            const double looked = pitch;
            start(spawn_, yaw);
            pitch = looked;
            return ticks + 1;
        }
    }
    return ticks;
}

Vec3 Playtest::shown_position() const {
    const double share = std::clamp(unspent_s_ / tick_s, 0.0, 1.0);
    return previous_.position + share * (state_.position - previous_.position);
}

Camera Playtest::camera(const MovementScene& scene, const MovementSettings& settings) const {
    Camera camera;
    const Vec3 forward = forward_direction(yaw, pitch);
    if (first_person) {
        camera.eye = shown_position() + Vec3(0.0, eye_height * settings.radii.y(), 0.0);
        camera.target = camera.eye + forward;
        return camera;
    }
    const Vec3 shoulder = shown_position() + Vec3(0.0, shoulder_height * settings.radii.y(), 0.0);
    const double radius = std::min(camera_radius, 0.3 * settings.radii.minCoeff());
    const Vec3 back = -boom * forward;
    const std::optional<Contact> wall =
        sweep_ellipsoid(scene.collision, Vec3::Constant(radius), shoulder, back);
    const double share = wall ? wall->t : 1.0;
    camera.eye = shoulder + share * back;
    camera.target = camera.eye + forward;
    camera.near_plane = std::min(camera.near_plane, 0.5 * radius);
    return camera;
}

}  // namespace slipface
