#include "calls.h"
#include "slipface/base/version.h"
#include "slipface/movement/preset.h"

using namespace slipface;
using namespace slipface::c;

namespace {

const SettingInfo& setting_named(const char* name) {
    const SettingInfo* const info = find_setting(name);
    if (info == nullptr) refuse(SLIPFACE_WRONG_ARGUMENT, "found no setting \"{}\"", name);
    return *info;
}

const SettingInfo& setting_of(std::uint32_t number) {
    const auto table = settings_table();
    if (number >= table.size())
        refuse(SLIPFACE_WRONG_ARGUMENT, "found the setting {}, expected one below {}", number, table.size());
    return table[number];
}

}  // namespace

uint32_t slipface_interface(void) {
    return SLIPFACE_INTERFACE;
}

const char* slipface_version(void) {
    return program_version();
}

slipface_status slipface_settings_new(const char* preset, slipface_settings* settings,
                                      slipface_error* error) {
    return run(error, [&] {
        need("settings", settings);
        auto made = std::make_unique<Settings>();
        if (preset != nullptr) {
            const auto& shipped = shipped_presets();
            std::string names;
            for (const ShippedPreset& one : shipped)
                names += (names.empty() ? "" : ", ") + std::string(one.id);
            const auto found = std::ranges::find(shipped, std::string_view(preset), &ShippedPreset::id);
            if (found == shipped.end())
                refuse(SLIPFACE_WRONG_ARGUMENT, "found no preset \"{}\", expected one of {}", preset, names);
            made->values = found->preset.settings;
        }
        settings->id = handle_of(Kind::settings, std::move(made));
    });
}

slipface_status slipface_settings_free(slipface_settings settings, slipface_error* error) {
    return run(error, [&] {
        const slipface_status status = free_handle(Kind::settings, settings.id);
        if (status != SLIPFACE_OK) (void)ChangedSettings(settings.id), refuse(status, "in use");
    });
}

slipface_status slipface_settings_set(slipface_settings settings, const char* assignment,
                                      slipface_error* error) {
    return run(error, [&] {
        need("assignment", assignment);
        const ChangedSettings changed(settings.id);
        if (const Status status = set_setting(changed->values, assignment); !status)
            refuse(SLIPFACE_WRONG_ARGUMENT, status.error());
    });
}

slipface_status slipface_settings_get(slipface_settings settings, const char* name, double* value,
                                      slipface_error* error) {
    return run(error, [&] {
        need("name and value", name, value);
        const SharedSettings read(settings.id);
        *value = get_setting(read->values, setting_named(name));
    });
}

uint32_t slipface_setting_count(void) {
    return static_cast<uint32_t>(settings_table().size());
}

slipface_status slipface_setting_find(const char* name, uint32_t* number, slipface_error* error) {
    return run(error, [&] {
        need("name and number", name, number);
        *number = static_cast<uint32_t>(&setting_named(name) - settings_table().data());
    });
}

slipface_status slipface_setting_at(uint32_t number, slipface_setting* setting, slipface_error* error) {
    return run(error, [&] {
        need("setting", setting);
        const SettingInfo& info = setting_of(number);
        slipface_setting made{};
        made.name = info.name;
        made.label = info.label;
        made.group = info.group;
        made.unit = info.unit;
        made.meaning = info.meaning;
        made.minimum = info.minimum;
        made.maximum = info.maximum;
        made.initial = get_setting(MovementSettings{}, info);
        made.kind = is_switch(info)                                                ? SLIPFACE_SWITCH
                    : is_choice(info)                                              ? SLIPFACE_CHOICE
                    : std::holds_alternative<int MovementSettings::*>(info.member) ? SLIPFACE_WHOLE
                                                                                   : SLIPFACE_NUMBER;
        *setting = made;
    });
}

slipface_status slipface_settings_set_number(slipface_settings settings, uint32_t number, double value,
                                             slipface_error* error) {
    return run(error, [&] {
        const SettingInfo& info = setting_of(number);
        const ChangedSettings changed(settings.id);
        if (const Status status = set_setting(changed->values, info, value); !status)
            refuse(SLIPFACE_WRONG_ARGUMENT, status.error());
    });
}

slipface_status slipface_settings_get_number(slipface_settings settings, uint32_t number, double* value,
                                             slipface_error* error) {
    return run(error, [&] {
        need("value", value);
        const SettingInfo& info = setting_of(number);
        *value = get_setting(SharedSettings(settings.id)->values, info);
    });
}
