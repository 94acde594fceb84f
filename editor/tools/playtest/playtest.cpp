#include "tools/playtest/playtest.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipface {
namespace {

constexpr double steepest_look = 1.5;   // radians
constexpr double camera_radius = 0.15;  // metres kept between the third-person camera and walls
constexpr double eye_height = 0.7;      // fractions of the vertical radius above the centre
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

}  // namespace

void Playtest::start(const Vec3& spawn, double spawn_yaw) {
    spawn_ = spawn;
    spawn_yaw_ = spawn_yaw;
    falls_ = 0;
    state_ = PlayerState{};
    state_.position = spawn;
    shown_from_ = shown_to_ = spawn;
    yaw = spawn_yaw;
    pitch = -0.2;
    unspent_s_ = 0.0;
    pressed_ = {};
    trace_.clear();
    tape_.start = spawn;
    tape_.from_basic = true;
    tape_.settings.clear();
    tape_.segments.clear();
    tape_.changes.clear();
    tape_.end_hash.reset();
    tape_ticks_ = 0;
    hash_ = 0;
}

void Playtest::resume(const Tape& tape, const MovementSettings& settings, const PlayerState& state,
                      const Vec3& position, std::uint64_t hash, double state_yaw) {
    start(tape.start.value_or(position), state_yaw);
    shown_from_ = shown_to_ = position;
    tape_ = tape;
    tape_.end_hash.reset();
    tape_settings_ = settings;
    tape_ticks_ = tape.tick_count();
    state_ = state;
    hash_ = hash;
}

void Playtest::name_level(std::string name, std::uint64_t mesh_fingerprint,
                          std::uint64_t surfaces_fingerprint) {
    tape_.level_name = std::move(name);
    tape_.level_fingerprint = mesh_fingerprint;
    tape_.surfaces_fingerprint = surfaces_fingerprint;
}

int Playtest::advance(const TickScene& scene, const MovementSettings& settings, const PlaytestInput& input,
                      double seconds) {
    if (input.look.allFinite()) {
        yaw = std::remainder(yaw - input.look.x(), 2.0 * std::numbers::pi);
        pitch = std::clamp(pitch + input.look.y(), -steepest_look, steepest_look);
    }
    pressed_ = pressed_ | input.buttons;
    if (!(seconds > 0.0)) return 0;

    unspent_s_ += seconds;
    int ticks = 0;
    for (; unspent_s_ >= tick_s; ++ticks) {
        if (ticks == max_ticks_per_frame) {
            unspent_s_ = 0.0;
            break;
        }
        unspent_s_ -= tick_s;

        if (tape_ticks_ == 0) {
            tape_.settings = setting_changes(basic_settings(), settings);
        } else if (!(tape_settings_ == settings)) {
            for (std::string& change : setting_changes(tape_settings_, settings))
                tape_.changes.push_back({tape_ticks_, std::move(change)});
        }
        tape_settings_ = settings;
        const PlayerInput tick_input{world_wish(input.stick, yaw), pressed_ | input.buttons};
        pressed_ = {};
        append_tick(tape_, tick_input);

        TraceRecorder recorder;
        if (tape_ticks_ == 0) state_ = scene.player_at(spawn_);
        const TickResult result = play_tick(scene.at(tape_ticks_, tick_s), settings, state_, tick_input,
                                            tick_s, run_start(scene, spawn_), &recorder);
        state_ = result.state;
        if (result.respawn == Respawn::fall) ++falls_;
        hash_ = state_hash(state_, hash_);
        ++tape_ticks_;
        trace_ = std::move(recorder.records);
        shown_from_ = result.respawn == Respawn::none ? shown_to_ : scene.to_level(state_);
        shown_to_ = scene.to_level(state_);
    }
    return ticks;
}

Vec3 Playtest::shown_position() const {
    const double fraction = std::clamp(unspent_s_ / tick_s, 0.0, 1.0);
    return shown_from_ + fraction * (shown_to_ - shown_from_);
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
    const double fraction = wall ? wall->t : 1.0;
    camera.eye = shoulder + fraction * back;
    camera.target = camera.eye + forward;
    camera.near_plane = std::min(camera.near_plane, 0.5 * radius);
    return camera;
}

}  // namespace slipface
