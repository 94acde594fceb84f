// The movement lab: a tape, its runs under one or more sets of settings, and the tick in view. It knows
// neither ImGui nor OpenGL.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/document.h"
#include "document/file_watch.h"
#include "slipface/sim/compare.h"
#include "slipface/sim/story.h"
#include "slipface/sim/summary.h"

namespace slipface {

// One run of the lab. The first is the lab's tape under the recorded settings, the second under the
// document's present ones; the user can pin more settings, and other tapes.
struct LabRun {
    enum class Kind { recorded, now, pinned, other } kind = Kind::recorded;
    std::string name;  // "As recorded", "Now", "keep energy off", "best.tape"
    MovementSettings settings;
    bool shown = true;
    TapeRun run;
    std::shared_ptr<const Tape> tape = nullptr;  // of another tape, else null
};

// A change of the tape's inputs that can be taken back.
struct InputEdit {
    std::shared_ptr<const Tape> before, after;
    std::size_t mark = 0;  // Document::history_mark() when it was made
};

enum class LabMotion { paused, forward, backward };

// The story of one tick, cached until the cursor moves or something changes.
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
    static constexpr std::size_t ticks_per_frame = 6000;  // limit for all runs together

    // The level with its moving parts, for a caller that steps a player under these settings: they decide
    // whether its sectors act. Valid until the document's geometry or types change.
    TickScene scene(const Document& document, const MovementSettings& settings) const;
    TickScene scene(const Document& document) const { return scene(document, document.level().movement); }
    TickScene scene(const Document& document, const LabRun& run) const {
        return scene(document, run.settings);
    }

    // --- the tape
    // Opens `tape` in `document`. The error says what does not fit the level; then nothing changes.
    Status open(const Document& document, Tape tape, std::string name);
    void close();
    bool has_tape() const { return tape_ != nullptr; }
    const Tape& tape() const { return *tape_; }
    const std::shared_ptr<const Tape>& shared_tape() const { return tape_; }  // another after each change
    const std::string& name() const { return name_; }
    bool unsaved = false;        // the tape was recorded or changed here and is in no file
    std::filesystem::path file;  // that the tape was read from or written to; empty: none
    FileWatch watch;             // of `file`
    std::size_t ticks() const { return runs_.empty() ? 0 : runs_.front().run.length(); }
    // The tape with everything needed to repeat it elsewhere, including the hash of its end.
    Tape sealed_tape() const;
    // Why the run may differ from the recorded one; empty: no known reason.
    const std::string& doubt() const { return doubt_; }
    // Whether the recorded run ended with the tape's hash. Nothing: the tape has no hash, or the run is not
    // complete.
    std::optional<bool> repeats() const;

    // --- changing the inputs
    // The same run with another tape (tape_edit.h), at the same tick: one step that undo_edit() takes back;
    // `joins`: one with the step before, as while the mouse is held. The error says what does not fit; then
    // nothing changes.
    Status edit(const Document& document, Tape tape, bool joins = false);
    // Whether the last change was one of the tape, and none of the document.
    bool can_undo_edit(const Document& document) const;
    bool can_redo_edit(const Document& document) const;
    void undo_edit(const Document& document);
    void redo_edit(const Document& document);
    bool edited() const { return edit_cursor_ > 0; }

    // --- once per frame
    // Restarts runs whose settings or level changed, continues incomplete ones, moves the cursor. True:
    // another frame is needed.
    bool frame(const Document& document, double seconds);

    // --- runs
    std::vector<LabRun>& runs() { return runs_; }
    const std::vector<LabRun>& runs() const { return runs_; }
    bool complete() const;
    void pin(const MovementSettings& settings);  // adds a run with these settings
    // Adds the run of another tape. The error says what does not fit the level, or that there are max_runs.
    Status add(const Document& document, Tape tape, std::string name);
    void unpin(std::size_t index);  // pinned ones and other tapes only
    // The selected run: the story is about it, and its plots are on top.
    std::size_t explained() const { return explained_; }
    void explain(std::size_t index);
    // Where run `index` differs from the recorded one. Nothing: no difference, or not known yet.
    const std::optional<Divergence>& divergence(std::size_t index) const { return divergences_[index]; }
    // Grows whenever a run's samples change; drawings made from them are valid until then.
    std::uint64_t revision() const { return revision_; }

    // --- the cursor
    std::size_t cursor() const { return cursor_; }
    void seek(std::size_t tick);  // clamped
    void step(int ticks);         // stops playing
    LabMotion motion = LabMotion::paused;
    double speed = 1.0;  // of playing: 1 is real time
    bool loop = false;
    // The nearest tick after (before) the cursor at which an event begins; the end (the start) if there is
    // none.
    void next_event();
    void previous_event();

    // The range of ticks in timeline and plots; it follows the cursor.
    double shown_first() const { return shown_first_; }
    double shown_last() const { return shown_last_; }
    void zoom(double factor, double about_tick);  // below 1: closer

    // --- the tick
    // Computed on demand and cached until the cursor, the run or the level changes.
    const TickTrace& trace(const Document& document) const;
    const std::vector<StoryLine>& story(const Document& document) const;
    const std::vector<SwitchEffect>& switches(const Document& document) const;
    static constexpr std::size_t switch_ticks = 60;
    bool show_folded = false;             // show also the lines that every tick has
    std::optional<std::size_t> lit_line;  // of the story: the line that was clicked and is drawn in the view

    // --- rates
    // The same route at the standard tick rates, compared with the tape's own; computed on demand.
    const std::vector<RateRow>& rates(const Document& document) const;
    bool show_rates = false;  // show the ribbons of the rates instead of those of the runs
    // --- presets
    // The tape under the level's settings and every shipped preset; computed on demand.
    const std::vector<SummaryRow>& presets(const Document& document) const;
    bool show_presets = false;
    // --- reach
    // Jump arcs and the stopping distance from the player at the cursor, or from the spawn point.
    bool show_reach = false;

  private:
    struct Opened {
        MovementSettings settings;
        Vec3 start;
    };
    Result<Opened> examine(const Document& document, const Tape& tape, const std::string& name) const;
    void take(const Document& document, std::shared_ptr<const Tape> tape, const Opened& opened);
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
    std::vector<InputEdit> edits_;
    std::size_t edit_cursor_ = 0;                                    // edits [0, edit_cursor_) are done
    mutable std::array<std::optional<LevelScene>, 2> level_scenes_;  // [whether sectors act]
    mutable const Document* scene_document_ = nullptr;
    mutable std::uint64_t scene_state_ = 0;
    mutable std::optional<ExplainedTick> explained_tick_;
    mutable std::vector<SummaryRow> presets_;
    mutable std::uint64_t presets_revision_ = 0;
    mutable std::vector<RateRow> rates_;
    mutable std::uint64_t rates_revision_ = 0;
};

}  // namespace slipface
