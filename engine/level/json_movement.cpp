#include "json_movement.h"

namespace slipface {

namespace {

void read_setting(JsonReader& reader, const Json& json, const std::string& path, const SettingInfo& info,
                  MovementSettings& settings) {
    double value = 0.0;
    Status status;
    if (is_switch(info)) {
        bool flag = false;
        if (!reader.boolean(json, path, flag)) return;
        value = flag ? 1.0 : 0.0;
    } else if (std::holds_alternative<int MovementSettings::*>(info.member)) {
        int whole = 0;
        if (!reader.integer(json, path, static_cast<int>(info.minimum), static_cast<int>(info.maximum),
                            whole))
            return;
        value = whole;
    } else if (is_choice(info)) {
        std::string choice;
        if (!reader.text(json, path, choice)) return;
        status = set_setting(settings, std::string(info.name) + "=" + choice);
        if (!status.ok()) reader.fail(Error{reader.location(path), status.error().message});
        return;
    } else if (!reader.number(json, path, info.minimum, info.maximum, value)) {
        return;
    }
    status = set_setting(settings, info, value);
    if (!status.ok()) reader.fail(Error{reader.location(path), status.error().message});
}

}  // namespace

std::set<std::string_view> setting_names() {
    std::set<std::string_view> names;
    for (const SettingInfo& info : settings_table())
        names.insert(info.name);
    return names;
}

Json settings_json(const MovementSettings& settings) {
    Json json = json_object();
    for (const SettingInfo& info : settings_table()) {
        const double value = get_setting(settings, info);
        if (is_switch(info)) {
            json_add(json, info.name, json_bool(value != 0.0));
        } else if (std::holds_alternative<int MovementSettings::*>(info.member)) {
            json_add(json, info.name, json_number(static_cast<std::int64_t>(value)));
        } else if (is_choice(info)) {
            json_add(json, info.name, json_string(setting_text(settings, info)));
        } else {
            json_add(json, info.name, json_number(value));
        }
    }
    return json;
}

void read_settings(JsonReader& reader, const Json& json, const std::string& path,
                   MovementSettings& settings) {
    if (!reader.object(json, path)) return;
    for (const SettingInfo& info : settings_table()) {
        const Json* value = json.find(info.name);
        if (value != nullptr && reader.ok())
            read_setting(reader, *value, path + "/" + info.name, info, settings);
    }
}

}  // namespace slipface
