#include "slipface/sim/lecture_mover.h"

#include <array>
#include <cmath>

namespace slipface {
namespace {

enum class Mistake { none, whole_displacement, normal_times_radii, no_epsilon, no_bounce_scalar };

// The lecture's test solves for the time at which the ellipsoid comes to a triangle: what it has penetrated
// already has no such time, and is missed.
std::optional<Contact> first_contact(const MovementScene& scene, const Vec3& radii, const Vec3& from,
                                     const Vec3& move) {
    std::optional<Contact> contact = sweep_ellipsoid(scene.collision, radii, from, move);
    if (contact && contact->t == 0.0 && overlaps_any(scene.collision, radii, from)) contact.reset();
    return contact;
}

// sweep_ellipsoid() gives the normal of the ellipsoid, that of the unit sphere divided by the radii.
Vec3 times_radii(const Vec3& normal, const Vec3& radii) {
    return normal.cwiseProduct(radii).cwiseProduct(radii).normalized();
}

// V - (1 + e) N (N.V): slides for e = 0, bounces for e > 0.
Vec3 deflect(const Vec3& v, const Vec3& normal, double e) {
    const double into = normal.dot(v);
    return into < 0.0 ? Vec3(v - (1.0 + e) * into * normal) : v;
}

template <Mistake mistake>
StepResult lecture_step(const MovementScene& scene, const MovementSettings& settings,
                        const PlayerState& before, const PlayerInput& input, double dt, TraceSink* trace,
                        StepContacts*) {
    StepResult result{.state = before};
    PlayerState& now = result.state;
    now.grounded = false;
    now.ground_face = no_id;
    now.velocity = {input.wish.x() * settings.walk_speed, before.velocity.y() - settings.gravity * dt,
                    input.wish.y() * settings.walk_speed};
    const Vec3 displacement = now.velocity * dt;
    Vec3 remainder = displacement;
    for (int i = 0; i < settings.max_slides && !remainder.isZero(1e-9); ++i) {
        SweepRecord sweep{.iteration = i, .from = now.position, .move = remainder};
        sweep.contact = first_contact(scene, settings.radii, now.position, remainder);
        ++result.sweeps;
        const std::optional<Contact>& contact = sweep.contact;
        now.position += (contact ? contact->t : 1.0) * remainder;
        if (!contact) {
            remainder.setZero();
        } else {
            if (mistake == Mistake::normal_times_radii)
                sweep.contact->normal = times_radii(contact->normal, settings.radii);
            if (mistake != Mistake::no_epsilon) now.position += settings.skin * contact->normal;
        }
        sweep.reached = now.position = now.position.cast<float>().cast<double>();
        if (trace != nullptr) trace->add(sweep);
        if (!contact) break;
        ++result.contacts;

        const SurfaceType& surface = scene.surfaces[contact->surface];
        double e = settings.bounce ? surface.restitution : 0.0;
        if (mistake == Mistake::no_bounce_scalar && e > 0.0) e = 1.0;
        ResponseRecord response{.rule = e > 0.0 ? Rule::bounce : Rule::slide,
                                .remainder_before = remainder * (1.0 - contact->t),
                                .velocity_before = now.velocity,
                                .normal = contact->normal,
                                .surface = contact->surface,
                                .face = contact->face};
        if (mistake == Mistake::whole_displacement) response.remainder_before = displacement;
        remainder = response.remainder_after = deflect(response.remainder_before, contact->normal, e);
        now.velocity = response.velocity_after = deflect(now.velocity, contact->normal, e);
        if (trace != nullptr) trace->add(response);
        if (contact->normal.y() >= std::cos(settings.max_slope) && e == 0.0) {
            now.grounded = true;
            now.ground_normal = contact->normal;
            now.ground_face = contact->face;
            now.ground_surface = contact->surface;
        }
    }
    if (trace != nullptr && !remainder.isZero(1e-9))
        trace->add(DecisionRecord{.kind = Decision::slides_used_up, .value = remainder.norm()});
    return result;
}

constexpr std::array<NamedMover, 5> movers{{
    {"lecture", "as the lecture has it before its hacks", lecture_step<Mistake::none>},
    {"lecture-whole-displacement", "slides the whole displacement after each contact, not what is left of it",
     lecture_step<Mistake::whole_displacement>},
    {"lecture-times-radii", "multiplies the sphere's normal by the radii instead of dividing",
     lecture_step<Mistake::normal_times_radii>},
    {"lecture-no-epsilon", "does not push the player away after a contact",
     lecture_step<Mistake::no_epsilon>},
    {"lecture-whole-bounce", "reflects the whole speed into a bouncy surface",
     lecture_step<Mistake::no_bounce_scalar>},
}};

}  // namespace

std::span<const NamedMover> lecture_movers() {
    return movers;
}

const NamedMover* find_mover(std::string_view name) {
    for (const NamedMover& mover : movers)
        if (name == mover.name) return &mover;
    return nullptr;
}

}  // namespace slipface
