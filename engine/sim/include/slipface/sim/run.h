// A run: what a tape does under one set of settings, kept so that any tick can be looked at at once.
//
// Every tick leaves a sample; every `keyframe_ticks` ticks the whole state is kept, so the trace of any tick
// is worked out again from at most that many steps. Timeline, plots, ribbons and stories read runs and
// nothing else.
#pragma once

#include <memory>

#include "slipface/sim/simulate.h"

namespace slipface {

// The hacks whose work is counted: the switches and choices of settings_table(), in its order, at most 64.
std::span<const SettingInfo* const> hack_rows();
// The place of a hack in hack_rows(), by the name that trace records use, or nothing.
std::optional<std::size_t> hack_row(std::string_view name);
// One bit a hack: those that acted in these records, by a decision, by the rule of a response, or by a push.
std::uint64_t hacks_acted(const TraceRecord& record);

struct TickSample {
    Vec3 position = Vec3::Zero();  // after the tick, in the level's coordinates
    Vec3 velocity = Vec3::Zero();
    Vec3 ground_normal = Vec3::UnitY();
    FaceId ground_face = no_id;  // stood on, climbed, stuck to or slid along
    SurfaceId surface = default_surface;
    bool grounded = false, climbing = false, stuck = false;
    bool respawned = false;      // back at the start: no way leads here from the tick before
    std::uint8_t contacts = 0;   // met in the tick, walls and ground
    std::uint8_t walls = 0;      // of them those that turned a horizontal or whole move
    std::uint8_t push_outs = 0;  // times the player was moved out of geometry
    std::uint64_t acted = 0;     // hacks, as in hacks_acted()
};

// A tick as it happened, for telling its story.
struct TickTrace {
    std::size_t tick = 0;
    PlayerState before;
    TickResult after;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // before and after step(), in the level's coordinates
    PlayerInput input;
    MovementSettings settings;
    std::vector<TraceRecord> records;  // places in the level's coordinates
};

class TapeRun {
  public:
    static constexpr std::size_t keyframe_ticks = 64;
    static constexpr std::size_t max_ticks = 1'000'000;  // 100 bytes each; longer tapes are not kept

    // Follows the tape's changes on the way. `settings` contain the tape's own (apply_tape_settings).
    TapeRun(std::shared_ptr<const Tape> tape, const MovementSettings& settings, const Vec3& start);
    // One set of settings for the whole tape, whatever the tape changes on the way.
    static TapeRun under(std::shared_ptr<const Tape> tape, const MovementSettings& settings,
                         const Vec3& start);

    // The same settings, start and way of following changes for another tape; nothing worked out yet.
    TapeRun with_tape(std::shared_ptr<const Tape> tape) const;

    // Works out at most `ticks` further ticks; true when all are there. The scene must be the same at every
    // call.
    bool advance(const TickScene& scene, std::size_t ticks);
    bool complete() const { return samples_.size() == length_; }
    std::size_t length() const { return length_; }  // of the tape, at most max_ticks

    const Tape& tape() const { return *tape_; }
    const MovementSettings& settings() const { return first_settings_; }  // at the first tick
    const Vec3& start() const { return start_; }
    double dt() const { return tape_->dt; }

    std::span<const TickSample> samples() const { return samples_; }  // [tick], those worked out so far
    std::span<const SimulationEvent> events() const { return events_; }
    std::uint64_t hash() const { return hash_; }  // state_hash() after the last tick worked out
    // In how many of the ticks worked out so far the hack of that row acted.
    std::uint32_t acted_count(std::size_t row) const { return acted_counts_[row]; }

    // The state in which tick `tick` begins; tick = samples().size() is the end. The settings then.
    PlayerState state_before(const TickScene& scene, std::size_t tick) const;
    std::uint64_t hash_before(const TickScene& scene, std::size_t tick) const;
    MovementSettings settings_at(std::size_t tick) const;
    PlayerInput input_at(std::size_t tick) const;
    // Works tick `tick` out again, with all records. The same bits as when it was run.
    TickTrace trace(const TickScene& scene, std::size_t tick) const;

  private:
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
