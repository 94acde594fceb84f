// What was done to a tape, and to a row of a suite or a screen's script.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "goldens/acts.h"
#include "slipface/base/counted.h"
#include "slipface/base/text.h"

namespace slipface {

namespace {

// The lines of a tape, by what they say.
struct TapeLines {
    std::map<std::string, std::string> head;  // "start" ...
    std::vector<std::string> settings;        // "set x=y", of the start
    std::vector<std::pair<std::int64_t, std::string>>
        segments;  // ticks and input, with changes of settings as 0 ticks
    std::int64_t ticks = 0;
};

TapeLines lines_of(const Numbers& tape) {
    TapeLines lines;
    for (const Numbers& row : member_of(tape, "lines")) {
        if (!row.is_array() || row.empty() || !row[0].is_string()) continue;
        const std::string line = row[0].get<std::string>();
        const std::size_t space = std::min(line.find(' '), line.size());
        const std::string word = line.substr(0, space), rest = line.substr(std::min(space + 1, line.size()));
        if (const auto ticks = parse_int(word)) {
            lines.segments.emplace_back(*ticks, rest);
            lines.ticks += *ticks;
        } else if (word == "set") {
            if (lines.segments.empty())
                lines.settings.push_back(rest);
            else
                lines.segments.emplace_back(0, line);
        } else {
            lines.head[word] = rest;
        }
    }
    return lines;
}

// The first tick whose input differs, and both inputs.
std::string first_other_input(const TapeLines& a, const TapeLines& b) {
    std::size_t i = 0, k = 0;
    std::int64_t tick = 0, left_a = 0, left_b = 0;
    const auto next = [](const TapeLines& tape, std::size_t& at, std::int64_t& left) {
        while (left == 0 && at < tape.segments.size() && tape.segments[at].first > 0)
            left = tape.segments[at++].first;
    };
    while (true) {
        next(a, i, left_a);
        next(b, k, left_b);
        const bool change_a = left_a == 0 && i < a.segments.size(),
                   change_b = left_b == 0 && k < b.segments.size();
        if (change_a && change_b && a.segments[i] == b.segments[k]) {
            ++i, ++k;
            continue;
        }
        if (change_a || change_b)
            return fmt::format("at tick {}: `{}`{}", tick, (change_b ? b.segments[k] : a.segments[i]).second,
                               change_b ? "" : " is gone");
        if (left_a == 0 || left_b == 0) return "";
        if (a.segments[i - 1].second != b.segments[k - 1].second)
            return fmt::format("from tick {}: `{}` instead of `{}`", tick, b.segments[k - 1].second,
                               a.segments[i - 1].second);
        const std::int64_t both = std::min(left_a, left_b);
        tick += both;
        left_a -= both;
        left_b -= both;
    }
}

std::int64_t area_of(const Numbers& masks) {
    std::int64_t area = 0;
    for (const Numbers& mask : masks)
        if (mask.is_array() && mask.size() == 4)
            area += mask[2].get<std::int64_t>() * mask[3].get<std::int64_t>();
    return area;
}

std::string mask_act(const Numbers& was, const Numbers& is) {
    if (was.empty()) return "a mask was added";
    if (is.empty()) return "the mask was removed";
    const std::int64_t before = area_of(was), after = area_of(is);
    return fmt::format("the mask {}: {} to {} pixels",
                       after > before   ? "grew"
                       : after < before ? "shrank"
                                        : "moved",
                       before, after);
}

Numbers words_of(const Numbers& text) {
    Numbers words = Numbers::array();
    const auto line = text.get<std::string>();
    for (const std::string_view word : split(line, ' '))
        words.push_back(Numbers::array({std::string(word)}));
    return words;
}

// Lines that are on one side only, the first of each.
std::string script_act(const Numbers& was, const Numbers& is, const char* script, const char* line) {
    std::size_t first = 0;
    while (first < std::min(was.size(), is.size()) && was[first] == is[first])
        ++first;
    std::size_t tail = 0;
    while (tail < std::min(was.size(), is.size()) - first &&
           was[was.size() - 1 - tail] == is[is.size() - 1 - tail])
        ++tail;
    const std::size_t gone = was.size() - first - tail, come = is.size() - first - tail;
    const auto text = [](const Numbers& row) { return row[0].get<std::string>(); };
    if (gone == 0) return fmt::format("the {} has another {} `{}`", script, line, text(is[first]));
    if (come == 0) return fmt::format("the {}'s {} `{}` is gone", script, line, text(was[first]));
    return fmt::format("the {}'s {} `{}` became `{}`", script, line, text(was[first]), text(is[first]));
}

}  // namespace

void add_tape_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    const TapeLines a = lines_of(before), b = lines_of(after);
    std::vector<std::string> parts;
    for (const auto& [key, name] : {std::pair("start", "start"), std::pair("dt", "time step"),
                                    std::pair("settings", "base of settings")})
        if (a.head.contains(key) != b.head.contains(key) ||
            (a.head.contains(key) && a.head.at(key) != b.head.at(key)))
            parts.push_back(fmt::format("its {} was {}, is {}", name,
                                        a.head.contains(key) ? a.head.at(key) : "not set",
                                        b.head.contains(key) ? b.head.at(key) : "not set"));
    for (const std::string& setting : b.settings)
        if (std::find(a.settings.begin(), a.settings.end(), setting) == a.settings.end())
            parts.push_back("it sets " + setting);
    for (const std::string& setting : a.settings)
        if (std::find(b.settings.begin(), b.settings.end(), setting) == b.settings.end())
            parts.push_back(fmt::format("it no longer sets {}", setting));
    if (const std::string input = first_other_input(a, b); !input.empty()) parts.push_back(input);
    if (a.ticks != b.ticks)
        parts.push_back(fmt::format("it is {} {}: {} to {} ticks",
                                    counted(static_cast<std::size_t>(std::abs(b.ticks - a.ticks)), "tick"),
                                    b.ticks > a.ticks ? "longer" : "shorter", a.ticks, b.ticks));
    if (parts.empty() && member_of(before, "hash") != member_of(after, "hash"))
        parts.emplace_back("its inputs");
    std::string text;
    for (const std::string& part : parts)
        text += (text.empty() ? "" : "; ") + part;
    if (!text.empty()) acts.push_back({ActKind::input, "the tape changed: " + text});
}

std::vector<Act> file_acts(const Numbers& before, const Numbers& after) {
    std::vector<Act> acts;
    for (const auto& [name, hash] : before.items())
        if (const Numbers& now = member_of(after, name); now != hash)
            acts.push_back(
                {ActKind::input, fmt::format("the file {} {}", name, now.is_null() ? "is gone" : "changed")});
    for (const auto& [name, hash] : after.items())
        if (member_of(before, name).is_null())
            acts.push_back({ActKind::input, fmt::format("the file {} is new", name)});
    return acts;
}

void add_row_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    std::set<std::string> keys;
    for (const Numbers* side : {&before, &after})
        for (const auto& [key, value] : side->items())
            keys.insert(key);
    const auto say = [&](std::string text) { acts.push_back({ActKind::input, std::move(text)}); };
    for (const std::string& key : keys) {
        const Numbers &was = member_of(before, key), &is = member_of(after, key);
        if (was == is) continue;
        if (key == "masks") {
            say(mask_act(was, is));
        } else if (key == "script" && was.is_array() && is.is_array()) {
            say(script_act(was, is, "script", "line"));
        } else if (key == "command" && was.is_string() && is.is_string()) {
            say(script_act(words_of(was), words_of(is), "command", "word"));
        } else if (key == "camera" && was.is_object() && is.is_object()) {
            const double moved = distance_moved(member_of(was, "eye"), member_of(is, "eye"));
            say(moved > 0.0 ? fmt::format("the camera of the suite moved {:.3g} m", moved)
                            : "the camera of the suite: " + changed_members(was, is));
        } else {
            say(fmt::format("the row's {}: {}", key, changed_members(was, is)));
        }
    }
}

}  // namespace slipface
