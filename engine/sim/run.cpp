#include "slipface/sim/run.h"

#include <algorithm>
#include <bit>

namespace slipface {
namespace {

std::vector<const SettingInfo*> find_hack_rows() {
    std::vector<const SettingInfo*> rows;
    for (const SettingInfo& info : settings_table()) {
        // A choice that belongs to a switch is how that hack acts, and no hack of its own.
        const bool is_hack = is_switch(info) || (is_choice(info) && *info.switch_name == '\0');
        if (is_hack && rows.size() < 64) rows.push_back(&info);
    }
    return rows;
}

std::uint64_t bit_of(std::string_view name) {
    const std::optional<std::size_t> row = hack_row(name);
    return row ? std::uint64_t{1} << *row : 0;
}

// What a sample needs of the records of its tick.
class SampleSink final : public TraceSink {
  public:
    explicit SampleSink(TickSample& sample) : sample_(sample) {}
    void add(const TraceRecord& record) override {
        sample_.acted |= hacks_acted(record);
        if (const auto* sweep = std::get_if<SweepRecord>(&record)) {
            const bool aside = sweep->pass == Pass::horizontal || sweep->pass == Pass::slide;
            if (aside && sweep->contact) count(sample_.walls);
        } else if (std::holds_alternative<PushOutRecord>(record)) {
            count(sample_.push_outs);
        }
    }

  private:
    static void count(std::uint8_t& number) {
        if (number < 255) ++number;
    }
    TickSample& sample_;
};

TickSample sample_of(const TickScene& scene, const TickResult& result) {
    const PlayerState& state = result.state;
    TickSample sample;
    sample.position = scene.to_level(state);
    sample.velocity = state.velocity;
    sample.ground_normal = state.ground_normal;
    sample.ground_face = state.ground_face;
    sample.surface = state.ground_surface;
    sample.grounded = state.grounded;
    sample.climbing = state.climbing;
    sample.stuck = state.stuck;
    sample.hanging = state.hanging;
    sample.crouched = state.crouched;
    sample.respawned = result.respawn != Respawn::none;
    sample.contacts = static_cast<std::uint8_t>(std::clamp(result.contacts, 0, 255));
    return sample;
}

// Every place that a record names.
void move_positions(TraceRecord& record, const Vec3& by) {
    if (auto* sweep = std::get_if<SweepRecord>(&record)) {
        sweep->from += by;
        sweep->reached += by;
        if (sweep->contact) sweep->contact->point += by;
    } else if (auto* push = std::get_if<PushOutRecord>(&record)) {
        push->from += by;
        push->to += by;
    }
}

}  // namespace

std::span<const SettingInfo* const> hack_rows() {
    static const std::vector<const SettingInfo*> rows = find_hack_rows();
    return rows;
}

std::optional<std::size_t> hack_row(std::string_view name) {
    const auto rows = hack_rows();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (name == rows[i]->name) return i;
    return std::nullopt;
}

std::uint64_t hacks_acted(const TraceRecord& record) {
    if (const auto* decision = std::get_if<DecisionRecord>(&record)) {
        static const std::vector<std::uint64_t> bits = [] {
            std::vector<std::uint64_t> of_kind;
            for (const DecisionInfo& info : decision_table())
                of_kind.push_back(info.outcome == Outcome::acted ? bit_of(info.hack) : 0);
            return of_kind;
        }();
        return bits[static_cast<std::size_t>(decision->kind)];
    }
    if (const auto* response = std::get_if<ResponseRecord>(&record)) {
        switch (response->rule) {
            case Rule::straight_ahead: {
                static const std::uint64_t bit = bit_of("straight_ahead");
                return bit;
            }
            case Rule::bounce: {
                static const std::uint64_t bit = bit_of("bounce");
                return bit;
            }
            case Rule::keep_energy: {
                static const std::uint64_t bit = bit_of("keep_energy");
                return bit;
            }
            default: return 0;
        }
    }
    if (std::holds_alternative<PushOutRecord>(record)) {
        static const std::uint64_t bit = bit_of("push_out");
        return bit;
    }
    return 0;
}

Vec3 TickSample::motion() const {
    PlayerState state;
    state.velocity = velocity;
    state.grounded = grounded;
    state.ground_normal = ground_normal;
    return motion_velocity(state);
}

TapeRun::TapeRun(std::shared_ptr<const Tape> tape, const MovementSettings& settings, const Vec3& start)
    : tape_(std::move(tape)),
      first_settings_(settings),
      settings_(settings),
      start_(start),
      length_(std::min(tape_->tick_count(), max_ticks)) {
    std::size_t end = 0;
    for (const TapeSegment& segment : tape_->segments)
        segment_ends_.push_back(end += static_cast<std::size_t>(std::max(segment.ticks, 0)));
    samples_.reserve(length_);
}

TapeRun TapeRun::under(std::shared_ptr<const Tape> tape, const MovementSettings& settings,
                       const Vec3& start) {
    TapeRun run(std::move(tape), settings, start);
    run.follows_changes_ = false;
    return run;
}

TapeRun TapeRun::with_tape(std::shared_ptr<const Tape> tape) const {
    TapeRun run(std::move(tape), first_settings_, start_);
    run.follows_changes_ = follows_changes_;
    return run;
}

void TapeRun::apply_changes(MovementSettings& settings, std::size_t from, std::size_t to) const {
    if (!follows_changes_) return;
    const auto& changes = tape_->changes;
    auto change = std::lower_bound(changes.begin(), changes.end(), from,
                                   [](const TapeChange& c, std::size_t tick) { return c.tick < tick; });
    for (; change != changes.end() && change->tick < to; ++change)
        (void)set_setting(settings, change->setting);
}

bool TapeRun::advance(const TickScene& scene, std::size_t ticks) {
    EventLog log(scene.surfaces(), events_, event_surface_);
    const RunStart begin = run_start(scene, start_);
    if (samples_.empty()) state_ = begin.player;
    for (std::size_t end = std::min(length_, samples_.size() + ticks); samples_.size() < end;) {
        const std::size_t tick = samples_.size();
        if (tick % keyframe_ticks == 0) keyframes_.push_back({state_, hash_});
        apply_changes(settings_, tick, tick + 1);
        while (segment_ends_[segment_] <= tick)
            ++segment_;
        const PlayerInput& input = tape_->segments[segment_].input;
        TickSample counted;
        SampleSink sink(counted);
        const PlayerState before = state_;
        const TickResult result = play_tick(scene.at(tick, tape_->dt), settings_, before, input, tape_->dt,
                                            begin, &sink, step_of(*tape_));
        state_ = result.state;
        hash_ = state_hash(state_, hash_);
        TickSample sample = sample_of(scene, result);
        sample.walls = counted.walls;
        sample.push_outs = counted.push_outs;
        sample.acted = counted.acted;
        for (std::uint64_t bits = sample.acted; bits != 0; bits &= bits - 1)
            ++acted_counts_[static_cast<std::size_t>(std::countr_zero(bits))];
        log.add(tick, before, input, result);
        const bool fresh_wall = sample.walls > 0 && (tick == 0 || samples_.back().walls == 0);
        if (fresh_wall) events_.push_back({tick, "contact", ""});
        if (sample.push_outs > 0) events_.push_back({tick, "push-out", ""});
        samples_.push_back(sample);
    }
    event_surface_ = log.surface();
    return complete();
}

MovementSettings TapeRun::settings_at(std::size_t tick) const {
    MovementSettings settings = first_settings_;
    apply_changes(settings, 0, tick + 1);
    return settings;
}

PlayerInput TapeRun::input_at(std::size_t tick) const {
    const auto segment = std::upper_bound(segment_ends_.begin(), segment_ends_.end(), tick);
    if (segment == segment_ends_.end()) return {};
    return tape_->segments[static_cast<std::size_t>(segment - segment_ends_.begin())].input;
}

TapeRun::Keyframe TapeRun::replay(const TickScene& scene, std::size_t tick) const {
    if (samples_.empty()) return {scene.player_at(start_), hash_};
    if (tick >= samples_.size()) return {state_, hash_};
    const std::size_t first = tick / keyframe_ticks * keyframe_ticks;
    const RunStart begin = run_start(scene, start_);
    Keyframe at = keyframes_[tick / keyframe_ticks];
    MovementSettings settings = settings_at(first);
    for (std::size_t i = first; i < tick; ++i) {
        apply_changes(settings, i, i + 1);
        at.state = play_tick(scene.at(i, tape_->dt), settings, at.state, input_at(i), tape_->dt, begin,
                             nullptr, step_of(*tape_))
                       .state;
        at.hash = state_hash(at.state, at.hash);
    }
    return at;
}

PlayerState TapeRun::state_before(const TickScene& scene, std::size_t tick) const {
    return replay(scene, tick).state;
}

std::uint64_t TapeRun::hash_before(const TickScene& scene, std::size_t tick) const {
    return replay(scene, tick).hash;
}

TickTrace TapeRun::trace_from(const TickScene& scene, std::size_t tick, const PlayerState& before) const {
    TickTrace trace;
    trace.tick = tick;
    trace.dt = tape_->dt;
    trace.before = before;
    trace.input = input_at(tick);
    trace.settings = settings_at(tick);
    TraceRecorder recorder;
    trace.after = play_tick(scene.at(tick, tape_->dt), trace.settings, trace.before, trace.input, tape_->dt,
                            run_start(scene, start_), &recorder, step_of(*tape_));
    // Stories ask about the body that the tick moved.
    trace.settings = settings_of_body(trace.settings, trace.after.stepped);
    trace.from = scene.to_level(trace.before);
    trace.to = scene.to_level(trace.after.stepped);
    trace.records = std::move(recorder.records);
    if (!scene.offset().isZero(0.0))
        for (TraceRecord& record : trace.records)
            move_positions(record, -scene.offset());
    return trace;
}

TickTrace TapeRun::trace(const TickScene& scene, std::size_t tick) const {
    if (samples_.empty()) return {};
    const std::size_t at = std::min(tick, samples_.size() - 1);
    return trace_from(scene, at, state_before(scene, at));
}

std::vector<TickTrace> TapeRun::traces(const TickScene& scene, std::size_t first, std::size_t last) const {
    std::vector<TickTrace> traces;
    if (samples_.empty() || first >= samples_.size()) return traces;
    PlayerState state = state_before(scene, first);
    for (std::size_t tick = first; tick <= std::min(last, samples_.size() - 1); ++tick) {
        traces.push_back(trace_from(scene, tick, state));
        state = traces.back().after.state;
    }
    return traces;
}

}  // namespace slipface
