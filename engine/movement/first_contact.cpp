#include "slipface/movement/first_contact.h"

namespace slipface {

std::optional<Contact> first_contact(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                                     const Vec3& move) {
    std::optional<Contact> first = sweep_ellipsoid(scene.collision, radii, from, move);
    for (const MovingPart& part : scene.platforms) {
        const std::optional<Contact> contact = sweep_ellipsoid(*part.collision, radii, from, move);
        if (contact && (!first || contact->t < first->t)) first = contact;
    }
    return first;
}

std::size_t crowd_in(const MovementScene& scene, const Aabb& box) {
    std::size_t crowd = scene.collision.crowd_in(box);
    for (const MovingPart& part : scene.platforms)
        crowd += part.collision->crowd_in(box);
    return crowd;
}

}  // namespace slipface
