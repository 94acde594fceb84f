#include "cure_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "story_words.h"

namespace slipface {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// How blunt a cure is, apart from numbers.
constexpr int switch_on = 0, fitting = 1, other_choice = 2, switch_off = 3, other_type = 4, not_solid = 5;
// A move that the game did not have; a press of its button asks for it.
constexpr int new_move = 3, asked_move = 1, asked_number = 0;
// A number changed by more than this fraction is as blunt as a switch thrown off.
constexpr double much = 0.5;

// A number that may be the cure: how far it is tried, as a factor of its value or as a value, and the steps
// in which it is shown.
struct NumberRow {
    const char* name;
    const char* also;       // a second setting that gets the same value, or empty
    double factor;          // extreme = now * factor
    double least, maximum;  // of the extreme; as stored
    double step;
};
constexpr auto number_rows = std::to_array<NumberRow>({
    {"max_slope", "", 4.0, 0.0, 89.0 * degree, 0.1 * degree},
    {"step_height", "", 4.0, 0.0, 1.2, 0.01},
    {"snap_distance", "", 4.0, 0.0, 1.2, 0.01},
    {"radius_x", "radius_z", 0.25, 0.05, 5.0, 0.01},
    {"radius_y", "", 0.4, 0.05, 5.0, 0.01},
    {"skin", "", 0.1, 1e-4, 0.05, 1e-4},
    {"max_slides", "", 8.0, 1.0, 8.0, 1.0},
    {"coyote_time", "", 10.0, 0.0, 0.5, 0.01},
    {"jump_buffer_time", "", 10.0, 0.0, 0.5, 0.01},
    {"jump_speed", "", 2.0, 0.0, 50.0, 0.1},
    {"gravity", "", 0.4, 0.0, 100.0, 0.1},
    {"air_acceleration", "", 10.0, 0.0, 500.0, 1.0},
    {"walk_speed", "", 2.5, 0.0, 100.0, 0.1},
});
// Of abilities: one that is off is no question of its numbers.
constexpr auto ability_rows = std::to_array<NumberRow>({
    {"air_jumps", "", 4.0, 1.0, 100.0, 1.0},
    {"air_jump_speed", "", 2.0, 0.0, 50.0, 0.1},
    {"wall_slide_speed", "", 0.25, 0.0, 50.0, 0.1},
    {"wall_jump_up", "", 2.0, 0.0, 50.0, 0.1},
    {"wall_jump_away", "", 2.0, 0.0, 50.0, 0.1},
    {"wall_jump_reach", "", 5.0, 0.01, 1.0, 0.01},
    {"dash_speed", "", 2.5, 0.0, 100.0, 0.1},
    {"dash_time", "", 2.5, 0.0, 5.0, 0.01},
    {"dashes", "", 4.0, 0.0, 100.0, 1.0},
    {"crouch_radius_y", "", 0.4, 0.05, 5.0, 0.01},
    {"crouch_speed", "", 2.5, 0.0, 100.0, 0.1},
    {"ledge_hands", "", 3.0, 0.0, 5.0, 0.01},
    {"ledge_reach", "", 5.0, 0.01, 2.0, 0.01},
    {"glide_speed", "", 0.25, 0.0, 50.0, 0.1},
});

// Whether a number is what a designer would look at first for such a stop.
bool fits(const Loss& loss, std::string_view number) {
    switch (loss.cause) {
        case StopCause::step: return number == (loss.in_air ? "jump_speed" : "step_height");
        case StopCause::slope:
        case StopCause::terrain: return number == "max_slope";
        case StopCause::gap: return number == "radius_x";
        case StopCause::overhead: return number == "radius_y" || number == "crouch_radius_y";
        case StopCause::wall: return loss.in_air && number == "jump_speed";
        default: return false;
    }
}

std::string value_text(const SettingInfo& info, double value) {
    const bool angle = std::string_view(info.unit) == "deg";
    std::string text = fmt::format("{:.4g}", angle ? value / degree : value);
    if (angle) return text + "\u00b0";
    return *info.unit ? text + " " + info.unit : text;
}

std::string assignment(const SettingInfo& info, double value) {
    const bool angle = std::string_view(info.unit) == "deg";
    return angle ? fmt::format("{}={:.12g}deg", info.name, value / degree)
                 : fmt::format("{}={:.12g}", info.name, value);
}

using Names = std::span<const std::string_view>;
bool has(Names names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

bool is_move(const SettingInfo& info) {
    return std::ranges::any_of(ability_rows, [&](const NumberRow& row) {
        return std::string_view(find_setting(row.name)->switch_name) == info.name;
    });
}

void add_switches(std::vector<CureCandidate>& all, const MovementSettings& settings, Names asked) {
    for (const SettingInfo* info : hack_rows()) {
        const double now = get_setting(settings, *info);
        for (double value = info->minimum; value <= info->maximum; value += 1.0) {
            if (value == now) continue;
            MovementSettings other;
            (void)set_setting(other, *info, value);
            CureCandidate c;
            const std::string text = setting_text(other, *info);
            c.cure.text = std::string(info->label) + " " + text;
            c.cure.settings = {std::string(info->name) + "=" + text};
            c.cure.button = is_switch(*info) ? (value > 0.0 ? "Turn on" : "Turn off") : "Set";
            c.cure.bluntness = value == 0.0 ? switch_off : now == 0.0 ? switch_on : other_choice;
            if (now == 0.0 && is_move(*info))
                c.cure.bluntness = has(asked, info->name) ? asked_move : new_move;
            all.push_back(std::move(c));
        }
    }
}

void add_numbers(std::vector<CureCandidate>& all, const MovementSettings& settings, const Loss& loss,
                 Names asked) {
    std::vector<NumberRow> rows(number_rows.begin(), number_rows.end());
    for (const NumberRow& row : ability_rows)
        if (get_setting(settings, *find_setting(find_setting(row.name)->switch_name)) != 0.0)
            rows.push_back(row);
    for (const NumberRow& row : rows) {
        const SettingInfo* info = find_setting(row.name);
        CureCandidate c;
        c.numbers = {info};
        if (*row.also) c.numbers.push_back(find_setting(row.also));
        c.now = get_setting(settings, *info);
        c.extreme = std::clamp(c.now * row.factor, row.least, row.maximum);
        c.step = row.step;
        c.fits = fits(loss, row.name);
        c.asked = has(asked, row.name) || has(asked, info->switch_name);
        if ((c.extreme - c.now) * (row.factor - 1.0) <= 0.0) continue;
        if (*info->switch_name) {
            const SettingInfo* with = find_setting(info->switch_name);
            if (with != nullptr && get_setting(settings, *with) == 0.0)
                c.with = {std::string(with->name) + "=on"};
        }
        all.push_back(std::move(c));
    }
}

CureCandidate painted(std::vector<FaceId> faces, SurfaceType type, std::string text, int bluntness) {
    CureCandidate c;
    c.cure.text = std::move(text);
    c.cure.button = "Paint";
    c.cure.faces = std::move(faces);
    c.cure.type = std::move(type);
    c.cure.bluntness = bluntness;
    return c;
}

// Whether a type does something of its own to a player. As a cure it would change what the face is: nobody
// turns a wall into a ladder or a trampoline to get past it.
bool is_special(const SurfaceType& type) {
    return type.climbable || type.sticky || type.restitution > 0.0 || type.keeps_energy || type.hazardous ||
           type.angular_velocity != 0.0 || !type.velocity.isZero(0.0);
}

// What is held fast there, in words: "face 8", "2 faces of `block`".
std::string faces_text(const Level& level, std::span<const FaceId> faces) {
    const std::string one = "face " + std::to_string(faces.front());
    if (faces.size() == 1) return one;
    const std::string object = object_text(StoryNames(level), faces.front());
    return fmt::format("{} faces of {}", faces.size(), object.empty() ? "the plane of " + one : object);
}

void add_types(std::vector<CureCandidate>& all, const Level& level, const Stop& stop) {
    const Loss& loss = stop.loss;
    if (loss.face == no_id || loss.face >= level.mesh.face_count()) return;
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    const SurfaceId now = resolved.surface[loss.face];
    std::vector<FaceId> faces = stop.held_by;
    // A type holds or carries on all faces that have it, not on the one that is stood on.
    for (FaceId face = 0; stop.held_by.empty() && face < resolved.surface.size(); ++face)
        if (face == loss.face || (resolved.surface[face] == now && now != default_surface &&
                                  level.mesh.group_of(face) == level.mesh.group_of(loss.face)))
            faces.push_back(face);
    const std::string face = faces_text(level, faces);
    for (std::size_t i = 0; i < level.surfaces.size(); ++i) {
        if (i == now) continue;
        const SurfaceType& type = level.surfaces[i];
        const bool goes_on = loss.cause == StopCause::ladder_end && type.climbable;
        if (is_special(type) && !goes_on) continue;
        const bool gone = !type.solid || (type.one_sided && loss.cause == StopCause::back);
        all.push_back(painted(
            faces, type, fmt::format("`{}` instead of `{}` on {}", type.name, level.surfaces[now].name, face),
            !type.solid                               ? not_solid
            : i == default_surface || gone || goes_on ? fitting
                                                      : other_type));
    }
    SurfaceType other = level.surfaces[now];
    other.hotkey = 0;
    if (loss.cause == StopCause::back && !other.one_sided) {
        other.one_sided = true;
        other.name = level.surfaces[now].name + " one-sided";
        all.push_back(painted(faces, other, "Make " + face + " one-sided", fitting));
        other.one_sided = false;
    }
    if (loss.cause == StopCause::fall && other.one_sided) {
        other.one_sided = false;
        other.name = level.surfaces[now].name + " two-sided";
        all.push_back(painted(faces, other, "Make " + face + " two-sided", fitting));
    }
    if (loss.cause == StopCause::fall && !other.solid) {
        other.solid = true;
        other.name = level.surfaces[now].name + " solid";
        all.push_back(painted(faces, other, "Make " + face + " solid", fitting));
    } else if (other.solid && (loss.cause != StopCause::fall || stop.fall == FallCause::cut_short ||
                               stop.fall == FallCause::pushed)) {
        other.solid = false;
        other.name = level.surfaces[now].name + " not solid";
        all.push_back(painted(faces, other, "Make " + face + " not solid", not_solid));
        // Behind the face of a solid thing stands its back.
        if (!level.mesh.has_many_groups()) return;
        const std::string object = level.mesh.group_of(loss.face);
        std::vector<FaceId> whole;
        for (FaceId other_face = 0; other_face < level.mesh.face_count(); ++other_face)
            if (level.mesh.group_of(other_face) == object) whole.push_back(other_face);
        if (whole.size() > faces.size())
            all.push_back(painted(std::move(whole), other, "Make `" + object + "` not solid", not_solid));
    }
}

}  // namespace

std::vector<CureCandidate> cure_candidates(const Level& level, const MovementSettings& settings,
                                           const Stop& stop, std::span<const std::string_view> asked) {
    std::vector<CureCandidate> all;
    add_switches(all, settings, asked);
    add_numbers(all, settings, stop.loss, asked);
    add_types(all, level, stop);
    return all;
}

Cure number_cure(const CureCandidate& candidate, double value) {
    Cure cure;
    cure.button = "Set";
    cure.settings = candidate.with;
    for (const std::string& with : candidate.with)
        cure.text += std::string(find_setting(with.substr(0, with.find('=')))->label) + " on, ";
    const SettingInfo& info = *candidate.numbers.front();
    std::string label = info.label;
    if (candidate.numbers.size() > 1) label = "Radius X and Z";
    cure.text += fmt::format("{} {} to {}", label, value_text(info, candidate.now), value_text(info, value));
    for (const SettingInfo* number : candidate.numbers)
        cure.settings.push_back(assignment(*number, value));
    cure.change = std::abs(value - candidate.now) / std::max(std::abs(candidate.now), 1e-9);
    cure.bluntness = candidate.asked      ? asked_number
                     : candidate.fits     ? fitting
                     : cure.change > much ? switch_off
                                          : other_choice;
    return cure;
}

}  // namespace slipface
