// Many sweeps at once: on several threads, and on each of them side by side through the tree (wave_impl.h).
#include <algorithm>
#include <array>
#include <optional>

#include "queries/paths.h"
#include "queries/search.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

using namespace detail;

float consider_in_flight(void* context, const Leaf& leaf, std::uint32_t lane) {
    Search& search = *static_cast<Search*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return time_limit(search.limit());
}

struct Flight {
    std::size_t sweep;  // its number in the batch
    EllipsoidQuery query;
    Search search;

    Flight(const CollisionWorld::Impl& world, const EllipsoidQuery& of, std::size_t number)
        : sweep(number), query(of), search(world, query) {}
    Flight(const Flight&) = delete;
    Flight& operator=(const Flight&) = delete;
};

// Up to wave_sweeps sweeps in progress. Each searches one part of its path at a time, so that triangles
// behind its first touch cost little.
class Wave {
  public:
    Wave(const CollisionWorld& world, std::span<const Sweep> sweeps, std::span<std::optional<Contact>> out)
        : world_(world),
          sweeps_(sweeps),
          out_(out),
          small_(world.impl().bvh.view_bytes() < kernels().wave_worth) {}

    // Adds a sweep to the wave, or computes it at once if it cannot join.
    void add(std::size_t number) {
        const Sweep& sweep = sweeps_[number];
        const V3 radii = v3(sweep.radii), from = v3(sweep.from), move = v3(sweep.move);
        const CollisionWorld::Impl& world = world_.impl();
        out_[number].reset();
        if (world.empty() || is_zero(move)) return;
        if (small_ && largest(move) > 2.0 * largest(radii)) {
            out_[number] = sweep_alone(number);
            return;
        }
        WaveSweep& part = parts_[count_];
        EllipsoidQuery query;
        const Prepared prepared = kernels().prepare_sweep(world.extent, radii, from, move, query, part.path);
        if (prepared == Prepared::beside) return;
        if (prepared != Prepared::in_floats || !part.path.sphere.usable) {
            out_[number] = sweep_alone(number);
            return;
        }
        flights_[count_].emplace(world, query, number);
        if (world.bvh.nodes.empty()) {
            out_[number] = with_instances(*flights_[count_], part.path);
            return;
        }
        // The first part covers the surroundings of the body, but is long enough that few parts follow.
        part.from = 0.0F;
        part.to =
            std::clamp(static_cast<float>(2.0 * largest(radii) / largest(move)), 1e-3F, time_limit(1.0));
        of_[count_] = count_;
        if (++count_ == wave_sweeps) finish();
    }

    void finish() {
        std::uint32_t active = count_;
        count_ = 0;
        while (active != 0) {
            const std::uint32_t found =
                kernels().wave(world_.impl().bvh.view(), parts_.data(), active, candidates_.data());
            if (found > wave_candidates) {
                for (std::uint32_t k = 0; k < active; ++k) {
                    const std::size_t number = flights_[of_[k]]->sweep;
                    out_[number] = sweep_alone(number);
                }
                return;
            }
            consider(std::span(candidates_).first(found), active);
            std::uint32_t left = 0;
            for (std::uint32_t k = 0; k < active; ++k) {
                Flight& flight = *flights_[of_[k]];
                const float end = time_limit(flight.search.hit.t);
                if (end <= parts_[k].to) {
                    out_[flight.sweep] = with_instances(flight, parts_[k].path);
                    continue;
                }
                const float to = parts_[k].to;
                if (left != k) parts_[left] = parts_[k];
                parts_[left].from = to;
                parts_[left].to = std::min(3.0F * to, end);
                of_[left++] = of_[k];
            }
            active = left;
        }
    }

  private:
    std::optional<Contact> sweep_alone(std::size_t number) const {
        return sweep_ellipsoid(world_, sweeps_[number].radii, sweeps_[number].from, sweeps_[number].move);
    }

    // The first contact once the soup was searched. Instances have trees of their own, which a wave does not
    // follow.
    std::optional<Contact> with_instances(Flight& flight, const SweepPath& path) const {
        WorldView rest = world_.impl().view();
        rest.own = {};
        if (rest.boxes.nodes != nullptr)
            kernels().sweep(rest, flight.query, path, time_limit(flight.search.hit.t), consider_in_flight,
                            &flight.search);
        return flight.search.contact();
    }

    // The most promising triangle of each sweep first: its touch makes most others too late.
    void consider(std::span<const Candidate> candidates, std::uint32_t active) {
        std::array<const Candidate*, wave_sweeps> first{};
        for (const Candidate& candidate : candidates) {
            const Candidate*& best = first[candidate.sweep];
            if (best == nullptr || candidate.after < best->after) best = &candidate;
        }
        const auto consider = [this](const Candidate& candidate) {
            Search& search = flights_[of_[candidate.sweep]]->search;
            if (candidate.after > time_limit(search.hit.t)) return;
            search.consider(leaf_triangle(search.world.bvh.leaf_at(candidate.leaf), candidate.lane));
        };
        for (std::uint32_t k = 0; k < active; ++k) {
            if (first[k] != nullptr) consider(*first[k]);
        }
        for (const Candidate& candidate : candidates) {
            if (&candidate != first[candidate.sweep]) consider(candidate);
        }
    }

    const CollisionWorld& world_;
    std::span<const Sweep> sweeps_;
    std::span<std::optional<Contact>> out_;
    bool small_;
    std::uint32_t count_ = 0;
    std::array<std::optional<Flight>, wave_sweeps> flights_;
    std::array<WaveSweep, wave_sweeps> parts_;     // of the sweeps in progress
    std::array<std::uint32_t, wave_sweeps> of_{};  // their flights
    std::array<Candidate, wave_candidates> candidates_;
};

}  // namespace

void sweep_ellipsoids(const CollisionWorld& world, std::span<const Sweep> sweeps,
                      std::span<std::optional<Contact>> out) {
    parallel_for(std::min(sweeps.size(), out.size()), 128, [&](std::size_t begin, std::size_t end) {
        Wave wave(world, sweeps, out);
        for (std::size_t i = begin; i < end; ++i)
            wave.add(i);
        wave.finish();
    });
}

}  // namespace slipface
