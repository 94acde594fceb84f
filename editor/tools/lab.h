// The movement lab: a tape, what it does under one or more sets of settings, and the tick that is looked at.
// Knows neither ImGui nor OpenGL.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/document.h"
#include "slipface/sim/compare.h"
#include "slipface/sim/stops.h"
#include "slipface/sim/summary.h"

namespace slipface {

// One run of the lab's tape. The first is as recorded, the second under the document's settings as they are
// now; more are pinned by the user.
struct LabRun {
    enum class Kind { recorded, now, pinned } kind = Kind::recorded;
    std::string name;  // "As recorded", "Now", "keep energy off"
    MovementSettings settings;
    bool shown = true;
    TapeRun run;
};

enum class LabMotion { paused, forward, backward };

// The story of one tick, kept until the cursor moves or something changes.
struct ExplainedTick {
    std::uint64_t revision = 0;
    std::size_t run = 0, tick = 0;
    TickTrace trace;
    std::vector<StoryLine> lines;
    std::optional<std::vector<SwitchEffect>> switches;
};

class Lab {
  public:
    static constexpr std::size_t max_runs = 8;
    static constexpr std::size_t ticks_per_frame = 6000;  // worked out at most, all runs together

    // The level as its ticks see it, for whoever steps a player through it. Valid until the next call.
    TickScene scene(const Document& document) const;

    // --- the tape
    // Takes `tape` for `document`. The error names what is wrong with it for this level; then nothing
    // changes.
    Status open(const Document& document, Tape tape, std::string name);
    void close();
    bool has_tape() const { return tape_ != nullptr; }
    const Tape& tape() const { return *tape_; }
    const std::string& name() const { return name_; }
    bool unsaved = false;  // the tape was recorded here and is in no file
    std::size_t ticks() const { return runs_.empty() ? 0 : runs_.front().run.length(); }
    // The tape with all that is needed to repeat it elsewhere, the hash of its end included.
    Tape sealed_tape() const;
    // Why the tape may run otherwise than when it was recorded; empty if nothing speaks for that.
    const std::string& doubt() const { return doubt_; }
    // Whether the run as recorded ended with the tape's hash; nothing: the tape has none, or it is not there
    // yet.
    std::optional<bool> repeats() const;

    // --- once a frame
    // Starts runs anew whose settings or level changed, works on those that are not complete, moves the
    // cursor. True: another frame is needed.
    bool frame(const Document& document, double seconds);

    // --- runs
    std::vector<LabRun>& runs() { return runs_; }
    const std::vector<LabRun>& runs() const { return runs_; }
    bool complete() const;
    void pin(const MovementSettings& settings);  // keeps the settings as another run
    void unpin(std::size_t index);               // pinned ones only
    // The run whose story is told and whose plots lie on top.
    std::size_t explained() const { return explained_; }
    void explain(std::size_t index);
    // What run `index` does differently from the one as recorded; nothing: the same, or not known yet.
    const std::optional<Divergence>& divergence(std::size_t index) const { return divergences_[index]; }
    // Counts up whenever a run's samples change: what is drawn from them can be kept until then.
    std::uint64_t revision() const { return revision_; }

    // --- the cursor
    std::size_t cursor() const { return cursor_; }
    void seek(std::size_t tick);  // clamped
    void step(int ticks);         // stops playing
    LabMotion motion = LabMotion::paused;
    double speed = 1.0;  // of playing: 1 is real time
    bool loop = false;
    // The nearest tick after (before) the cursor at which something begins; the end (the start) if there is
    // none.
    void next_event();
    void previous_event();

    // The part of the tape that timeline and plots show, in ticks; it follows the cursor.
    double shown_first() const { return shown_first_; }
    double shown_last() const { return shown_last_; }
    void zoom(double factor, double about_tick);  // below 1: closer

    // --- the tick
    // Worked out when asked for and kept until the cursor, the run or the level changes.
    const TickTrace& trace(const Document& document) const;
    const std::vector<StoryLine>& story(const Document& document) const;
    const std::vector<SwitchEffect>& switches(const Document& document) const;
    static constexpr std::size_t switch_ticks = 60;
    // What stopped the player of the told run; empty until all of it is worked out.
    const std::vector<Stop>& stops(const Document& document) const;
    bool show_folded = false;             // lines of the story that every tick has
    std::optional<std::size_t> lit_line;  // of the story: clicked on, drawn in the view

    // --- rates
    // The same route at the standard rates, against the tape's own; worked out when asked for.
    const std::vector<RateRow>& rates(const Document& document) const;
    bool show_rates = false;  // ribbons of the rates in the view instead of the runs'
    // --- presets
    // The tape under the level's settings and under every preset that ships; worked out when asked for.
    const std::vector<SummaryRow>& presets(const Document& document) const;
    bool show_presets = false;
    // --- reach
    // Jump arcs and the way to a stop from where the player stands at the cursor, or at the spawn point.
    bool show_reach = false;

  private:
    void restart(std::size_t index, const Document& document);
    void compare(std::size_t index);
    void show_cursor();
    void update_explained(const Document& document) const;

    std::shared_ptr<const Tape> tape_;
    std::string name_, doubt_;
    Vec3 start_ = Vec3::Zero();
    std::vector<LabRun> runs_;
    std::vector<std::optional<Divergence>> divergences_;
    std::uint64_t level_state_ = 0;  // of the document's geometry and surfaces that the runs were made in
    std::uint64_t revision_ = 1;
    std::size_t explained_ = 0;
    std::size_t cursor_ = 0;
    double shown_first_ = 0.0, shown_last_ = 1.0;
    double unspent_s_ = 0.0;
    mutable std::optional<LevelScene> level_scene_;
    mutable const Document* scene_document_ = nullptr;
    mutable std::uint64_t scene_state_ = 0;
    mutable bool scene_sectors_ = false;
    mutable std::optional<ExplainedTick> explained_tick_;
    mutable std::vector<Stop> stops_;
    mutable std::uint64_t stops_revision_ = 0;
    mutable std::size_t stops_run_ = 0;
    mutable std::vector<SummaryRow> presets_;
    mutable std::uint64_t presets_revision_ = 0;
    mutable std::vector<RateRow> rates_;
    mutable std::uint64_t rates_revision_ = 0;
};

}  // namespace slipface
