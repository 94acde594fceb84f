#include "slipface/movement/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slipface/base/near_name.h"
#include "slipface/base/say.h"
#include "slipface/base/text.h"

namespace slipface {

namespace {

constexpr double degree = 0.017453292519943295;

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

bool is_angle(const SettingInfo& info) {
    return std::string_view(info.unit) == "deg";
}

// The allowed values, for error messages.
std::string allowed(const SettingInfo& info) {
    if (is_switch(info)) return "on or off";
    if (const auto choices = choices_of(info); !choices.empty()) {
        std::string text = choices.front().name;
        for (std::size_t i = 1; i < choices.size(); ++i)
            text += (i + 1 < choices.size() ? ", " : " or ") + std::string(choices[i].name);
        return text;
    }
    const bool whole = std::holds_alternative<int MovementSettings::*>(info.member);
    const bool gap = info.smallest > 0.0;
    std::string text = say("{}{} from {} to {}", gap ? "0 or " : "", whole ? "a whole number" : "a number",
                           to_text(gap ? info.smallest : info.minimum), to_text(info.maximum));
    if (is_angle(info)) {
        text += say(" radians ({}deg to {}deg)", std::round(info.minimum / degree),
                    std::round(info.maximum / degree));
    } else if (*info.unit != '\0') {
        text += say(" {}", info.unit);
    }
    return text;
}

std::string excerpt(std::string_view text) {
    constexpr std::size_t longest = 60;
    return text.size() <= longest ? std::string(text) : say("{}...", text.substr(0, longest));
}

std::string unknown_name(std::string_view name) {
    std::string text = say("no such setting: '{}'", excerpt(name));
    constexpr std::size_t longest_name = 64;
    if (name.size() > longest_name) return text;
    const std::string lower = to_lower(name);
    const SettingInfo* nearest = nullptr;
    std::size_t nearest_distance = 0;
    for (const SettingInfo& info : settings_table()) {
        const std::size_t distance = edit_distance(lower, info.name);
        if (nearest == nullptr || distance < nearest_distance) {
            nearest = &info;
            nearest_distance = distance;
        }
    }
    constexpr std::size_t likely = 4;  // letters changed
    if (nearest != nullptr && nearest_distance <= std::min(likely, name.size() / 2))
        text += say("; did you mean '{}'?", nearest->name);
    return text;
}

std::optional<double> parse_value(const SettingInfo& info, std::string_view text) {
    const std::string lower = to_lower(text);
    if (is_switch(info)) {
        if (lower == "true" || lower == "on") return 1.0;
        if (lower == "false" || lower == "off") return 0.0;
    }
    const std::span<const Choice> choices = choices_of(info);
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (lower == choices[i].name) return static_cast<double>(i);
    }
    if (is_angle(info) && lower.size() > 3 && lower.ends_with("deg")) {
        const std::optional<double> degrees =
            parse_double(trim(std::string_view(lower).substr(0, lower.size() - 3)));
        if (degrees) return *degrees * degree;
        return std::nullopt;
    }
    return parse_double(text);
}

}  // namespace

const SettingInfo* find_setting(std::string_view name) {
    for (const SettingInfo& info : settings_table()) {
        if (name == info.name) return &info;
    }
    return nullptr;
}

std::span<const Choice> choices_of(const SettingInfo& info) {
    const auto* choice = std::get_if<ChoiceMember>(&info.member);
    return choice != nullptr ? choice->choices : std::span<const Choice>();
}

std::string meaning_of(const SettingInfo& info) {
    std::string text = info.meaning;
    for (const Choice& choice : choices_of(info)) {
        std::string name = choice.name;
        std::replace(name.begin(), name.end(), '_', ' ');
        name[0] = static_cast<char>(name[0] - 'a' + 'A');
        text += say(" {}: {}.", name, choice.meaning);
    }
    return text;
}

void set_switches(MovementSettings& settings, bool on) {
    for (const SettingInfo& info : settings_table())
        if (const auto* member = std::get_if<bool MovementSettings::*>(&info.member))
            settings.*(*member) = on;
}

namespace {

// The numbers of the table alone, for a fast check in every step.
struct Numbers {
    std::array<double MovementSettings::*, 64> list{};
    std::size_t count = 0;

    Numbers() {
        for (const SettingInfo& info : settings_table()) {
            if (const auto* number = std::get_if<double MovementSettings::*>(&info.member))
                list.at(count++) = *number;
        }
    }
};

}  // namespace

MovementSettings basic_settings() {
    MovementSettings settings;
    // The rows' own values are in their range, so this cannot fail.
    for (const SettingInfo& info : settings_table())
        if (info.basic) static_cast<void>(set_setting(settings, info, *info.basic).ok());
    return settings;
}

bool is_finite(const MovementSettings& settings) {
    static const Numbers numbers;
    // Without a branch for each: 0 times anything else is NaN.
    double zero = 0.0;
    for (std::size_t i = 0; i < numbers.count; ++i)
        zero += 0.0 * settings.*numbers.list[i];
    return zero == 0.0 && settings.radii.allFinite();
}

double get_setting(const MovementSettings& settings, const SettingInfo& info) {
    return std::visit(
        Overloaded{
            [&](bool MovementSettings::*member) { return settings.*member ? 1.0 : 0.0; },
            [&](int MovementSettings::*member) { return static_cast<double>(settings.*member); },
            [&](double MovementSettings::*member) { return settings.*member; },
            [&](const ChoiceMember& choice) { return static_cast<double>(choice.get(settings)); },
            [&](Vec3 MovementSettings::*member) { return (settings.*member)[info.axis]; },
        },
        info.member);
}

Status set_setting(MovementSettings& settings, const SettingInfo& info, double value) {
    const bool number = std::holds_alternative<double MovementSettings::*>(info.member) ||
                        std::holds_alternative<Vec3 MovementSettings::*>(info.member);
    const bool in_gap = info.smallest > 0.0 && value != 0.0 && value < info.smallest;
    const bool fits = std::isfinite(value) && value >= info.minimum && value <= info.maximum && !in_gap &&
                      (number || value == std::floor(value));
    if (!fits) return Error{info.name, say("found {}, expected {}", to_text(value), allowed(info))};
    std::visit(Overloaded{
                   [&](bool MovementSettings::*member) { settings.*member = value != 0.0; },
                   [&](int MovementSettings::*member) { settings.*member = static_cast<int>(value); },
                   [&](double MovementSettings::*member) { settings.*member = value; },
                   [&](const ChoiceMember& choice) { choice.set(settings, static_cast<int>(value)); },
                   [&](Vec3 MovementSettings::*member) { (settings.*member)[info.axis] = value; },
               },
               info.member);
    return {};
}

Status set_setting(MovementSettings& settings, std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        return Error{"", say("'{}' is not name=value", excerpt(assignment))};
    }
    const std::string_view name = trim(assignment.substr(0, equals));
    const std::string_view text = trim(assignment.substr(equals + 1));
    const SettingInfo* info = find_setting(name);
    if (info == nullptr) return Error{"", unknown_name(name)};
    const std::optional<double> value = parse_value(*info, text);
    if (!value) return Error{info->name, say("found '{}', expected {}", excerpt(text), allowed(*info))};
    // Reports the value as the user wrote it, in degrees for example.
    if (!set_setting(settings, *info, *value))
        return Error{info->name, say("found {}, expected {}", excerpt(text), allowed(*info))};
    return {};
}

std::string setting_text(const MovementSettings& settings, const SettingInfo& info) {
    const double value = get_setting(settings, info);
    if (is_switch(info)) return value != 0.0 ? "on" : "off";
    if (const auto choices = choices_of(info); !choices.empty()) {
        const auto index = static_cast<std::size_t>(value);
        return index < choices.size() ? choices[index].name : to_text(value);
    }
    return to_text(value);
}

}  // namespace slipface
