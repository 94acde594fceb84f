#include "json_movement.h"

namespace slipface {

namespace {

void read_setting(const JsonNode& node, const SettingInfo& info, MovementSettings& settings) {
    double value = 0.0;
    Status status;
    if (is_switch(info)) {
        bool flag = false;
        if (!node.boolean(flag)) return;
        status = set_setting(settings, info, flag ? 1.0 : 0.0);
    } else if (std::holds_alternative<int MovementSettings::*>(info.member)) {
        int whole = 0;
        if (!node.integer(static_cast<int>(info.minimum), static_cast<int>(info.maximum), whole)) return;
        status = set_setting(settings, info, whole);
    } else if (is_choice(info)) {
        std::string choice;
        if (!node.text(choice)) return;
        status = set_setting(settings, std::string(info.name) + "=" + choice);
    } else if (node.number(info.minimum, info.maximum, value)) {
        status = set_setting(settings, info, value);
    }
    if (!status) node.fail(status.error());
}

}  // namespace

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

void read_settings(const JsonNode& node, MovementSettings& settings) {
    if (!node.object()) return;
    for (const SettingInfo& info : settings_table())
        read_setting(node[info.name], info, settings);
}

}  // namespace slipface
