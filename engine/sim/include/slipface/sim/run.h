// A run: the result of a tape under one set of settings, stored so that any tick can be shown at once.
//
// Every tick stores a sample and every `keyframe_ticks`-th tick the whole state. The trace of any tick is
// computed again from at most that many steps. Timeline, plots, ribbons and stories read only runs.
#pragma once

#include <memory>

#include "slipface/sim/simulate.h"

namespace slipface {

// The hacks whose actions are counted: the switches of settings_table(), and the choices that belong to no
// switch, in its order, at most 64.
std::span<const SettingInfo* const> hack_rows();
// The index of a hack in hack_rows(), by the name that trace records use, or nothing.
std::optional<std::size_t> hack_row(std::string_view name);
// One bit per row of hack_rows(): the hack that acted in this record, by a decision, by the rule of a
// response, or by a push.
std::uint64_t hacks_acted(const TraceRecord& record);

struct TickSample {
    Vec3 position = Vec3::Zero();  // after the tick, in the level's coordinates
    Vec3 velocity = Vec3::Zero();
    Vec3 ground_normal = Vec3::UnitY();
    FaceId ground_face = no_id;  // stood on, climbed, stuck to or slid along
    SurfaceId surface = default_surface;
    bool grounded = false, climbing = false, stuck = false, hanging = false;
    bool crouched = false;
    bool respawned = false;      // teleported to the start: do not connect to the previous sample
    std::uint8_t contacts = 0;   // hit in the tick, walls and ground
    std::uint8_t walls = 0;      // sweeps of a horizontal or whole move that hit something
    std::uint8_t push_outs = 0;  // times the player was moved out of geometry
    std::uint64_t acted = 0;     // hacks_acted() of all records of the tick

    Vec3 motion() const;  // motion_velocity()
};

// All that happened in a tick, for stories.
struct TickTrace {
    std::size_t tick = 0;
    double dt = 0.0;  // s
    PlayerState before;
    TickResult after;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // before and after step(), in the level's coordinates
    PlayerInput input;
    MovementSettings settings;
    std::vector<TraceRecord> records;  // positions in the level's coordinates
};

class TapeRun {
  public:
    static constexpr std::size_t keyframe_ticks = 64;
    static constexpr std::size_t max_ticks = 1'000'000;  // about 100 bytes each; later ticks are not run

    // Applies the tape's changes of settings at their ticks. `settings` already include the tape's own
    // (apply_tape_settings()). `start` is in the level's coordinates.
    TapeRun(std::shared_ptr<const Tape> tape, const MovementSettings& settings, const Vec3& start);
    // One set of settings for the whole tape: the tape's changes are ignored.
    static TapeRun under(std::shared_ptr<const Tape> tape, const MovementSettings& settings,
                         const Vec3& start);

    // A run of another tape with the same settings, start and treatment of changes; no tick is simulated yet.
    TapeRun with_tape(std::shared_ptr<const Tape> tape) const;

    // Simulates at most `ticks` further ticks; true when the run is complete. The scene must be the same at
    // every call.
    bool advance(const TickScene& scene, std::size_t ticks);
    bool complete() const { return samples_.size() == length_; }
    std::size_t length() const { return length_; }  // of the tape, at most max_ticks

    const Tape& tape() const { return *tape_; }
    const MovementSettings& settings() const { return first_settings_; }  // at the first tick
    const Vec3& start() const { return start_; }
    double dt() const { return tape_->dt; }

    std::span<const TickSample> samples() const { return samples_; }  // [tick], those simulated so far
    std::span<const SimulationEvent> events() const { return events_; }
    std::uint64_t hash() const { return hash_; }  // state_hash() after the last simulated tick
    // The number of ticks so far in which the hack of that row of hack_rows() acted.
    std::uint32_t acted_count(std::size_t row) const { return acted_counts_[row]; }

    // The state, the hash, the settings and the input at the start of tick `tick`. From samples().size() on,
    // state and hash are those at the end of the run.
    PlayerState state_before(const TickScene& scene, std::size_t tick) const;
    std::uint64_t hash_before(const TickScene& scene, std::size_t tick) const;
    MovementSettings settings_at(std::size_t tick) const;
    PlayerInput input_at(std::size_t tick) const;
    // Simulates tick `tick` (at most the last one) again, with all records. The same bits as in the run.
    // Empty if no tick is simulated yet.
    TickTrace trace(const TickScene& scene, std::size_t tick) const;
    // The same of the ticks [first, last], each begun where the one before ended.
    std::vector<TickTrace> traces(const TickScene& scene, std::size_t first, std::size_t last) const;

  private:
    TickTrace trace_from(const TickScene& scene, std::size_t tick, const PlayerState& before) const;
    void apply_changes(MovementSettings& settings, std::size_t from, std::size_t to) const;

    std::shared_ptr<const Tape> tape_;
    MovementSettings first_settings_, settings_;
    Vec3 start_;
    bool follows_changes_ = true;
    std::size_t length_ = 0;
    std::vector<std::size_t> segment_ends_;  // [segment] tick after its last
    std::size_t segment_ = 0;
    PlayerState state_;
    std::uint64_t hash_ = 0;
    struct Keyframe {
        PlayerState state;
        std::uint64_t hash;
    };
    Keyframe replay(const TickScene& scene, std::size_t tick) const;
    std::vector<Keyframe> keyframes_;  // [i] before tick i * keyframe_ticks
    std::vector<TickSample> samples_;
    std::vector<SimulationEvent> events_;
    SurfaceId event_surface_ = default_surface;
    std::array<std::uint32_t, 64> acted_counts_{};
};

}  // namespace slipface
