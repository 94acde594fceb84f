#include "goldens/acts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "goldens/level_facts.h"
#include "slipface/base/counted.h"
#include "slipface/base/text.h"
#include "slipface/movement/settings.h"

namespace slipface {

namespace {

std::string shown(const Numbers& value) {
    if (value.is_null()) return "not set";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_string()) return value.get<std::string>();
    return value.dump(-1, ' ', false, Numbers::error_handler_t::replace);
}

void collect(const Numbers& a, const Numbers& b, const std::string& name, std::vector<std::string>& out) {
    if (a == b) return;
    const auto inside = [&](const std::string& key) { return name.empty() ? key : name + " " + key; };
    if (a.is_object() && b.is_object()) {
        for (const auto& [key, value] : a.items())
            collect(value, member_of(b, key), inside(key), out);
        for (const auto& [key, value] : b.items())
            if (!a.contains(key)) collect({}, value, inside(key), out);
        return;
    }
    const bool plain = !a.is_array() || a.empty() || !a[0].is_structured();
    if (a.is_array() && b.is_array() && !plain && a.size() == b.size()) {
        for (std::size_t i = 0; i < a.size(); ++i)
            collect(a[i], b[i], inside(std::to_string(i + 1)), out);
        return;
    }
    out.push_back(fmt::format("{} was {}, is {}", name.empty() ? "it" : name, shown(a), shown(b)));
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
        text += (text.empty() ? "" : "; ") + part;
    return text;
}

// All stops of a path that differ only in the same speed; empty: it is something else.
std::string slower(const Numbers& a, const Numbers& b) {
    if (!a.is_array() || !b.is_array() || a.size() != b.size() || a.empty()) return "";
    std::set<std::pair<double, double>> speeds;
    for (std::size_t i = 0; i < a.size(); ++i) {
        Numbers was = a[i], is = b[i];
        if (!member_of(was, "speed").is_number() || !member_of(is, "speed").is_number()) return "";
        speeds.emplace(was["speed"].get<double>(), is["speed"].get<double>());
        was.erase("speed");
        is.erase("speed");
        if (was != is) return "";
    }
    if (speeds.size() != 1) return "";
    const auto [was, is] = *speeds.begin();
    return fmt::format("is {}: {} to {} m/s", is < was ? "slower" : "faster", was, is);
}

// What happened to a named thing: "moved 1 m; its scale ...". The rest of its members are listed.
std::string what_happened(Numbers a, Numbers b) {
    std::vector<std::string> parts;
    const auto take = [&](const char* key, const std::string& text) {
        if (text.empty() || member_of(a, key) == member_of(b, key)) return;
        parts.push_back(text);
        a.erase(key);
        b.erase(key);
    };
    for (const char* key : {"position", "eye"})
        if (const double moved = distance_moved(member_of(a, key), member_of(b, key)); moved > 0.0)
            take(key, fmt::format("moved {:.3g} m", moved));
    if (member_of(a, "yaw").is_number() && member_of(b, "yaw").is_number())
        take("yaw",
             fmt::format("turned by {:.3g} degrees",
                         std::abs(b["yaw"].get<double>() - a["yaw"].get<double>()) * 57.29577951308232));
    take("path", slower(member_of(a, "path"), member_of(b, "path")));
    const auto changed = [&](const char* key, const char* word) {
        take(key, fmt::format("{}: {} was {}, is {}", word, key, shown(member_of(a, key)),
                              shown(member_of(b, key))));
    };
    changed("rotation", "was turned");
    changed("scale", "was scaled");
    if (const std::string rest = changed_members(a, b); !rest.empty())
        parts.push_back(parts.empty() ? ": " + rest : rest);
    const std::string text = joined(parts);
    return text.starts_with(":") ? text : " " + text;
}

struct Noun {
    const char* key;
    const char* one;
};
constexpr std::array nouns{Noun{"props", "prop"},   Noun{"platforms", "platform"}, Noun{"surfaces", "type"},
                           Noun{"rules", "rule"},   Noun{"cameras", "camera"},     Noun{"goals", "goal"},
                           Noun{"spawns", "spawn"}, Noun{"materials", "material"}};

const char* noun_of(const std::string& key) {
    const auto found = std::find_if(nouns.begin(), nouns.end(), [&](const Noun& n) { return key == n.key; });
    return found == nouns.end() ? nullptr : found->one;
}

void add_named(const Numbers& a, const Numbers& b, const char* noun, std::vector<Act>& acts) {
    std::set<std::string> used;
    for (const auto& [name, was] : a.items()) {
        const Numbers& is = member_of(b, name);
        if (is == was) continue;
        if (!is.is_null()) {
            acts.push_back({ActKind::input, fmt::format("{} `{}`{}", noun, name, what_happened(was, is))});
            continue;
        }
        std::string text = "was removed";
        for (const auto& [other, value] : b.items())
            if (value == was && !a.contains(other) && used.insert(other).second) {
                text = fmt::format("was renamed `{}`", other);
                break;
            }
        acts.push_back({ActKind::input, fmt::format("{} `{}` {}", noun, name, text)});
    }
    for (const auto& [name, is] : b.items())
        if (!a.contains(name) && !used.contains(name))
            acts.push_back({ActKind::input, fmt::format("{} `{}` was added", noun, name)});
}

// Settings that an older program did not know had the value that changes nothing.
void add_settings(Numbers a, const Numbers& b, std::vector<Act>& acts) {
    static const Numbers basic = [] {
        Numbers json = Numbers::object();
        const MovementSettings settings = basic_settings();
        for (const SettingInfo& info : settings_table())
            json[info.name] = setting_text(settings, info);
        return json;
    }();
    for (const auto& [name, value] : b.items()) {
        if (a.contains(name) || !basic.contains(name)) continue;
        const std::string text = basic[name].get<std::string>();
        const bool same = value.is_boolean()  ? value.get<bool>() == (text == "on" || text == "true")
                          : value.is_number() ? parse_double(text) == std::optional(value.get<double>())
                                              : value == text;
        if (same) a[name] = value;
    }
    if (const std::string text = changed_members(a, b); !text.empty())
        acts.push_back({ActKind::input, "setting " + text});
}

void add_terrain(const Numbers& a, const Numbers& b, bool placed, std::vector<Act>& acts) {
    if (a == b || a.is_null() || b.is_null() || placed) return;  // then the members say it
    if (member_of(a, "hash") == member_of(b, "hash") && member_of(a, "columns") == member_of(b, "columns"))
        return;
    const std::vector<double> was = terrain_heights(a), is = terrain_heights(b);
    std::size_t count = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i) {
        if (was[i] == is[i]) continue;
        ++count;
        largest = std::max(largest, std::abs(is[i] - was[i]));
    }
    std::string text = "the heights of the terrain changed";
    if (was.size() != is.size())
        text = fmt::format("the terrain has {} x {} heights instead of {} x {}",
                           shown(member_of(b, "columns")), shown(member_of(b, "rows")),
                           shown(member_of(a, "columns")), shown(member_of(a, "rows")));
    else if (count > 0)
        text = fmt::format("{} of the terrain changed by {}{:.3g} m",
                           count == 1 ? "one height" : counted(count, "height"), count == 1 ? "" : "up to ",
                           largest);
    acts.push_back({ActKind::input, text});
}

void add_level_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    add_member_acts(member_of(before, "members"), member_of(after, "members"), acts);
    add_geometry_acts(before, after, acts);
    add_named(member_of(before, "materials"), member_of(after, "materials"), "material", acts);
    const Numbers &was = member_of(before, "pictures"), &is = member_of(after, "pictures");
    for (const auto& [name, hash] : was.items())
        if (const Numbers& now = member_of(is, name); !now.is_null() && now != hash)
            acts.push_back({ActKind::input, now == "missing" ? fmt::format("the texture {} is missing", name)
                                                             : fmt::format("the texture {} changed", name)});
    for (const auto& [name, hash] : is.items())
        if (was.is_object() && !was.contains(name))
            acts.push_back({ActKind::effect, fmt::format("the texture {} is new", name)});
    add_named(member_of(before, "painted"), member_of(after, "painted"), "the paint of prop", acts);
    add_terrain(member_of(before, "terrain"), member_of(after, "terrain"),
                member_of(member_of(before, "members"), "heightfield") !=
                    member_of(member_of(after, "members"), "heightfield"),
                acts);
    if (member_of(before, "light_fits") != member_of(after, "light_fits"))
        acts.push_back(
            {ActKind::effect, member_of(after, "light_fits") == true
                                  ? "the baked light fits the geometry again"
                                  : "the baked light is not drawn, because it was baked for other geometry; "
                                    "bake it again with \"slipface bake-light\""});
    const Numbers &warned = member_of(before, "warnings"), &warns = member_of(after, "warnings");
    for (const Numbers& warning : warns)
        if (std::find(warned.begin(), warned.end(), warning) == warned.end())
            acts.push_back({ActKind::effect, "a new warning: " + shown(warning[0])});
    for (const Numbers& warning : warned)
        if (std::find(warns.begin(), warns.end(), warning) == warns.end())
            acts.push_back({ActKind::effect, "a warning less: " + shown(warning[0])});
}

// Whether what both lists have stands in another order.
bool reordered(const Numbers& a, const Numbers& b) {
    const auto kept = [](const Numbers& list, const Numbers& other) {
        const std::set<Numbers> there(other.begin(), other.end());
        std::vector<Numbers> common;
        for (const Numbers& item : list)
            if (there.contains(item)) common.push_back(item);
        return common;
    };
    return a != b && kept(a, b) != kept(b, a);
}

bool faces_reordered(const Numbers& a, const Numbers& b) {
    for (const auto& [name, was] : a.items()) {
        const Numbers& is = member_of(b, name);
        if (member_of(was, "hash") == member_of(is, "hash") &&
            member_of(was, "order") != member_of(is, "order"))
            return true;
    }
    return false;
}

void add_order(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    std::string names;
    const auto say = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
    bool faces = faces_reordered(member_of(before, "objects"), member_of(after, "objects"));
    for (const auto& [file, objects] : member_of(before, "meshes").items())
        faces = faces || faces_reordered(objects, member_of(member_of(after, "meshes"), file));
    if (faces) say("faces");
    for (const auto& [key, list] : member_of(before, "order").items())
        if (reordered(list, member_of(member_of(after, "order"), key)))
            say(key == "surfaces" ? std::string("types") : key);
    if (!names.empty()) acts.push_back({ActKind::order, fmt::format("only the order of {} changed", names)});
}

}  // namespace

const Numbers& member_of(const Numbers& json, std::string_view key) {
    static const Numbers none;
    if (!json.is_object()) return none;
    const auto found = json.find(std::string(key));
    return found == json.end() ? none : *found;
}

double distance_moved(const Numbers& before, const Numbers& after) {
    double sum = 0.0;
    if (!before.is_array() || !after.is_array() || before.size() != 3 || after.size() != 3) return 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!before[i].is_number() || !after[i].is_number()) return 0.0;
        const double d = after[i].get<double>() - before[i].get<double>();
        sum += d * d;
    }
    return std::sqrt(sum);
}

std::string changed_members(const Numbers& before, const Numbers& after) {
    std::vector<std::string> parts;
    collect(before, after, "", parts);
    return joined(parts);
}

void add_member_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    std::set<std::string> keys;
    for (const Numbers* side : {&before, &after})
        for (const auto& [key, value] : side->items())
            keys.insert(key);
    for (const std::string& key : keys) {
        const Numbers &was = member_of(before, key), &is = member_of(after, key);
        if (was == is) continue;
        if (key == "movement") {
            add_settings(was, is, acts);
        } else if (const char* noun = noun_of(key)) {
            add_named(was.is_object() ? was : Numbers::object(), is.is_object() ? is : Numbers::object(),
                      noun, acts);
        } else {
            const std::string name = key == "heightfield"  ? "the terrain"
                                     : key == "fall_limit" ? "the fall limit"
                                                           : "the level's " + key;
            if (was.is_object() && is.is_object())
                acts.push_back(
                    {ActKind::input, (key == "spawn" ? "the spawn" : name) + what_happened(was, is)});
            else if (was.is_structured() || is.is_structured())
                acts.push_back({ActKind::input, name + (was.is_null()  ? " was added"
                                                        : is.is_null() ? " was removed"
                                                                       : " changed")});
            else
                acts.push_back(
                    {ActKind::input, fmt::format("{} was {}, is {}", name, shown(was), shown(is))});
        }
    }
}

std::vector<Act> acts_between(const Numbers& before, const Numbers& after) {
    std::vector<Act> acts;
    const Numbers& kind = member_of(after, "kind");
    if (kind == "level")
        add_level_acts(before, after, acts);
    else if (kind == "tape")
        add_tape_acts(before, after, acts);
    else
        add_row_acts(before, after, acts);
    add_order(before, after, acts);
    std::stable_sort(acts.begin(), acts.end(), [](const Act& a, const Act& b) { return a.kind < b.kind; });
    return acts;
}

}  // namespace slipface
