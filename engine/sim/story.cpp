#include "slipface/sim/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipface {
namespace {

// Metres below which a length is told in millimetres.
constexpr double short_length_m = 1.0;

// Writes a line's text and notes its numbers.
class Writer {
  public:
    explicit Writer(StoryLine& line) : line_(line) {}

    Writer& say(std::string_view words) {
        line_.text += words;
        return *this;
    }
    Writer& number(double value, std::string_view unit, int digits) {
        std::string text = fmt::format("{:.{}f}", value, digits);
        if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
        if (!unit.empty()) text += " " + std::string(unit);
        line_.text += text;
        line_.numbers.push_back({value, std::move(text)});
        return *this;
    }
    Writer& length(double metres) {
        return std::abs(metres) < short_length_m ? number(metres * 1000.0, "mm", 1) : number(metres, "m", 3);
    }
    Writer& speed(double value) { return number(value, "m/s", 2); }
    Writer& change_of_speed(double from, double to) {
        speed(from).say(" \u2192 ").speed(to);
        const double change = to - from;
        if (std::abs(change) >= 0.005) say(" (").say(change > 0 ? "+" : "").speed(change).say(")");
        return *this;
    }
    Writer& vector(const Vec3& v) {
        say("(");
        for (int axis = 0; axis < 3; ++axis)
            say(axis == 0 ? "" : ", ").number(v[axis], "", 2);
        return say(")");
    }
    // Of a ratio or an unknown quantity. What three decimals would not show is told by its order of
    // magnitude.
    Writer& plain(double value) {
        if (value == 0.0 || !(std::abs(value) < 5e-3)) return number(value, "", 3);
        std::string text = fmt::format("{:.2g}", value);
        line_.text += text;
        line_.numbers.push_back({value, std::move(text)});
        return *this;
    }

  private:
    StoryLine& line_;
};

std::string sentence(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

std::string surface_name(SurfaceTable surfaces, SurfaceId id) {
    return id < surfaces.size() ? surfaces[id].name : "unknown";
}

std::string face_name(FaceId face) {
    return face == no_id ? std::string("no face") : "face " + std::to_string(face);
}

std::string stance(const PlayerState& state, SurfaceTable surfaces) {
    const std::string on = surface_name(surfaces, state.ground_surface) + ", " + face_name(state.ground_face);
    if (state.climbing) return "climbing " + on;
    if (state.stuck) return "stuck to " + on;
    if (state.grounded) return "standing on " + on;
    return "in the air";
}

StoryLine begin_line(const TickTrace& trace, SurfaceTable surfaces) {
    StoryLine line;
    line.title = "Begins";
    line.place = trace.from;
    line.face = trace.before.ground_face;
    Writer words(line);
    words.say(stance(trace.before, surfaces)).say(" at ").speed(trace.before.velocity.norm());
    const Vec2& wish = trace.input.wish;
    if (!wish.isZero(0.0)) {
        // A compass is easier to read than two components: 0 deg is -Z, 90 deg is +X.
        double heading = std::atan2(wish.x(), -wish.y()) * 180.0 / std::numbers::pi;
        if (heading < 0.0) heading += 360.0;
        words.say(", stick ").number(100.0 * wish.norm(), "%", 0).say(" towards ").number(heading, "deg", 0);
    }
    if (trace.input.jump) words.say(trace.before.jump_held ? ", jump held" : ", jump pressed");
    return line;
}

StoryLine end_line(const TickTrace& trace, SurfaceTable surfaces) {
    const PlayerState& end = trace.after.stepped;
    StoryLine line;
    line.title = "Ends";
    line.place = trace.to;
    line.face = end.ground_face;
    line.normal = end.ground_face == no_id ? Vec3(Vec3::Zero()) : end.ground_normal;
    Writer words(line);
    words.say(stance(end, surfaces)).say(", moved ").length((trace.to - trace.from).norm());
    words.say(", speed ").change_of_speed(trace.before.velocity.norm(), end.velocity.norm());
    if (trace.after.respawn == Respawn::hazard) words.say("; touched a hazard, back to the start");
    if (trace.after.respawn == Respawn::fall) words.say("; fell out of the level, back to the start");
    if (trace.after.respawn != Respawn::none) line.tone = StoryTone::trouble;
    return line;
}

class Teller {
  public:
    Teller(SurfaceTable surfaces, std::vector<StoryLine>& lines) : surfaces_(surfaces), lines_(lines) {}

    void tell(std::size_t index, const TraceRecord& record) {
        StoryLine line;
        line.record = index;
        std::visit([&](const auto& r) { write(line, r); }, record);
        if (!line.place) line.place = place_;
        lines_.push_back(std::move(line));
    }

  private:
    void write(StoryLine& line, const SweepRecord& sweep) {
        Writer words(line);
        line.title = fmt::format("Sweep {}, {}", sweep.iteration + 1, pass_name(sweep.pass));
        const double asked = sweep.move.norm();
        place_ = sweep.reached;
        if (!sweep.contact) {
            words.length(asked).say(", nothing in the way");
            line.place = sweep.reached;
            return;
        }
        const Contact& contact = *sweep.contact;
        line.place = contact.point;
        line.normal = contact.normal;
        line.face = contact.face;
        line.triangle = contact.triangle;
        const char* part = contact.feature == Feature::interior ? "inside" : feature_name(contact.feature);
        words.say("touches the ").say(part).say(" of triangle ").say(std::to_string(contact.triangle));
        words.say(" (").say(face_name(contact.face)).say(", ");
        words.say(surface_name(surfaces_, contact.surface)).say(") after ");
        words.length(contact.t * asked).say(" of ").length(asked);
        const double tilt = std::acos(std::clamp(contact.normal.y(), -1.0, 1.0)) * 180.0 / std::numbers::pi;
        words.say("; normal ").vector(contact.normal).say(", slope ").number(tilt, "deg", 1);
    }

    void write(StoryLine& line, const ResponseRecord& response) {
        line.depth = 1;
        line.tone = StoryTone::acted;
        line.face = response.face;
        line.normal = response.normal;
        line.title = sentence(rule_name(response.rule));
        const std::uint64_t acted = hacks_acted(response);
        for (std::size_t row = 0; row < hack_rows().size(); ++row)
            if ((acted >> row) & 1) line.hack = hack_rows()[row];
        Writer words(line);
        words.length(response.leftover_before.norm()).say(" left become ");
        words.length(response.leftover_after.norm());
        const double before = response.velocity_before.norm(), after = response.velocity_after.norm();
        words.say("; speed ").change_of_speed(before, after);
        if (response.rule == Rule::stop || (before > 0.5 && after < 0.1 * before))
            line.tone = StoryTone::trouble;
    }

    void write(StoryLine& line, const DecisionRecord& decision) {
        line.depth = 1;
        line.tone = decision.acted ? StoryTone::acted : StoryTone::refused;
        line.face = decision.face;
        const std::optional<std::size_t> row = hack_row(decision.hack);
        const SettingInfo* info = find_setting(decision.hack);
        line.hack = row ? hack_rows()[*row] : nullptr;
        line.title = info ? info->label : sentence(decision.hack);
        if (std::string_view(decision.hack) == "never_inside") line.tone = StoryTone::trouble;
        Writer words(line);
        words.say(decision.outcome);
        if (*decision.quantity) {
            words.say("; ").say(decision.quantity).say(" ").plain(decision.value);
            words.say(", limit ").plain(decision.limit);
        }
    }

    void write(StoryLine& line, const PushOutRecord& push) {
        line.title = "Push-out";
        line.tone = push.free ? StoryTone::acted : StoryTone::trouble;
        line.place = push.to;
        line.hack = find_setting("push_out");
        const Vec3 way = push.to - push.from;
        line.normal = way.norm() > 0.0 ? Vec3(way.normalized()) : Vec3(Vec3::Zero());
        place_ = push.to;
        Writer words(line);
        words.number(push.planes, push.planes == 1 ? "plane" : "planes", 0).say(" push the player by ");
        words.length(way.norm()).say(push.free ? "; free there" : "; not free there, so it stays");
    }

    SurfaceTable surfaces_;
    std::vector<StoryLine>& lines_;
    std::optional<Vec3> place_;  // of the player, as far as the story has come
};

}  // namespace

std::vector<StoryLine> tell(std::span<const TraceRecord> records, SurfaceTable surfaces) {
    std::vector<StoryLine> lines;
    Teller teller(surfaces, lines);
    // What the seam filter says of a touch is recorded before the sweep that touched, and told after it.
    const auto of_next_sweep = [&](std::size_t i) {
        const auto* decision = std::get_if<DecisionRecord>(&records[i]);
        return decision != nullptr && std::string_view(decision->hack) == "seam_filter";
    };
    for (std::size_t i = 0; i < records.size(); ++i) {
        std::size_t sweep = i;
        while (sweep < records.size() && of_next_sweep(sweep))
            ++sweep;
        if (sweep < records.size()) teller.tell(sweep, records[sweep]);
        for (; i < sweep; ++i)
            teller.tell(i, records[i]);
    }
    return lines;
}

std::vector<StoryLine> tell(const TickTrace& trace, SurfaceTable surfaces) {
    std::vector<StoryLine> lines = tell(trace.records, surfaces);
    lines.insert(lines.begin(), begin_line(trace, surfaces));
    lines.push_back(end_line(trace, surfaces));
    // What was decided before the first sweep was decided where the tick began.
    for (StoryLine& line : lines) {
        if (!line.place) line.place = trace.from;
    }
    return lines;
}

std::optional<std::size_t> telling_line(std::span<const StoryLine> lines,
                                        std::span<const TraceRecord> records) {
    std::optional<std::size_t> found;
    double most_lost = 0.05;  // m/s; less is what walking on the ground takes away at every tick
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].tone == StoryTone::trouble) return i;
        if (!lines[i].record) continue;
        const auto* response = std::get_if<ResponseRecord>(&records[*lines[i].record]);
        if (!response) continue;
        const double lost = response->velocity_before.norm() - response->velocity_after.norm();
        if (lost > most_lost) {
            most_lost = lost;
            found = i;
        }
    }
    return found;
}

std::string story_text(std::span<const StoryLine> lines) {
    std::string text;
    for (const StoryLine& line : lines)
        text +=
            std::string(static_cast<std::size_t>(2 * line.depth), ' ') + line.title + ": " + line.text + "\n";
    return text;
}

}  // namespace slipface
