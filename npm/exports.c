/* What index.js needs beside slipface.h: where the members of its structs lie in this build's memory, and a way for a filter to
 * call JavaScript. */
#include <slipface.h>
#include <stddef.h>

#define AT(type, member) {#type "." #member, offsetof(slipface_##type, member)}
#define SIZE(type) {#type, sizeof(slipface_##type)}
static const struct {
    const char* name;
    uint32_t bytes;
} layout[] = {
    SIZE(error),
    AT(error, text),
    SIZE(triangles),
    AT(triangles, size),
    AT(triangles, positions),
    AT(triangles, position_count),
    AT(triangles, indices),
    AT(triangles, triangle_count),
    AT(triangles, types),
    AT(triangles, groups),
    SIZE(filter),
    AT(filter, mask),
    AT(filter, groups),
    AT(filter, ignored_type_count),
    AT(filter, ignored_types),
    AT(filter, sees),
    AT(filter, user),
    SIZE(sweep),
    SIZE(contact),
    AT(contact, t),
    AT(contact, normal),
    AT(contact, point),
    AT(contact, triangle),
    AT(contact, face),
    AT(contact, type),
    AT(contact, platform),
    AT(contact, feature),
    AT(contact, pass),
    AT(contact, speed),
    SIZE(ray_hit),
    AT(ray_hit, t),
    AT(ray_hit, normal),
    AT(ray_hit, point),
    AT(ray_hit, triangle),
    AT(ray_hit, face),
    AT(ray_hit, platform),
    AT(ray_hit, back),
    SIZE(closest),
    AT(closest, distance),
    AT(closest, point),
    AT(closest, triangle),
    AT(closest, face),
    AT(closest, platform),
    SIZE(overlap),
    AT(overlap, point),
    AT(overlap, normal),
    AT(overlap, depth),
    AT(overlap, triangle),
    AT(overlap, face),
    AT(overlap, type),
    AT(overlap, platform),
    SIZE(input),
    AT(input, buttons),
    AT(input, wish_x),
    AT(input, wish_z),
    SIZE(player),
    AT(player, flags),
    AT(player, position),
    AT(player, velocity),
    AT(player, ground_normal),
    AT(player, ground_face),
    AT(player, ground_platform),
    AT(player, ground_type),
    SIZE(event),
    AT(event, kind),
    AT(event, type),
    AT(event, platform),
    AT(event, face),
    AT(event, value),
    SIZE(report),
    AT(report, contact_room),
    AT(report, contacts),
    AT(report, contact_count),
    AT(report, events),
    AT(report, event_room),
    AT(report, event_count),
    SIZE(setting),
    AT(setting, name),
    AT(setting, label),
    AT(setting, group),
    AT(setting, unit),
    AT(setting, meaning),
    AT(setting, minimum),
    AT(setting, maximum),
    AT(setting, initial),
    AT(setting, kind),
    {NULL, 0},
};

SLIPFACE_API const void* slipface_js_layout(void) {
    return layout;
}

/* The function of the filter whose number is `user`. */
__attribute__((import_module("slipface"), import_name("sees"))) int slipface_js_sees(uint32_t user, uint32_t platform,
                                                                                     uint32_t triangle);

static int sees(void* user, uint32_t platform, uint32_t triangle) {
    return slipface_js_sees((uint32_t)(uintptr_t)user, platform, triangle);
}

SLIPFACE_API void slipface_js_ask(slipface_filter* filter, uint32_t number) {
    filter->sees = sees;
    filter->user = (void*)(uintptr_t)number;
}
