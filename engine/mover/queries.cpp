// Queries of the static world and of its platforms: each collision world is asked, and the first answer
// counts.
#include <algorithm>

#include "calls.h"
#include "slipface/base/parallel.h"

using namespace slipface;
using namespace slipface::c;

namespace slipface::c {

slipface_contact no_contact() {
    slipface_contact none{};
    none.t = 2.0;
    none.triangle = none.face = none.platform = SLIPFACE_NONE;
    return none;
}

slipface_contact contact_of(const Contact& contact, std::uint32_t platform,
                            std::span<const TriangleId> numbers) {
    slipface_contact made{};
    made.t = contact.t;
    made.normal = vec(contact.normal);
    made.point = vec(contact.point);
    made.triangle = contact.triangle < numbers.size() ? numbers[contact.triangle] : contact.triangle;
    made.face = contact.face;
    made.type = contact.surface;
    made.platform = platform;
    made.feature = static_cast<std::uint32_t>(contact.feature);
    return made;
}

Seen::Seen(const World& in, const slipface_filter* filter) : in_(in) {
    if (filter == nullptr) return;
    asked_ = taken(*filter, "filter");
    filter_.mask = asked_.mask;
    filter_.groups = asked_.groups;
    if (asked_.ignored_type_count > 0) need("ignored_types", asked_.ignored_types);
    for (std::size_t i = 0; i < asked_.ignored_type_count; ++i)
        filter_.ignored[asked_.ignored_types[i]] = true;
    if (asked_.sees != nullptr) {
        filter_.ask = [](void* user, std::uint32_t platform, TriangleId triangle) {
            const Seen& seen = *static_cast<const Seen*>(user);
            const MovementScene& scene = *seen.in_.now;
            const auto numbers =
                platform < scene.platforms.size() ? scene.platforms[platform].triangles : scene.triangles;
            return seen.asked_.sees(seen.asked_.user, platform,
                                    triangle < numbers.size() ? numbers[triangle] : triangle) != 0;
        };
        filter_.user = this;
    }
    filtered_.emplace(*in.now).filter = &filter_;
}

}  // namespace slipface::c

namespace {

// A collision world among those that a query asks.
struct Body {
    PosedWorld world;
    std::uint32_t platform;               // SLIPFACE_NONE: what does not move
    std::span<const TriangleId> numbers;  // [triangle] its number in the level; empty: the same
    QueryFilter filter;
};

class Bodies {
  public:
    Bodies(const World& in, const slipface_filter* filter) : seen_(in, filter) {}
    bool plain() const { return seen_.filter() == nullptr && seen_.scene().platforms.empty(); }

    template <class Each>
    void each(const Each& body) const {
        const MovementScene& scene = seen_.scene();
        body(Body{PosedWorld(scene.collision), SLIPFACE_NONE, scene.triangles, filter_of(scene, no_id)});
        for (std::uint32_t i = 0; i < scene.platforms.size(); ++i) {
            const MovingPart& part = scene.platforms[i];
            body(Body{part.at_end(), i, part.triangles, filter_of(scene, i)});
        }
    }

  private:
    Seen seen_;
};

slipface_sweep checked(const slipface_sweep& sweep) {
    positive(sweep.radii, "radii");
    finite(sweep.from, "from");
    finite(sweep.move, "move");
    return sweep;
}

void check_ray(const slipface_vec3& origin, const slipface_vec3& direction, double max_t) {
    finite(origin, "origin");
    if (finite(direction, "direction").isZero(0.0))
        refuse(SLIPFACE_WRONG_ARGUMENT, "direction: found (0, 0, 0), expected a direction");
    distance(max_t, "max_t");
}

// `own` first; of equal t the static world, then the first platform.
slipface_contact first_contact(const Bodies& bodies, const slipface_sweep& sweep) {
    slipface_contact first = no_contact();
    bodies.each([&](const Body& body) {
        const auto contact =
            sweep_ellipsoid(body.world, vec(sweep.radii), vec(sweep.from), vec(sweep.move), body.filter);
        if (contact && contact->t < first.t) first = contact_of(*contact, body.platform, body.numbers);
    });
    return first;
}

slipface_ray_hit hit_of(const RayHit& hit, const Body& body) {
    const std::uint32_t number =
        hit.triangle < body.numbers.size() ? body.numbers[hit.triangle] : hit.triangle;
    return {hit.t,    vec(hit.normal), vec(hit.point),          number,
            hit.face, body.platform,   hit.back_face ? 1u : 0u, {}};
}

// The first `room` of all that the bodies find, merged by `t`. Each body is asked twice: for how many, and
// for as many as there is room for.
template <class Found, class Made, class Ask, class Make>
void find_all(const Bodies& bodies, Made* out, size_t room, size_t* found, const Ask& ask, const Make& make) {
    need("found", found);
    if (room > 0) need("a place for the results", out);
    std::vector<Made> all;
    std::size_t total = 0;
    bodies.each([&](const Body& body) {
        const std::size_t count = ask(body, std::span<Found>());
        std::vector<Found> some(std::min(count, room));
        ask(body, std::span<Found>(some));
        total += count;
        for (const Found& one : some)
            all.push_back(make(one, body));
    });
    if constexpr (requires(Made made) { made.t; }) std::ranges::stable_sort(all, {}, &Made::t);
    std::copy_n(all.begin(), std::min(room, all.size()), out);
    *found = total;
}

}  // namespace

slipface_status slipface_sweep_one(slipface_world world, const slipface_sweep* sweep,
                                   const slipface_filter* filter, slipface_contact* contact,
                                   slipface_error* error) {
    return run(error, [&] {
        need("sweep and contact", sweep, contact);
        checked(*sweep);
        const SharedWorld in(world.id);
        *contact = first_contact(Bodies(*in, filter), *sweep);
    });
}

slipface_status slipface_sweep_many(slipface_world world, const slipface_sweep* sweeps, size_t count,
                                    const slipface_filter* filter, slipface_contact* contacts,
                                    slipface_error* error) {
    return run(error, [&] {
        if (count > 0) need("sweeps and contacts", sweeps, contacts);
        for (std::size_t i = 0; i < count; ++i)
            checked(sweeps[i]);
        const SharedWorld in(world.id);
        const Bodies bodies(*in, filter);
        constexpr std::size_t portion = 4096;  // bounds the memory beside the caller's
        std::vector<Sweep> some;
        std::vector<std::optional<Contact>> found;
        if (bodies.plain()) {
            some.resize(std::min(count, portion));
            found.resize(some.size());
        }
        for (std::size_t first = 0; bodies.plain() && first < count; first += portion) {
            const std::size_t many = std::min(portion, count - first);
            for (std::size_t i = 0; i < many; ++i)
                some[i] = {vec(sweeps[first + i].radii), vec(sweeps[first + i].from),
                           vec(sweeps[first + i].move)};
            sweep_ellipsoids(in->now->collision, std::span(some).first(many), found);
            for (std::size_t i = 0; i < many; ++i)
                contacts[first + i] =
                    found[i] ? contact_of(*found[i], SLIPFACE_NONE, in->now->triangles) : no_contact();
        }
        if (bodies.plain()) return;
        parallel_for(count, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                contacts[i] = first_contact(bodies, sweeps[i]);
        });
    });
}

slipface_status slipface_sweep_hits(slipface_world world, const slipface_sweep* sweep,
                                    const slipface_filter* filter, slipface_contact* contacts, size_t room,
                                    size_t* found, slipface_error* error) {
    return run(error, [&] {
        need("sweep", sweep);
        checked(*sweep);
        const SharedWorld in(world.id);
        find_all<Contact>(
            Bodies(*in, filter), contacts, room, found,
            [&](const Body& body, std::span<Contact> out) {
                return find_sweep_hits(body.world, vec(sweep->radii), vec(sweep->from), vec(sweep->move), out,
                                       body.filter);
            },
            [](const Contact& one, const Body& body) {
                return contact_of(one, body.platform, body.numbers);
            });
    });
}

slipface_status slipface_ray(slipface_world world, slipface_vec3 origin, slipface_vec3 direction,
                             double max_t, const slipface_filter* filter, slipface_ray_hit* hit,
                             slipface_error* error) {
    return run(error, [&] {
        need("hit", hit);
        check_ray(origin, direction, max_t);
        const SharedWorld in(world.id);
        slipface_ray_hit first{};
        first.t = -1.0;
        first.triangle = first.face = first.platform = SLIPFACE_NONE;
        Bodies(*in, filter).each([&](const Body& body) {
            const auto found =
                cast_ray(body.world, vec(origin), vec(direction), max_t, RayStops::solid, body.filter);
            if (found && (first.t < 0.0 || found->t < first.t)) first = hit_of(*found, body);
        });
        *hit = first;
    });
}

slipface_status slipface_ray_hits(slipface_world world, slipface_vec3 origin, slipface_vec3 direction,
                                  double max_t, const slipface_filter* filter, slipface_ray_hit* hits,
                                  size_t room, size_t* found, slipface_error* error) {
    return run(error, [&] {
        check_ray(origin, direction, max_t);
        const SharedWorld in(world.id);
        find_all<RayHit>(
            Bodies(*in, filter), hits, room, found,
            [&](const Body& body, std::span<RayHit> out) {
                return find_ray_hits(body.world, vec(origin), vec(direction), max_t, RayStops::solid, out,
                                     body.filter);
            },
            hit_of);
    });
}

slipface_status slipface_closest_point(slipface_world world, slipface_vec3 point, double max_distance,
                                       const slipface_filter* filter, slipface_closest* closest,
                                       slipface_error* error) {
    return run(error, [&] {
        need("closest", closest);
        finite(point, "point");
        distance(max_distance, "max_distance");
        const SharedWorld in(world.id);
        slipface_closest nearest{};
        nearest.distance = -1.0;
        nearest.triangle = nearest.face = nearest.platform = SLIPFACE_NONE;
        Bodies(*in, filter).each([&](const Body& body) {
            const auto found = closest_point(body.world, vec(point), max_distance, body.filter);
            if (!found || (nearest.distance >= 0.0 && found->distance >= nearest.distance)) return;
            const std::uint32_t number =
                found->triangle < body.numbers.size() ? body.numbers[found->triangle] : found->triangle;
            nearest = {found->distance, vec(found->point), number, found->face, body.platform, {}};
        });
        *closest = nearest;
    });
}

slipface_status slipface_overlaps(slipface_world world, slipface_vec3 radii, slipface_vec3 centre,
                                  const slipface_filter* filter, slipface_overlap* overlaps, size_t room,
                                  size_t* found, slipface_error* error) {
    return run(error, [&] {
        positive(radii, "radii");
        finite(centre, "centre");
        const SharedWorld in(world.id);
        find_all<Overlap>(
            Bodies(*in, filter), overlaps, room, found,
            [&](const Body& body, std::span<Overlap> out) {
                return find_overlaps(body.world, vec(radii), vec(centre), out, body.filter);
            },
            [](const Overlap& one, const Body& body) {
                const std::uint32_t number =
                    one.triangle < body.numbers.size() ? body.numbers[one.triangle] : one.triangle;
                return slipface_overlap{vec(one.point),
                                        vec(one.normal),
                                        one.depth_sphere_space,
                                        number,
                                        one.face,
                                        one.surface,
                                        body.platform,
                                        static_cast<std::uint32_t>(one.feature),
                                        {}};
            });
    });
}
