#include "tools/lab/lab.h"

#include <algorithm>
#include <cmath>

#include "slipface/level/find_start.h"
#include "slipface/level/preset.h"

namespace slipface {
namespace {

// Changes whenever the same tape could give another run.
std::uint64_t state_of(const Document& document) {
    return (document.face_revision() * 0x9e3779b97f4a7c15ULL) ^ document.level().mesh.fingerprint();
}

// Why a tape need not repeat in this level.
std::string doubt_of(const Tape& tape, std::uint64_t geometry, const TickScene& scene) {
    if (tape.level_fingerprint && *tape.level_fingerprint != geometry)
        return "The geometry has changed since the recording";
    if (tape.surfaces_fingerprint && *tape.surfaces_fingerprint != scene_fingerprint(scene.at(0, 0.0)))
        return "Recorded with other surface types";
    return {};
}

// The difference of two sets of settings, short enough for a list.
std::string difference_name(const MovementSettings& from, const MovementSettings& to) {
    std::string name;
    for (const SettingInfo& info : settings_table()) {
        if (get_setting(from, info) == get_setting(to, info)) continue;
        if (!name.empty()) return name + ", \u2026";
        name = std::string(info.label) + " " + setting_text(to, info);
    }
    return name.empty() ? "Same settings" : name;
}

}  // namespace

TickScene Lab::scene(const Document& document, const MovementSettings& settings) const {
    if (scene_document_ != &document || scene_state_ != state_of(document)) {
        level_scenes_ = {};
        scene_document_ = &document;
        scene_state_ = state_of(document);
    }
    std::optional<LevelScene>& known = level_scenes_[settings.sectors ? 1 : 0];
    if (!known) {
        Result<LevelScene> built = LevelScene::borrow(document.level(), document.collision(), settings);
        if (built) known.emplace(std::move(*built));
    }
    return known ? TickScene(*known) : TickScene(document.scene());
}

Result<Lab::Opened> Lab::examine(const Document& document, const Tape& tape, const std::string& name) const {
    if (tape.tick_count() == 0) return Error{name, "found no ticks, expected at least one"};
    if (tape.tick_count() > TapeRun::max_ticks) {
        return Error{name, "found " + std::to_string(tape.tick_count()) + " ticks, expected at most " +
                               std::to_string(TapeRun::max_ticks)};
    }
    Opened opened{document.level().movement, document.level().spawn};
    if (Status status = apply_tape_settings(opened.settings, tape, name); !status) return status.error();
    if (tape.start) {
        opened.start = *tape.start;
    } else {
        const TickScene ticks = scene(document, opened.settings);
        const Result<Start> start =
            find_start(document.level(), ticks.at(0, 0.0), ticks.offset(), opened.settings);
        if (start) opened.start = start->position;
    }
    return opened;
}

// Becomes the lab's tape; its runs begin anew.
void Lab::take(const Document& document, std::shared_ptr<const Tape> tape, const Opened& opened) {
    start_ = opened.start;
    doubt_ = doubt_of(*tape, document.level().mesh.fingerprint(), scene(document, opened.settings));
    const bool whole = shown_first_ == 0.0 && shown_last_ >= static_cast<double>(ticks());
    tape_ = std::move(tape);
    runs_.front().settings = opened.settings;
    for (std::size_t i = 0; i < runs_.size(); ++i)
        if (runs_[i].kind != LabRun::Kind::other) restart(i, document);
    if (whole) shown_last_ = static_cast<double>(ticks());
    zoom(1.0, shown_first_);
    seek(cursor_);
}

Status Lab::open(const Document& document, Tape tape, std::string name) {
    const Result<Opened> opened = examine(document, tape, name);
    if (!opened) return opened.error();
    close();
    name_ = std::move(name);
    tape_ = std::make_shared<const Tape>(std::move(tape));
    level_state_ = state_of(document);
    const MovementSettings& now = document.level().movement;
    runs_.push_back({LabRun::Kind::recorded, "As recorded", opened->settings, true,
                     TapeRun(tape_, opened->settings, opened->start)});
    runs_.push_back({LabRun::Kind::now, "Now", now, true, TapeRun::under(tape_, now, opened->start)});
    divergences_.resize(runs_.size());
    shown_last_ = static_cast<double>(ticks());
    take(document, tape_, *opened);
    return {};
}

Status Lab::edit(const Document& document, Tape tape, bool joins) {
    constexpr std::size_t max_edits = 200;
    if (!has_tape()) return {};
    tape.end_hash.reset();
    if (!tape.start) tape.start = start_;
    const Result<Opened> opened = examine(document, tape, name_);
    if (!opened) return opened.error();
    const std::shared_ptr<const Tape> before = tape_, after = std::make_shared<const Tape>(std::move(tape));
    edits_.resize(edit_cursor_);
    if (joins && edit_cursor_ > 0)
        edits_.back().after = after;
    else
        edits_.push_back({before, after, document.history_mark()});
    if (edits_.size() > max_edits) edits_.erase(edits_.begin());
    edit_cursor_ = edits_.size();
    unsaved = true;
    motion = LabMotion::paused;
    take(document, after, *opened);
    return {};
}

bool Lab::can_undo_edit(const Document& document) const {
    return edit_cursor_ > 0 && edits_[edit_cursor_ - 1].mark == document.history_mark();
}

bool Lab::can_redo_edit(const Document& document) const {
    return edit_cursor_ < edits_.size() && edits_[edit_cursor_].mark == document.history_mark();
}

void Lab::undo_edit(const Document& document) {
    if (!can_undo_edit(document)) return;
    const std::shared_ptr<const Tape> tape = edits_[--edit_cursor_].before;
    if (const Result<Opened> opened = examine(document, *tape, name_)) take(document, tape, *opened);
}

void Lab::redo_edit(const Document& document) {
    if (!can_redo_edit(document)) return;
    const std::shared_ptr<const Tape> tape = edits_[edit_cursor_++].after;
    if (const Result<Opened> opened = examine(document, *tape, name_)) take(document, tape, *opened);
}

void Lab::close() {
    const std::uint64_t revision = revision_;
    *this = Lab();
    revision_ = revision + 1;
}

Tape Lab::sealed_tape() const {
    Tape tape = *tape_;
    tape.from_basic = true;
    tape.settings = setting_changes(basic_settings(), runs_.front().settings);
    tape.start = start_;
    if (runs_.front().run.complete()) tape.end_hash = runs_.front().run.hash();
    return tape;
}

std::optional<bool> Lab::repeats() const {
    if (!has_tape() || !tape_->end_hash || !runs_.front().run.complete()) return std::nullopt;
    return *tape_->end_hash == runs_.front().run.hash();
}

bool Lab::complete() const {
    return std::all_of(runs_.begin(), runs_.end(), [](const LabRun& run) { return run.run.complete(); });
}

void Lab::restart(std::size_t index, const Document& document) {
    LabRun& run = runs_[index];
    if (run.kind == LabRun::Kind::now) run.settings = document.level().movement;
    if (run.kind == LabRun::Kind::other)
        run.run = TapeRun(run.tape, run.settings, run.run.start());
    else
        run.run = run.kind == LabRun::Kind::recorded ? TapeRun(tape_, run.settings, start_)
                                                     : TapeRun::under(tape_, run.settings, start_);
    divergences_[index].reset();
    ++revision_;
}

void Lab::compare(std::size_t index) {
    divergences_[index] = index == 0 ? std::nullopt : compare_runs(runs_[0].run, runs_[index].run);
}

bool Lab::frame(const Document& document, double seconds) {
    if (!has_tape()) return false;
    const bool other_level = level_state_ != state_of(document);
    level_state_ = state_of(document);
    if (other_level)
        doubt_ = doubt_of(*tape_, document.level().mesh.fingerprint(), scene(document, runs_.front()));
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        const bool other_settings =
            runs_[i].kind == LabRun::Kind::now && !(runs_[i].settings == document.level().movement);
        if (other_level || other_settings) restart(i, document);
    }

    std::size_t budget = ticks_per_frame;
    for (std::size_t i = 0; i < runs_.size() && budget > 0; ++i) {
        TapeRun& run = runs_[i].run;
        if (run.complete()) continue;
        const std::size_t before = run.samples().size();
        run.advance(scene(document, runs_[i]), budget);
        budget -= run.samples().size() - before;
        ++revision_;
        if (run.complete() && runs_[0].run.complete()) compare(i);
    }

    if (motion != LabMotion::paused && seconds > 0.0) {
        unspent_s_ += seconds * speed;
        const auto due = static_cast<std::size_t>(unspent_s_ / tape_->dt);
        unspent_s_ -= static_cast<double>(due) * tape_->dt;
        const std::size_t last = ticks() - 1;
        const bool forward = motion == LabMotion::forward;
        const std::size_t left = forward ? last - cursor_ : cursor_;
        if (due <= left) {
            cursor_ = forward ? cursor_ + due : cursor_ - due;
        } else if (loop) {
            cursor_ = forward ? (due - left - 1) % ticks() : last - (due - left - 1) % ticks();
        } else {
            cursor_ = forward ? last : 0;
            motion = LabMotion::paused;
        }
        if (due > 0) lit_line.reset();
        show_cursor();
    }
    return motion != LabMotion::paused || !complete();
}

void Lab::pin(const MovementSettings& settings) {
    if (!has_tape() || runs_.size() >= max_runs) return;
    runs_.push_back({LabRun::Kind::pinned, difference_name(runs_.front().settings, settings), settings, true,
                     TapeRun::under(tape_, settings, start_)});
    divergences_.resize(runs_.size());
    ++revision_;
}

Status Lab::add(const Document& document, Tape tape, std::string name) {
    if (!has_tape()) return open(document, std::move(tape), std::move(name));
    if (runs_.size() >= max_runs)
        return Error{name, "found " + std::to_string(max_runs) + " runs, expected fewer: remove one first"};
    const Result<Opened> opened = examine(document, tape, name);
    if (!opened) return opened.error();
    const auto other = std::make_shared<const Tape>(std::move(tape));
    runs_.push_back({LabRun::Kind::other, std::move(name), opened->settings, true,
                     TapeRun(other, opened->settings, opened->start), other});
    divergences_.resize(runs_.size());
    ++revision_;
    return {};
}

void Lab::unpin(std::size_t index) {
    if (index >= runs_.size() || runs_[index].kind == LabRun::Kind::recorded ||
        runs_[index].kind == LabRun::Kind::now)
        return;
    runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(index));
    divergences_.erase(divergences_.begin() + static_cast<std::ptrdiff_t>(index));
    if (explained_ >= index && explained_ > 0) --explained_;
    ++revision_;
}

void Lab::explain(std::size_t index) {
    if (index >= runs_.size() || index == explained_) return;
    explained_ = index;
    lit_line.reset();
}

void Lab::seek(std::size_t tick) {
    const std::size_t wanted = ticks() == 0 ? 0 : std::min(tick, ticks() - 1);
    if (wanted != cursor_) lit_line.reset();
    cursor_ = wanted;
    show_cursor();
}

void Lab::show_cursor() {
    const double at = static_cast<double>(cursor_);
    const double length = shown_last_ - shown_first_;
    if (at < shown_first_) shown_first_ = at;
    if (at + 1.0 > shown_first_ + length) shown_first_ = at + 1.0 - length;
    shown_last_ = shown_first_ + length;
}

void Lab::zoom(double factor, double about_tick) {
    const double all = static_cast<double>(std::max<std::size_t>(ticks(), 1));
    const double length = shown_last_ - shown_first_;
    const double wanted = std::clamp(length * factor, std::min(8.0, all), all);
    const double fraction = (about_tick - shown_first_) / length;
    shown_first_ = std::clamp(about_tick - fraction * wanted, 0.0, all - wanted);
    shown_last_ = shown_first_ + wanted;
}

void Lab::step(int count) {
    motion = LabMotion::paused;
    const auto distance = static_cast<std::size_t>(std::abs(count));
    seek(count > 0 ? cursor_ + distance : cursor_ - std::min(cursor_, distance));
}

void Lab::next_event() {
    if (!has_tape()) return;
    motion = LabMotion::paused;
    std::size_t found = ticks() - 1;
    for (const SimulationEvent& event : runs_[explained_].run.events())
        if (event.tick > cursor_) found = std::min(found, event.tick);
    seek(found);
}

void Lab::previous_event() {
    if (!has_tape()) return;
    motion = LabMotion::paused;
    std::size_t found = 0;
    for (const SimulationEvent& event : runs_[explained_].run.events())
        if (event.tick < cursor_) found = std::max(found, event.tick);
    seek(found);
}

void Lab::update_explained(const Document& document) const {
    const bool fresh = explained_tick_ && explained_tick_->revision == revision_ &&
                       explained_tick_->run == explained_ && explained_tick_->tick == cursor_;
    if (fresh) return;
    explained_tick_.emplace();
    explained_tick_->revision = revision_;
    explained_tick_->run = explained_;
    explained_tick_->tick = cursor_;
    if (!has_tape()) return;
    explained_tick_->trace = runs_[explained_].run.trace(scene(document, runs_[explained_]), cursor_);
    explained_tick_->lines = describe(explained_tick_->trace, document.level());
}

const TickTrace& Lab::trace(const Document& document) const {
    update_explained(document);
    return explained_tick_->trace;
}

const std::vector<StoryLine>& Lab::story(const Document& document) const {
    update_explained(document);
    return explained_tick_->lines;
}

const std::vector<SwitchEffect>& Lab::switches(const Document& document) const {
    update_explained(document);
    if (!explained_tick_->switches) {
        explained_tick_->switches = has_tape() ? switch_effects(scene(document, runs_[explained_]),
                                                                runs_[explained_].run, cursor_, switch_ticks)
                                               : std::vector<SwitchEffect>{};
    }
    return *explained_tick_->switches;
}

const std::vector<SummaryRow>& Lab::presets(const Document& document) const {
    if (!has_tape() || presets_revision_ == revision_) return presets_;
    presets_revision_ = revision_;
    std::vector<NamedSettings> sets{{"This level", document.level().movement}};
    for (const ShippedPreset& shipped : shipped_presets())
        sets.push_back({shipped.preset.name, shipped.preset.settings});
    presets_ = compare_settings(document.level(), tape_, start_, sets);
    return presets_;
}

const std::vector<RateRow>& Lab::rates(const Document& document) const {
    const bool fresh = rates_revision_ == revision_;
    if (fresh || !has_tape() || !runs_[explained_].run.complete()) return rates_;
    rates_revision_ = revision_;
    rates_.clear();
    for (const int hz : standard_rates)
        rates_.push_back(compare_rate(scene(document, runs_[explained_]), runs_[explained_].run, hz));
    return rates_;
}

}  // namespace slipface
