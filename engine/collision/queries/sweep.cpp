#include "queries/first_of.h"
#include "queries/near.h"
#include "queries/paths.h"
#include "queries/search.h"
#include "queries/sight.h"
#include "slipface/collision/filter.h"

namespace slipface {
namespace {

using namespace detail;

// A search that sees only some triangles.
struct FilteredSearch {
    Search& search;
    const QueryFilter& filter;

    bool sees(const LeafTriangle& leaf) const {
        return filter.sees(leaf.id, search.world.surface_of(leaf.id));
    }
    void consider(const LeafTriangle& leaf) {
        if (sees(leaf)) search.consider(leaf);
    }
    double limit() const { return search.hit.t; }
};

// All hits: nothing that was found makes the rest of the way uninteresting.
struct HitSearch {
    FilteredSearch one;
    FirstOf<Contact> hits;

    void consider(const LeafTriangle& leaf) {
        TriangleHit hit{};
        const Search& search = one.search;
        if (one.sees(leaf) && search.kernels.sweep_triangle(leaf, search.query, 1.0, hit) &&
            search.stopped_by(leaf, hit))
            hits.add(search.contact_of(leaf, hit));
    }
    double limit() const { return 1.0; }
};

bool comes_before(const Contact& a, const Contact& b) {
    if (a.t != b.t) return a.t < b.t;
    return a.feature != b.feature ? a.feature < b.feature : a.triangle < b.triangle;
}

template <class Considers>
float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
    Considers& search = *static_cast<Considers*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return time_limit(search.limit());
}

// Offers the triangles along the sweep to `each`, which reads `query` and what `search` says of it. None if
// the arguments are invalid.
template <class Considers>
void search_along(const Sight& sight, const Vec3& radii, const Vec3& from, const Vec3& move,
                  EllipsoidQuery& query, Search& search, Considers& each) {
    const CollisionWorld::Impl& impl = sight.world;
    const V3 start = v3(from), motion = v3(move), axes = v3(radii);
    if (impl.empty() || is_zero(motion)) return;
    SweepPath path;
    const Prepared prepared = search.kernels.prepare_sweep(*sight.extent, axes, start, motion, query, path);
    if (prepared == Prepared::beside) return;
    search.in_floats = prepared == Prepared::in_floats;
    if (search.in_floats && sight.has_tree) {
        search.kernels.sweep(sight.view, query, path, time_limit(1.0), consider_lane<Considers>, &each);
    } else if (!refused(axes, start, motion)) {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            each.consider(sight.triangle(id));
    }
}

}  // namespace

std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move) {
    EllipsoidQuery query;
    Search search(world.impl(), query);
    search_along(Sight(world.impl()), radii, from, move, query, search, search);
    return search.contact();
}

std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move, const QueryFilter& filter) {
    EllipsoidQuery query;
    Search search(world.impl(), query);
    search.solid = filter.solid;
    FilteredSearch filtered{search, filter};
    search_along(Sight(world.impl()), radii, from, move, query, search, filtered);
    return search.contact();
}

std::size_t find_sweep_hits(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                            const Vec3& move, std::span<Contact> out, const QueryFilter& filter) {
    EllipsoidQuery query;
    Search search(world.impl(), query);
    search.solid = filter.solid;
    HitSearch all{{search, filter}, {out, comes_before}};
    search_along(Sight(world.impl()), radii, from, move, query, search, all);
    return all.hits.finish();
}

std::optional<Contact> sweep_ellipsoid(const PosedWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move, const QueryFilter& filter) {
    EllipsoidQuery query;
    Search search(world.world().impl(), query);
    search.solid = filter.solid;
    FilteredSearch filtered{search, filter};
    search_along(PosedSight(world), radii, from - world.origin(), move, query, search, filtered);
    std::optional<Contact> contact = search.contact();
    if (contact) contact->point += world.origin();
    return contact;
}

std::size_t find_sweep_hits(const PosedWorld& world, const Vec3& radii, const Vec3& from, const Vec3& move,
                            std::span<Contact> out, const QueryFilter& filter) {
    EllipsoidQuery query;
    Search search(world.world().impl(), query);
    search.solid = filter.solid;
    HitSearch all{{search, filter}, {out, comes_before}};
    search_along(PosedSight(world), radii, from - world.origin(), move, query, search, all);
    const std::size_t found = all.hits.finish();
    for (Contact& contact : out.first(std::min(found, out.size())))
        contact.point += world.origin();
    return found;
}

std::optional<Contact> sweep_ellipsoid(const Neighbourhood& near, const Vec3& radii, const Vec3& from,
                                       const Vec3& move) {
    NearCandidates candidates(near, radii, from, move);
    if (candidates.lead_out())
        return near.filter() == nullptr ? sweep_ellipsoid(near.world(), radii, from, move)
                                        : sweep_ellipsoid(near.world(), radii, from, move, *near.filter());
    if (candidates.none() || is_zero(v3(move))) return std::nullopt;
    Search search(near.world().impl(), candidates.query());
    for (; const NearCandidate* next = candidates.take(time_limit(search.hit.t));)
        search.consider(near_triangle(near.triangles(), next->index));
    return search.contact();
}

}  // namespace slipface
