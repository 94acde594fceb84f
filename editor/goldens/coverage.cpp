#include "goldens/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "slipface/base/counted.h"
#include "slipface/movement/settings.h"

namespace slipface {

namespace {

struct Kind {
    const char* word;
    const char* one;
    const char* several;
};
constexpr std::array kinds{Kind{"setting", "setting", "settings"},
                           Kind{"surface", "member of surface types", "members of surface types"},
                           Kind{"object", "kind of objects", "kinds of objects"},
                           Kind{"type", "type", "types"}};

struct ObjectKind {
    const char* name;
    bool (*there)(const Level&);
};
constexpr std::array objects{
    ObjectKind{"prop", [](const Level& level) { return !level.props.empty(); }},
    ObjectKind{"platform", [](const Level& level) { return !level.platforms.empty(); }},
    ObjectKind{"terrain", [](const Level& level) { return level.terrain != nullptr; }},
    ObjectKind{"baked light", [](const Level& level) { return level.light.has_value(); }}};

// Whether its trace says that it acted. Numbers that decide nothing are used in every run.
bool acts(const SettingInfo& setting) {
    const auto table = decision_table();
    return std::any_of(table.begin(), table.end(), [&](const DecisionInfo& info) {
        return info.outcome == Outcome::acted && std::string_view(info.hack) == setting.name;
    });
}

bool differs(const SurfaceType& type, const SurfaceField& field) {
    static const SurfaceType plain = preset_surface_types().front();
    return std::visit([&](auto member) { return type.*member != plain.*member; }, field.member);
}

}  // namespace

void Coverage::add(const Coverage& other) {
    reached.insert(other.reached.begin(), other.reached.end());
    there.insert(other.there.begin(), other.there.end());
}

void Coverage::add_objects(const Level& level) {
    for (const ObjectKind& object : objects)
        if (object.there(level)) reached.insert(fmt::format("object {}", object.name));
}

void Coverage::add_run(const Level& level, const std::string& place, const MovementSettings& settings,
                       const std::set<Decision>& acted, const std::set<SurfaceId>& touched) {
    for (const Decision decision : acted)
        if (decision_info(decision).outcome == Outcome::acted)
            reached.insert(fmt::format("setting {}", decision_info(decision).hack));
    for (const SettingInfo& setting : settings_table())
        if (is_switch(setting) && !acts(setting) && get_setting(settings, setting) != 0.0)
            reached.insert(fmt::format("setting {}", setting.name));
    const std::vector<SurfaceId> of_faces = resolve_parts(level).own.surface;
    const std::set<SurfaceId> used(of_faces.begin(), of_faces.end());
    for (SurfaceId id = 0; id < level.surfaces.size(); ++id) {
        const SurfaceType& type = level.surfaces[id];
        const std::string word = fmt::format("type {} of {}", type.name, place);
        if (used.contains(id)) there.insert(word);
        if (!touched.contains(id)) continue;
        reached.insert(word);
        for (const SurfaceField& field : surface_fields())
            if (differs(type, field)) reached.insert(fmt::format("surface {}", field.name));
    }
}

std::vector<std::string> not_reached(const Coverage& coverage) {
    std::vector<std::string> words;
    const auto look = [&](const std::string& word) {
        if (!coverage.reached.contains(word)) words.push_back(word);
    };
    for (const SettingInfo& setting : settings_table())
        if (acts(setting) || is_switch(setting)) look(fmt::format("setting {}", setting.name));
    for (const SurfaceField& field : surface_fields())
        look(fmt::format("surface {}", field.name));
    for (const ObjectKind& object : objects)
        look(fmt::format("object {}", object.name));
    for (const std::string& word : coverage.there)
        look(word);
    return words;
}

std::string not_reached_text(const std::vector<std::string>& words) {
    std::string text;
    for (const Kind& kind : kinds) {
        constexpr std::size_t most = 5;
        std::size_t count = 0;
        std::string names;
        for (const std::string& word : words) {
            if (!word.starts_with(std::string(kind.word) + " ")) continue;
            if (++count <= most)
                names += (count > 1 ? ", " : "") + word.substr(std::string(kind.word).size() + 1);
        }
        if (count == 0) continue;
        text += fmt::format("{}{} ({}{})", text.empty() ? "" : ", ", counted(count, kind.one, kind.several),
                            names, count > most ? ", ..." : "");
    }
    return text;
}

}  // namespace slipface
