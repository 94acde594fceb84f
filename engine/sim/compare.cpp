#include "slipface/sim/compare.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slipface {
namespace {

// Differences below these are of no use to a designer.
constexpr double small_m = 1e-3, small_m_s = 0.01;

bool same(const TickSample& a, const TickSample& b) {
    return a.position == b.position && a.velocity == b.velocity && a.grounded == b.grounded &&
           a.climbing == b.climbing && a.stuck == b.stuck && a.hanging == b.hanging &&
           a.crouched == b.crouched && a.ground_face == b.ground_face && a.respawned == b.respawned;
}

// What came of some ticks.
struct Played {
    double advanced_m = 0.0;  // in the direction asked for
    int grounded = 0;
    PlayerState end;
};

Played play(const TickScene& scene, const TapeRun& run, std::size_t tick, std::size_t ticks,
            const SettingInfo* changed, double value) {
    Played outcome;
    outcome.end = run.state_before(scene, tick);
    const RunStart begin = run_start(scene, run.start());
    for (std::size_t i = tick; i < std::min(tick + ticks, run.samples().size()); ++i) {
        MovementSettings settings = run.settings_at(i);
        if (changed) (void)set_setting(settings, *changed, value);
        const PlayerInput input = run.input_at(i);
        const TickResult result = play_tick(scene.at(i, run.dt()), settings, outcome.end, input, run.dt(),
                                            begin, nullptr, step_of(run.tape()));
        const Vec3 moved = scene.to_level(result.stepped) - scene.to_level(outcome.end);
        const Vec3 requested(input.wish.x(), 0.0, input.wish.y());
        const double length = requested.norm();
        if (length > 0.0) outcome.advanced_m += moved.dot(requested) / length;
        if (result.state.grounded) ++outcome.grounded;
        outcome.end = result.state;
    }
    return outcome;
}

std::string choice_text(const SettingInfo& info, double value) {
    MovementSettings settings;
    (void)set_setting(settings, info, value);
    return std::string(info.name) + "=" + setting_text(settings, info);
}

}  // namespace

std::optional<Divergence> compare_runs(const TapeRun& a, const TapeRun& b) {
    const std::size_t count = std::min(a.samples().size(), b.samples().size());
    std::optional<Divergence> divergence;
    for (std::size_t tick = 0; tick < count; ++tick) {
        const TickSample &of_a = a.samples()[tick], &of_b = b.samples()[tick];
        if (!divergence) {
            if (same(of_a, of_b)) continue;
            divergence = Divergence{.first = tick, .worst_tick = tick};
        }
        const double apart = (of_a.position - of_b.position).norm();
        if (apart > divergence->worst_m) {
            divergence->worst_m = apart;
            divergence->worst_tick = tick;
        }
        divergence->end_m = apart;
    }
    return divergence;
}

Tape tape_at_rate(const Tape& tape, int hz) {
    Tape other = tape;
    other.segments.clear();
    other.changes.clear();
    other.end_hash.reset();
    other.dt = 1.0 / hz;
    other.dt_text = "1/" + std::to_string(hz);
    const double ratio = other.dt / tape.dt;  // ticks of the tape in one of the other's
    constexpr double rounding = 1e-9;
    const auto source = [&](double tick) { return static_cast<std::size_t>(std::floor(tick + rounding)); };
    std::vector<PlayerInput> inputs;
    for (const TapeSegment& segment : tape.segments)
        inputs.insert(inputs.end(), static_cast<std::size_t>(std::max(segment.ticks, 0)), segment.input);
    const auto count = source(static_cast<double>(inputs.size()) / ratio);
    for (std::size_t tick = 0; tick < count; ++tick) {
        const double begin = static_cast<double>(tick) * ratio;
        const std::size_t first = std::min(source(begin), inputs.size() - 1);
        const double last_fraction = std::ceil(begin + ratio - rounding) - 1.0;
        const std::size_t last =
            std::clamp(static_cast<std::size_t>(std::max(last_fraction, 0.0)), first, inputs.size() - 1);
        PlayerInput input = inputs[first];
        for (std::size_t i = first + 1; i <= last; ++i)
            input.buttons = input.buttons | inputs[i].buttons;
        append_tick(other, input);
    }
    for (const TapeChange& change : tape.changes) {
        const double tick = std::ceil(static_cast<double>(change.tick) / ratio - rounding);
        if (tick < static_cast<double>(count))
            other.changes.push_back({static_cast<std::size_t>(tick), change.setting});
    }
    return other;
}

RateRow compare_rate(const TickScene& scene, const TapeRun& own, int hz) {
    auto tape = std::make_shared<const Tape>(tape_at_rate(own.tape(), hz));
    RateRow row{.hz = hz, .run = own.with_tape(std::move(tape))};
    row.run.advance(scene, TapeRun::max_ticks);
    const int own_hz = std::max(1, static_cast<int>(std::lround(1.0 / own.dt())));
    const int common = std::gcd(own_hz, hz);
    const auto own_stride = static_cast<std::size_t>(own_hz / common);
    const auto stride = static_cast<std::size_t>(hz / common);
    for (std::size_t i = 1;; ++i) {
        const std::size_t own_tick = i * own_stride, tick = i * stride;
        if (own_tick > own.samples().size() || tick > row.run.samples().size()) break;
        const double apart =
            (own.samples()[own_tick - 1].position - row.run.samples()[tick - 1].position).norm();
        if (apart > row.worst_m) {
            row.worst_m = apart;
            row.worst_time_s = static_cast<double>(own_tick) * own.dt();
        }
        row.end_m = apart;
    }
    return row;
}

std::vector<SwitchEffect> switch_effects(const TickScene& scene, const TapeRun& run, std::size_t tick,
                                         std::size_t ticks) {
    std::vector<SwitchEffect> effects;
    if (run.samples().empty()) return effects;
    tick = std::min(tick, run.samples().size() - 1);
    const MovementSettings settings = run.settings_at(tick);
    const Played as_is = play(scene, run, tick, ticks, nullptr, 0.0);
    for (const SettingInfo* info : hack_rows()) {
        const double now = get_setting(settings, *info);
        for (double value = info->minimum; value <= info->maximum; value += 1.0) {
            if (value == now) continue;
            const Played other = play(scene, run, tick, ticks, info, value);
            const double apart = (scene.to_level(other.end) - scene.to_level(as_is.end)).norm();
            const double faster = other.end.velocity.norm() - as_is.end.velocity.norm();
            if (apart < small_m && std::abs(faster) < small_m_s && other.grounded == as_is.grounded) continue;
            effects.push_back({.setting = choice_text(*info, value),
                               .info = info,
                               .further_m = other.advanced_m - as_is.advanced_m,
                               .end_speed = other.end.velocity.norm(),
                               .speed_gained = faster,
                               .grounded_gained = other.grounded - as_is.grounded,
                               .apart_m = apart});
        }
    }
    std::stable_sort(effects.begin(), effects.end(),
                     [](const SwitchEffect& a, const SwitchEffect& b) { return a.further_m > b.further_m; });
    return effects;
}

}  // namespace slipface
