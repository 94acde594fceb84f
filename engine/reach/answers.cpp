// Ways as tapes, and how near the player came to what was not reached.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "impl.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

constexpr std::size_t miss_nodes = 48;
constexpr std::uint32_t miss_visits = 72;

// The point of a triangle nearest to `p`. Source: Ericson, Real-Time Collision Detection, 5.1.5.
Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    return sum > 0.0 ? Vec3(a + ab * (vb / sum) + ac * (vc / sum)) : a;
}

// Metres between the ellipsoid at `centre` and a face, along the line between their nearest points in sphere
// space; 0 in touch.
double distance_to_face(const Mesh& mesh, FaceId face, const Vec3& radii, const Vec3& centre) {
    const Vec3 shrink = radii.cwiseInverse();
    const Vec3 p = centre.cwiseProduct(shrink);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = mesh.corner_position(mesh.triangles[t][k]).cast<double>().cwiseProduct(shrink);
        const Vec3 to = nearest_in_triangle(p, corner[0], corner[1], corner[2]) - p;
        const double sphere = to.norm();
        const double metres = sphere > 1.0 ? to.cwiseProduct(radii).norm() * (1.0 - 1.0 / sphere) : 0.0;
        nearest = std::min(nearest, metres);
    }
    return nearest;
}

}  // namespace

Tape ReachSearch::Impl::empty_tape() const {
    const Level& level = *world.level;
    Tape tape;
    tape.level_name = level.mesh_path.filename().string();
    tape.level_fingerprint = level.mesh.fingerprint();
    tape.dt = world.options.dt;
    tape.dt_text = world.options.dt_text;
    tape.start = start;
    for (const SettingInfo& info : settings_table())
        tape.settings.push_back(fmt::format("{}={}", info.name, setting_text(level.movement, info)));
    return tape;
}

std::optional<Tape> ReachSearch::Impl::checked_tape(std::span<const Press> motion,
                                                    const PlayerState* expected) const {
    Tape tape = empty_tape();
    for (const Press& press : motion)
        for (std::uint32_t i = 0; i < press.ticks; ++i)
            append_tick(tape, input_of(press));
    // A tape holds at least a tick: one at the start rests for one.
    const Lease lease(*this);
    const SimulationReport report = simulate(lease.scene(), world.level->movement, start, tape);
    if (expected != nullptr && !(report.final_state == *expected)) return std::nullopt;
    if (!tape.segments.empty()) tape.end_hash = report.end_hash;
    return tape;
}

std::optional<Tape> ReachSearch::tape_to(NodeId node) const {
    return impl_->checked_tape(impl_->archive.way_to(node), &impl_->archive.nodes[node].state);
}

Tape ReachSearch::tape_of(const ReachExit& exit) const {
    std::vector<Press> motion = impl_->archive.way_to(exit.node);
    const auto first = impl_->archive.presses.begin() + exit.first_press;
    motion.insert(motion.end(), first, first + exit.press_count);
    return *impl_->checked_tape(motion, nullptr);
}

Vec3 ReachSearch::position_of(NodeId node) const {
    return impl_->scene.to_level(impl_->archive.nodes[node].state);
}

std::vector<Vec3> ReachSearch::standing_places(std::size_t count) const {
    std::set<std::array<std::int64_t, 3>> seen;
    std::vector<Vec3> places;
    for (NodeId node = 0; node < impl_->archive.nodes.size(); ++node) {
        const PlayerState& state = impl_->archive.nodes[node].state;
        if (!state.grounded || state.ground_platform != no_id) continue;
        const Vec3 at = position_of(node), cell = at / cell_m();
        if (seen.insert({std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())}).second)
            places.push_back(at);
    }
    if (places.size() <= count) return places;
    std::vector<Vec3> some;
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(places[i * places.size() / count]);
    return some;
}

ReachSearch::Near ReachSearch::nearest(const Vec3& point) const {
    Near nearest{no_id, std::numeric_limits<double>::infinity()};
    const Vec3 down(0.0, level().movement.radii.y(), 0.0);
    const ReachArchive& archive = impl_->archive;
    for (NodeId node = 0; node < archive.nodes.size(); ++node) {
        if (!is_held(archive.nodes[node].state)) continue;
        const Vec3 at = position_of(node);
        const double distance = std::min((at - point).norm(), (at - down - point).norm());
        const bool sooner = nearest.node != no_id && distance == nearest.distance_m &&
                            archive.nodes[node].tick < archive.nodes[nearest.node].tick;
        if (distance < nearest.distance_m || sooner) nearest = {node, distance};
    }
    return nearest;
}

std::vector<NodeId> ReachSearch::Impl::nearest_nodes(const std::function<double(const Vec3&)>& distance,
                                                     std::size_t count) const {
    std::vector<std::pair<double, NodeId>> all;
    for (NodeId node = 0; node < archive.nodes.size(); ++node)
        if (is_held(archive.nodes[node].state))
            all.emplace_back(distance(scene.to_level(archive.nodes[node].state)), node);
    std::sort(all.begin(), all.end());
    if (all.size() > count) all.resize(count);
    std::vector<NodeId> nodes;
    for (const auto& [far, node] : all)
        nodes.push_back(node);
    return nodes;
}

std::optional<ReachSearch::Miss> ReachSearch::Impl::nearest_miss(
    const std::function<double(const Vec3&)>& distance) const {
    struct Best {
        double distance_m = std::numeric_limits<double>::infinity();
        FaceId from = no_id;
        std::vector<Press> presses;
    };
    const std::vector<NodeId> nodes = nearest_nodes(distance, miss_nodes);
    if (nodes.empty()) return std::nullopt;
    std::vector<Best> best(nodes.size());
    parallel_for(nodes.size(), 1, [&](std::size_t begin, std::size_t end) {
        Lease lease(*this);
        for (std::size_t i = begin; i < end; ++i) {
            Best& mine = best[i];
            mine.distance_m = distance(scene.to_level(archive.nodes[nodes[i]].state));
            const FaceId first = archive.nodes[nodes[i]].state.ground_face;
            FaceId held = first;
            mine.from = first;
            const TickWatcher watch = [&](const MovementScene&, const PlayerState& state,
                                          std::span<const Press> presses, std::uint32_t) {
                if (presses.size() == 1 && presses.front().ticks == 1) held = first;
                if (is_held(state)) held = state.ground_face;
                const double metres = distance(scene.to_level(state));
                if (metres >= mine.distance_m) return;
                mine = {metres, held, {presses.begin(), presses.end()}};
            };
            Harvest ignored;
            roll_out(world, lease.scenes(), known(), nodes[i], 0, miss_visits, ignored, &watch);
        }
    });
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < best.size(); ++i)
        if (best[i].distance_m < best[nearest].distance_m) nearest = i;
    std::vector<Press> motion = archive.way_to(nodes[nearest]);
    motion.insert(motion.end(), best[nearest].presses.begin(), best[nearest].presses.end());
    return Miss{best[nearest].distance_m, best[nearest].from, *checked_tape(motion, nullptr)};
}

std::optional<ReachSearch::Miss> ReachSearch::nearest_miss_of_face(FaceId face) const {
    return impl_->nearest_miss([&](const Vec3& centre) {
        return distance_to_face(*level().mesh, face, level().movement.radii, centre);
    });
}

std::optional<ReachSearch::Miss> ReachSearch::nearest_miss_of_point(const Vec3& point, double radius) const {
    return impl_->nearest_miss(
        [&](const Vec3& centre) { return std::max(0.0, (centre - point).norm() - radius); });
}

}  // namespace slipface
