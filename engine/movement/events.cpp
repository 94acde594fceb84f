#include "slipface/movement/events.h"

#include <algorithm>
#include <bitset>

namespace slipface {

namespace {

struct List {
    std::span<StepEvent> out;
    std::size_t total = 0;

    void add(const StepEvent& event) {
        if (total < out.size()) out[total] = event;
        ++total;
    }
};

StepEvent of_ground(StepEventKind kind, const PlayerState& state, double value) {
    return {kind, state.ground_surface, state.ground_platform, state.ground_face, value};
}

StepEvent of_contact(StepEventKind kind, const StepContact& contact, double value) {
    return {kind, contact.surface, contact.platform, contact.face, value};
}

}  // namespace

std::size_t find_events(const MovementSettings& settings, const PlayerState& before, const PlayerState& after,
                        const StepContacts& contacts, std::span<StepEvent> out) {
    List events{out};
    const auto found = contacts.found();
    if (after.grounded && !before.grounded) {
        double speed = 0.0;
        for (const StepContact& one : found)
            if (one.face == after.ground_face && one.platform == after.ground_platform)
                speed = std::max(speed, one.speed);
        events.add(of_ground(StepEventKind::landed, after, speed));
    }
    if (before.grounded && !after.grounded)
        events.add(of_ground(StepEventKind::left, before, after.velocity.y()));
    for (auto one = found.begin(); one != found.end(); ++one) {
        const auto same = [&](const StepContact& other) {
            return other.surface == one->surface && other.platform == one->platform;
        };
        if (one->surface == default_surface || std::any_of(found.begin(), one, same)) continue;
        double speed = 0.0;
        for (const StepContact& other : found)
            if (same(other)) speed = std::max(speed, other.speed);
        events.add(of_contact(StepEventKind::touched, *one, speed));
    }
    if (after.hazard && !before.hazard) events.add({.kind = StepEventKind::hazard});
    const double feet = before.position.y() - settings.radii.y() + before.ground_rise;
    for (const StepContact& one : found) {
        const double rise = one.point.y() - feet;
        // A step up may end where it began; that is no higher than the skin leaves room for.
        if (one.pass != Pass::step || !(rise > 4.0 * settings.skin)) continue;
        events.add(of_contact(StepEventKind::stepped, one, rise));
    }
    if (after.crushed && !before.crushed) events.add({.kind = StepEventKind::crushed});
    return events.total;
}

}  // namespace slipface
