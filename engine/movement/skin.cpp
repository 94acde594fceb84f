// Preserves a distance of `skin` metres between the player and what it touched.
//
// The lecture pushes the player away along the normal after every contact, and warns that the push may lead
// into another face. Stopping the sweep early gives the same distance without that danger: the centre stays
// on a path that was swept. Only a player that is already closer than the skin is pushed, and only as far as
// a sweep of the push is free.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// A skin that is smaller by this fraction is not worth a push. Rounding is far below it.
constexpr double tolerated = 1e-3;

// A move that ends at the skin but for this fraction of it ends in a contact. Round numbers often meet there:
// a jump that lasts a whole number of ticks lands in the same one wherever it is, whatever rounding does.
constexpr double tie = 1e-6;

// By `missing` along the normal, so that the skin is kept. Between two faces that are
// closer than two skins the middle is the best position.
Vec3 push_off(Mover& mover, const Vec3& from, const Vec3& normal, double missing, FaceId face) {
    const double skin = mover.settings.skin, length = missing + skin;
    const std::optional<SceneContact> found = sweep_scene(mover, from, normal * length);
    const std::optional<Contact> beyond = found ? std::optional(found->contact) : std::nullopt;
    const double kept = std::max(0.0, skin - missing);  // of a player that is deeper inside, nothing
    const double push = beyond ? std::clamp(0.5 * (beyond->t * length - kept), 0.0, missing) : missing;
    const Vec3 reached = from + normal * push;
    if (mover.trace != nullptr) {
        mover.trace->add(SweepRecord{.pass = Pass::probe,
                                     .from = from,
                                     .move = normal * length,
                                     .reached = reached,
                                     .contact = beyond});
        decide(mover, push < missing ? Decision::pushed_off_halfway : Decision::pushed_off,
               {.value = push, .limit = skin}, face);
    }
    return reached;
}

}  // namespace

Swept sweep_with_skin(Mover& mover, Pass pass, int iteration, const Vec3& move) {
    const double skin = mover.settings.skin;
    const double length = move.norm();
    const Vec3 direction = direction_of(move);
    const double reach = length + look_ahead * skin;

    Swept swept{.reached = mover.position + move};
    double depth = 0.0;
    bool back = false;
    if (const std::optional<SceneContact> found = sweep_scene(mover, mover.position, direction * reach)) {
        swept.contact = found->contact;
        depth = found->depth;
        back = found->back;
        swept.triangle = found->triangle;
        swept.platform = found->platform;
    }

    double missing = 0.0;
    if (swept.contact) {
        const double into = -swept.contact->normal.dot(direction);
        const double distance = swept.contact->t * reach;
        const double stop = into > 0.0 ? distance - skin / into : 0.0;
        if (stop >= length + tie * skin) {
            swept.contact.reset();
        } else {
            const double made = std::clamp(stop, 0.0, length);
            missing = depth + skin - (distance - made) * std::max(into, 0.0);
            swept.used = made / length;
            swept.reached = mover.position + direction * made;
            swept.contact->t = std::min(distance / length, 1.0);
        }
    }
    if (mover.trace != nullptr) {
        mover.trace->add(SweepRecord{.pass = pass,
                                     .iteration = iteration,
                                     .from = mover.position,
                                     .move = move,
                                     .reached = swept.reached,
                                     .contact = swept.contact,
                                     .back = swept.contact && back,
                                     .platform = swept.platform});
    }
    if (swept.contact && missing > tolerated * skin) {
        swept.reached = push_off(mover, swept.reached, swept.contact->normal, missing, swept.contact->face);
    }
    return swept;
}

}  // namespace slipface
