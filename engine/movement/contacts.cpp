// The contacts of a step for its caller. They lie in the caller's room; a Motion knows how many of them are
// its own, so that a move that is tried and taken back takes its contacts back.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// Of the body in the level, m/s. What presses a player to the ground is no motion.
Vec3 velocity_at_contact(const Mover& mover) {
    Vec3 own = mover.velocity;
    if (mover.state.grounded && !mover.jumped) {
        PlayerState walks = mover.state;
        walks.velocity = own;
        own = motion_velocity(walks);
    }
    return own + frame_velocity(mover);
}

}  // namespace

void begin_contacts(StepContacts* contacts) {
    if (contacts == nullptr) return;
    contacts->count = 0;
    contacts->full = false;
}

void note_contact(Mover& mover, Pass pass, const Contact& contact, std::uint32_t platform) {
    if (mover.report == nullptr) return;
    const Vec3 face = ground_velocity(mover, contact.point, surface_of(mover, contact.surface), platform);
    const double speed = std::max(0.0, (face - velocity_at_contact(mover)).dot(contact.normal));
    const std::span<StepContact> out = mover.report->out;
    for (StepContact& one : out.first(mover.noted)) {
        // The same normal but for what rounding makes of it.
        const bool same = one.face == contact.face && one.platform == platform && one.pass == pass &&
                          one.normal.dot(contact.normal) > 1.0 - 1e-9;
        if (!same) continue;
        one.speed = std::max(one.speed, speed);
        return;
    }
    if (mover.noted == out.size()) {
        mover.report->full = true;
        return;
    }
    out[mover.noted++] = {.point = contact.point,
                          .normal = contact.normal,
                          .face = contact.face,
                          .triangle = contact.triangle,
                          .platform = platform,
                          .surface = contact.surface,
                          .feature = contact.feature,
                          .pass = pass,
                          .speed = speed};
}

void keep_contacts(const Mover& mover) {
    if (mover.report != nullptr) mover.report->count = mover.noted;
}

}  // namespace slipface
