#include "slipface/sim/story.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "story_words.h"

namespace slipface {
namespace {

Words words_of(StoryLine& line) {
    return {line.text, line.numbers};
}

std::string stance(const PlayerState& state, const StoryNames& names) {
    const std::string on = face_text(names, state.ground_face, state.ground_surface);
    if (state.climbing) return "climbing " + on;
    if (state.stuck) return "stuck to " + on;
    if (state.hanging) return "hanging from " + on;
    if (state.grounded && state.crouched) return "crouched on " + on;
    if (state.grounded) return "standing on " + on;
    return "in the air";
}

const DecisionRecord* first_of(const TickTrace& trace, std::initializer_list<Decision> kinds) {
    for (const TraceRecord& record : trace.records)
        if (const auto* decision = std::get_if<DecisionRecord>(&record))
            if (std::find(kinds.begin(), kinds.end(), decision->kind) != kinds.end()) return decision;
    return nullptr;
}

std::string object_or(const StoryNames& names, FaceId face, const char* otherwise) {
    const std::string object = object_text(names, face);
    return object.empty() ? otherwise : object;
}

void say_speed(Words& words, const PlayerState& state) {
    const double speed = motion_velocity(state).norm();
    state.grounded&& speed < 5e-4 ? words.say(", at rest") : words.say(" at ").speed(speed);
}

StoryLine begin_line(const TickTrace& trace, const StoryNames& names) {
    StoryLine line;
    line.title = "Begins";
    line.position = trace.from;
    line.face = trace.before.ground_face;
    Words words = words_of(line);
    words.say(stance(trace.before, names));
    say_speed(words, trace.before);
    if (const auto* carried = first_of(trace, {Decision::platform_carried, Decision::surface_carried}))
        words.say(", carried by ")
            .say(object_or(names, carried->face, "the ground"))
            .say(" at ")
            .speed(carried->value);
    const Vec2& wish = trace.input.wish;
    if (!wish.isZero(0.0)) {
        // A compass is easier to read than two components: 0° is -Z, 90° is +X.
        double heading = std::atan2(wish.x(), -wish.y()) * 180.0 / std::numbers::pi;
        if (heading < 0.0) heading += 360.0;
        words.say(", stick ").percent(wish.norm()).say(" towards ").degrees(heading);
    }
    for (const ButtonInfo& info : button_table()) {
        if (!trace.input.buttons.has(info.button)) continue;
        const bool pressed = (info.button == Button::jump && !trace.before.jump_held) ||
                             (info.button == Button::dash && trace.settings.dash && !trace.before.dash_held);
        words.say(", ").say(info.name).say(pressed ? " pressed" : " held");
    }
    return line;
}

StoryLine end_line(const TickTrace& trace, const StoryNames& names) {
    const PlayerState& end = trace.after.stepped;
    StoryLine line;
    line.title = "Ends";
    line.position = trace.to;
    line.face = end.ground_face;
    line.normal = end.ground_face == no_id ? Vec3(Vec3::Zero()) : end.ground_normal;
    Words words = words_of(line);
    words.say(stance(end, names));
    say_speed(words, end);
    words.say(", moved ").length((trace.to - trace.from).norm());
    if (trace.after.respawn == Respawn::hazard) words.say("; touched a hazard, back to the start");
    if (trace.after.respawn == Respawn::crushed) {
        const auto* crushed = first_of(trace, {Decision::platform_crushed});
        words.say("; crushed between ")
            .say(object_or(names, crushed != nullptr ? crushed->face : no_id, "a platform"))
            .say(" and ")
            .say(object_or(names, trace.before.ground_face, "the level"))
            .say(", back to the start");
    }
    if (trace.after.respawn == Respawn::fall) words.say("; fell out of the level, back to the start");
    if (trace.after.respawn != Respawn::none) line.tone = StoryTone::trouble;
    return line;
}

const char* sweep_title(const SweepRecord& sweep) {
    switch (sweep.pass) {
        case Pass::slide: return "whole move";
        case Pass::horizontal: return "across";
        case Pass::vertical: return sweep.move.y() > 0.0 ? "up" : "down";
        case Pass::probe: return "check";
        case Pass::step: return sweep.move.y() > 0.0 ? "lift" : "drop";
        case Pass::snap: return "snap down";
    }
    return "";
}

// What stands nearly upright counts as a wall to read about, whatever the maximum slope.
constexpr double wall_normal_y = 0.1, ceiling_normal_y = -0.9;

std::string touched(const SweepRecord& sweep, bool walkable) {
    const Contact& contact = *sweep.contact;
    if (contact.feature == Feature::edge) return "an edge";
    if (contact.feature == Feature::vertex) return "a corner";
    const double up = contact.normal.y();
    const char* noun = walkable                ? "the floor"
                       : up > wall_normal_y    ? "a steep slope"
                       : up > -wall_normal_y   ? "a wall"
                       : up > ceiling_normal_y ? "an overhang"
                                               : "the ceiling";
    return sweep.back
               ? "the back of " + std::string(up > -wall_normal_y && up <= wall_normal_y ? "a wall" : noun)
               : noun;
}

// Decisions that say that nothing was to be done.
bool is_routine(Decision kind) {
    switch (kind) {
        case Decision::pressed_down:
        case Decision::sector_kept:
        case Decision::push_out_needless:
        case Decision::nudge_needless:
        case Decision::energy_within:
        case Decision::slope_speed_kept:
        case Decision::slope_speed_off:
        case Decision::seam_stands_out:
        case Decision::terrain_above: return true;
        default: return false;
    }
}

bool is_trouble(Decision kind) {
    return kind == Decision::never_inside || kind == Decision::nudge_failed ||
           kind == Decision::platform_crushed || kind == Decision::slides_used_up;
}

class StoryWriter {
  public:
    StoryWriter(const StoryNames& names, const MovementSettings& settings, const TickTrace* tick,
                std::span<const TraceRecord> records, std::vector<StoryLine>& lines)
        : names_(names), settings_(settings), tick_(tick), records_(records), lines_(lines) {}

    void describe(std::size_t index) {
        StoryLine line;
        line.record = index;
        std::visit([&](const auto& r) { write(line, r); }, records_[index]);
        if (!line.position) line.position = position_;
        lines_.push_back(std::move(line));
    }

  private:
    // The sweep on which a player who was standing goes on standing.
    bool is_rest(std::size_t sweep) const {
        if (tick_ == nullptr || !tick_->before.grounded) return false;
        const auto* down = std::get_if<SweepRecord>(&records_[sweep]);
        if (down == nullptr || down->pass != Pass::vertical || !down->contact || down->move.y() > 0.0)
            return false;
        for (std::size_t i = sweep + 1; i < records_.size(); ++i) {
            if (std::holds_alternative<SweepRecord>(records_[i])) return false;
            const auto* decision = std::get_if<DecisionRecord>(&records_[i]);
            if (decision != nullptr && decision->kind == Decision::stood) return true;
        }
        return false;
    }

    void write(StoryLine& line, const SweepRecord& sweep) {
        Words words = words_of(line);
        pass_ = sweep.pass;
        line.title = "Sweep " + std::to_string(sweep.iteration + 1) + ", " + sweep_title(sweep);
        const double requested = sweep.move.norm();
        position_ = sweep.reached;
        folding_ = is_rest(*line.record);
        if (!sweep.contact) {
            words.say("Moved ").length(requested).say(", nothing in the way");
            line.position = sweep.reached;
            return;
        }
        const Contact& contact = *sweep.contact;
        line.position = contact.point;
        line.normal = contact.normal;
        line.face = contact.face;
        line.triangle = contact.triangle;
        const bool walkable = is_walkable(names_, settings_, contact.normal, contact.surface);
        if (folding_) {
            line.title.clear();
            words.say("Resting on ").say(touched(sweep, walkable)).say(" (");
            words.say(face_text(names_, contact.face, contact.surface)).say(")");
            return;
        }
        words.say("Touched ").say(touched(sweep, walkable)).say(" (");
        words.say(face_text(names_, contact.face, contact.surface)).say(")");
        const double tilt = slope_degrees(contact.normal);
        if (tilt < 0.05) {
            words.say(", level");
        } else if (std::abs(tilt - 90.0) < 0.05) {
            words.say(", upright");
        } else if (tilt > 179.95) {
            words.say(", overhead");
        } else if (tilt > 90.0) {
            words.say(", overhanging by ").degrees(tilt - 90.0);
        } else {
            words.say(", sloping ").degrees(tilt);
        }
        if (contact.feature != Feature::interior) {
            const double feet = sweep.from.y() + contact.t * sweep.move.y() - settings_.radii.y();
            const double above = contact.point.y() - feet;
            words.say(", ").length(std::abs(above)).say(above < 0.0 ? " below the feet" : " above the feet");
        }
        words.say(", after ").length_of(contact.t * requested, requested);
    }

    void write(StoryLine& line, const ResponseRecord& response) {
        line.depth = 1;
        line.tone = StoryTone::acted;
        line.folded = folding_;
        line.face = response.face;
        line.normal = response.normal;
        const std::uint64_t acted = hacks_acted(response);
        for (std::size_t row = 0; row < hack_rows().size(); ++row)
            if ((acted >> row) & 1) line.hack = hack_rows()[row];
        Words words = words_of(line);
        words.say(rule_sentence(response));
        const double before_m = response.remainder_before.norm(), after_m = response.remainder_after.norm();
        if (after_m > 0.0) {
            words.say(": ").length_of(after_m, before_m).say(" remain");
        } else {
            words.say(": the last ").length(before_m).say(" are lost");
        }
        const double before = response.velocity_before.norm(), after = response.velocity_after.norm();
        if (std::abs(after - before) >= 0.005)
            words.say(", speed from ").speed(before).say(" to ").speed(after);
        if (loses_the_wish(response)) line.tone = StoryTone::trouble;
    }

    static const char* rule_sentence(const ResponseRecord& response) {
        switch (response.rule) {
            case Rule::slide: return "Slid along it";
            case Rule::bounce: return "Bounced off it";
            case Rule::straight_ahead: return "Continued straight ahead on it";
            case Rule::keep_energy: return "Turned along it at full speed";
            case Rule::stick: return "Stuck to it";
            case Rule::crease: return "Slid along the crease of two faces";
            // What is left after a landing is walked.
            case Rule::stop: return response.remainder_after.isZero(0.0) ? "Stopped at it" : "Landed on it";
        }
        return "";
    }

    // More than half of what the stick asked of the horizontal motion, where anything is asked.
    bool loses_the_wish(const ResponseRecord& response) const {
        if (pass_ == Pass::vertical || tick_ == nullptr || tick_->input.wish.isZero(0.0)) return false;
        const Vec2 wish = tick_->input.wish.normalized();
        const auto along = [&](const Vec3& v) { return v.x() * wish.x() + v.z() * wish.y(); };
        const double before = along(response.remainder_before);
        return before > settings_.skin && along(response.remainder_after) < 0.5 * before;
    }

    void write(StoryLine& line, const DecisionRecord& decision) {
        const DecisionInfo& info = decision_info(decision.kind);
        line.depth = 1;
        line.tone = is_trouble(decision.kind)        ? StoryTone::trouble
                    : info.outcome == Outcome::acted ? StoryTone::acted
                                                     : StoryTone::refused;
        line.folded = folding_ || is_routine(decision.kind);
        line.face = decision.face;
        const std::optional<std::size_t> row = hack_row(info.hack);
        line.hack = row ? hack_rows()[*row] : nullptr;
        words_of(line).decision(decision);
    }

    void write(StoryLine& line, const PushOutRecord& push) {
        line.tone = push.free ? StoryTone::acted : StoryTone::trouble;
        line.position = push.to;
        line.hack = find_setting("push_out");
        const Vec3 motion = push.to - push.from;
        line.normal = motion.norm() > 0.0 ? Vec3(motion.normalized()) : Vec3(Vec3::Zero());
        position_ = push.to;
        Words words = words_of(line);
        words.say(push.free ? "Pushed out of " : "Not pushed out of ").count(push.planes);
        words.say(push.planes == 1 ? " face" : " faces");
        if (push.free) {
            words.say(" by ").length(motion.norm());
        } else {
            words.say(": moving by ").length(motion.norm()).say(" would end inside another");
        }
    }

    const StoryNames& names_;
    const MovementSettings& settings_;
    const TickTrace* tick_;
    std::span<const TraceRecord> records_;
    std::vector<StoryLine>& lines_;
    Pass pass_ = Pass::slide;
    bool folding_ = false;          // what follows belongs to the sweep that rests on the ground
    std::optional<Vec3> position_;  // of the player, as far as the story has come
};

std::vector<StoryLine> describe_records(std::span<const TraceRecord> records, const StoryNames& names,
                                        const MovementSettings& settings, const TickTrace* tick) {
    std::vector<StoryLine> lines;
    StoryWriter writer(names, settings, tick, records, lines);
    // The seam filter records its decision before the sweep that touched; the story has it after the sweep.
    const auto of_next_sweep = [&](std::size_t i) {
        const auto* decision = std::get_if<DecisionRecord>(&records[i]);
        return decision != nullptr && std::string_view(decision_info(decision->kind).hack) == "seam_filter";
    };
    for (std::size_t i = 0; i < records.size(); ++i) {
        std::size_t sweep = i;
        while (sweep < records.size() && of_next_sweep(sweep))
            ++sweep;
        if (sweep < records.size()) writer.describe(sweep);
        for (; i < sweep; ++i)
            writer.describe(i);
    }
    return lines;
}

}  // namespace

std::vector<StoryLine> describe(std::span<const TraceRecord> records, const StoryNames& names,
                                const MovementSettings& settings) {
    return describe_records(records, names, settings, nullptr);
}

std::vector<StoryLine> describe(const TickTrace& trace, const StoryNames& names) {
    std::vector<StoryLine> lines = describe_records(trace.records, names, trace.settings, &trace);
    lines.insert(lines.begin(), begin_line(trace, names));
    lines.push_back(end_line(trace, names));
    // What was decided before the first sweep was decided where the tick began.
    for (StoryLine& line : lines) {
        if (!line.position) line.position = trace.from;
    }
    return lines;
}

std::string line_text(const StoryLine& line) {
    return line.title.empty() ? line.text : line.title + ": " + line.text;
}

std::string story_text(std::span<const StoryLine> lines) {
    std::string text;
    for (const StoryLine& line : lines) {
        text += std::string(static_cast<std::size_t>(2 * line.depth), ' ');
        text += line_text(line) + "\n";
    }
    return text;
}

}  // namespace slipface
