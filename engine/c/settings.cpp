#include "calls.h"
#include "slipface/base/version.h"
#include "slipface/level/preset.h"

using namespace slipface;
using namespace slipface::c;

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
            const Result<Preset> found = find_preset(preset);
            if (!found) refuse(SLIPFACE_CANNOT_READ, found.error());
            made->values = found->settings;
        }
        const std::uint64_t id = new_handle(Kind::settings, std::move(made));
        if (id == 0) refuse(SLIPFACE_NO_MEMORY, "too many worlds and settings, expected at most 65536");
        settings->id = id;
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
        const SettingInfo* const info = find_setting(name);
        if (info == nullptr) refuse(SLIPFACE_WRONG_ARGUMENT, "found no setting \"{}\"", name);
        *value = get_setting(read->values, *info);
    });
}
