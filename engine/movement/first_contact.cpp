#include "slipface/movement/first_contact.h"

namespace slipface {

std::optional<Contact> first_contact(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                                     const Vec3& move) {
    std::optional<Contact> first =
        sweep_ellipsoid(scene.collision, radii, from, move, filter_of(scene, no_id));
    for (std::uint32_t i = 0; i < scene.platforms.size(); ++i) {
        const std::optional<Contact> contact =
            sweep_ellipsoid(scene.platforms[i].at_end(), radii, from, move, filter_of(scene, i));
        if (contact && (!first || contact->t < first->t)) first = contact;
    }
    return first;
}

namespace {

// The box in the space of what the pose moves that holds all of `box`.
Aabb as_seen_at_rest(const Pose& pose, const Aabb& box) {
    const Vec3 middle = pose.undo(0.5 * (box.min + box.max)), half = 0.5 * (box.max - box.min);
    Vec3 reach;
    for (int axis = 0; axis < 3; ++axis)
        reach[axis] = pose.columns[static_cast<std::size_t>(axis)].cwiseAbs().dot(half);
    return {middle - reach, middle + reach};
}

}  // namespace

std::size_t crowd_in(const MovementScene& scene, const Aabb& box) {
    std::size_t crowd = scene.collision.crowd_in(box);
    for (const MovingPart& part : scene.platforms)
        crowd += part.rest->crowd_in(as_seen_at_rest(part.end, box));
    return crowd;
}

}  // namespace slipface
