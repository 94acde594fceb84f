#include "story_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipface {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

std::string digits_of(double value, int digits) {
    std::string text = fmt::format("{:.{}f}", value, digits);
    if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
    return text;
}

std::string trimmed(double value, int digits) {
    std::string text = digits_of(value, digits);
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

// A number as it is shown: in the unit that people read.
struct Shown {
    double value;
    const char* unit;
    int digits;
    bool trim;

    std::string text(int more_digits = 0) const {
        return trim ? trimmed(value, digits + more_digits) : digits_of(value, digits + more_digits);
    }
};

Shown shown_length(double metres, double largest) {
    if (std::abs(largest) >= 0.1) return {metres, " m", 3, true};
    // What a tenth of a millimetre would not show.
    const bool tiny = metres != 0.0 && std::abs(metres) < 5e-5;
    return {metres * 1000.0, " mm", tiny ? 4 : 1, tiny};
}

Shown shown(DecisionUnit unit, double value, double largest) {
    switch (unit) {
        case DecisionUnit::metres: return shown_length(value, largest);
        case DecisionUnit::speed: return {value, " m/s", 2, true};
        case DecisionUnit::seconds: return {value, " s", 3, true};
        case DecisionUnit::percent: return {100.0 * value, " %", 0, true};
        case DecisionUnit::slope:
        case DecisionUnit::angle:
            return {std::acos(std::clamp(value, -1.0, 1.0)) * degrees_per_radian, "\u00b0", 1, true};
        case DecisionUnit::lift:
            return {std::asin(std::clamp(value, -1.0, 1.0)) * degrees_per_radian, "\u00b0", 1, true};
        case DecisionUnit::no_unit: break;
    }
    return {value, "", 2, true};
}

std::string quoted(const std::string& name) {
    return name.empty() ? name : "`" + name + "`";
}

std::string group_of(const LevelMesh& mesh, FaceId face) {
    return face < mesh.face_count() && mesh.has_many_groups() ? mesh.group_of(face) : std::string();
}

std::string material_of(const LevelMesh& mesh, FaceId face) {
    return face < mesh.face_count() ? mesh.material_of(face) : std::string();
}

}  // namespace

Words& Words::number(double value, std::string_view unit, std::string text) {
    text_ += text;
    numbers_.push_back({value, std::string(unit), std::move(text)});
    return *this;
}

Words& Words::length(double metres) {
    const Shown s = shown_length(metres, metres);
    return number(s.value, s.unit, s.text()).say(s.unit);
}

Words& Words::length_of(double part, double whole) {
    const Shown of = shown_length(whole, whole), s = shown_length(part, whole);
    number(s.value, s.unit, s.text()).say(" of ");
    return number(of.value, of.unit, of.text()).say(of.unit);
}

Words& Words::size(double metres) {
    const bool small = std::abs(metres) < 0.05;
    const Shown s{small ? metres * 1000.0 : metres, small ? " mm" : " m", small ? 0 : 2, true};
    return number(s.value, s.unit, s.text()).say(s.unit);
}

Words& Words::speed(double value) {
    const Shown s = shown(DecisionUnit::speed, value, value);
    return number(s.value, s.unit, s.text()).say(s.unit);
}

Words& Words::degrees(double value) {
    return number(value, "\u00b0", trimmed(value, 1)).say("\u00b0");
}

Words& Words::percent(double fraction) {
    const Shown s = shown(DecisionUnit::percent, fraction, fraction);
    return number(s.value, s.unit, s.text()).say(s.unit);
}

Words& Words::ratio(double value) {
    return number(value, "", trimmed(value, 2));
}

Words& Words::count(double whole) {
    return number(whole, "", trimmed(whole, 0));
}

Words& Words::seconds(double seconds) {
    return number(seconds, " s", trimmed(seconds, 2)).say(" s");
}

Words& Words::decision(const DecisionRecord& decision) {
    const DecisionInfo& info = decision_info(decision.kind);
    const double largest = std::max(std::abs(decision.value), std::abs(decision.limit));
    const Shown value = shown(info.unit, decision.value, largest);
    const Shown limit = shown(info.unit, decision.limit, largest);
    // "50° (limit 50°)" would say nothing: as many digits as it takes to tell the two apart.
    int more = 0;
    const bool both = std::string_view(info.sentence).find("{limit}") != std::string_view::npos;
    while (both && more < 6 && value.value != limit.value && value.text(more) == limit.text(more))
        ++more;
    std::string_view rest = info.sentence;
    for (std::size_t open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
        say(rest.substr(0, open));
        const Shown& s = rest.substr(open).starts_with("{value}") ? value : limit;
        number(s.value, s.unit, s.text(more)).say(s.unit);
        rest.remove_prefix(rest.find('}') + 1);
    }
    return say(rest);
}

double slope_degrees(const Vec3& normal) {
    return std::acos(std::clamp(normal.y(), -1.0, 1.0)) * degrees_per_radian;
}

std::string face_text(const StoryNames& names, FaceId face, SurfaceId surface) {
    if (face == no_id) return "the terrain";
    std::string text = "face " + std::to_string(face);
    const std::string group = group_of(names.mesh, face), material = material_of(names.mesh, face);
    if (!group.empty()) text += " of " + quoted(group);
    if (!material.empty() && material != group) text += ", " + quoted(material);
    if (surface != default_surface && surface < names.surfaces.size())
        text += ", " + names.surfaces[surface].name;
    return text;
}

std::string thing_text(const StoryNames& names, FaceId face) {
    if (face == no_id) return "the air";
    const std::string object = object_text(names, face);
    const std::string number = "face " + std::to_string(face);
    return object.empty() ? number : object + " (" + number + ")";
}

std::string size_text(double metres) {
    std::string text;
    std::vector<StoryNumber> numbers;
    Words(text, numbers).size(metres);
    return text;
}

std::string object_text(const StoryNames& names, FaceId face) {
    const std::string group = group_of(names.mesh, face);
    return quoted(group.empty() ? material_of(names.mesh, face) : group);
}

bool is_walkable(const StoryNames& names, const MovementSettings& settings, const Vec3& normal,
                 SurfaceId surface) {
    const bool typed = settings.surface_types && surface < names.surfaces.size();
    const double limit =
        typed ? names.surfaces[surface].max_slope.value_or(settings.max_slope) : settings.max_slope;
    return normal.y() >= std::cos(limit) - 1e-12;
}

}  // namespace slipface
