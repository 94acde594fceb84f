#include "slipface/reach/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

#include "impl.h"
#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"
#include "slipface/level/shown_mesh.h"

namespace slipface {
namespace {

constexpr std::size_t picks_per_round = 256;
constexpr std::uint32_t visits_per_pick = 4;
// Then a cell has shown what it leads to. In the air little can be chosen.
constexpr std::uint32_t max_visits = 2000, max_visits_in_air = 24;
constexpr std::size_t max_cost = 160;
constexpr std::size_t max_nodes = 60'000'000;
// Where a platform is counts in parts of its motion of that many seconds.
constexpr double phase_s = 0.5, sampled_s = 0.125, max_samples = 20'000.0, max_parts = 48.0;
constexpr std::size_t max_stages = 1000;
constexpr double jump_around_m = 5.0, jump_above_m = 3.0;

// The times at which the platform is somewhere else, or begins or ends a pause, in one period or until it
// rests for good.
std::vector<double> stages_of(const Platform& platform, double period) {
    double length = period, pauses = 0.0;
    for (const PathPoint& point : platform.path)
        pauses += std::max(0.0, point.pause_s);
    if (!(period > 0.0))
        for (std::size_t i = 0; i + 1 < platform.path.size(); ++i)
            length += std::max(0.0, platform.path[i].pause_s) +
                      (platform.path[i + 1].offset - platform.path[i].offset).norm() /
                          std::max(1e-3, platform.path[i].speed);
    const double part_s = std::max(phase_s, (length - pauses) / max_parts);
    const double sample_s = std::max(sampled_s, length / max_samples);
    std::vector<double> stages{0.0};
    bool moved = false;
    double moving_s = 0.0;
    Pose last = platform_pose(platform, 0.0);
    for (double time = sample_s; time < length + sample_s; time += sample_s) {
        const Pose now = platform_pose(platform, time);
        const bool moves = now != last;
        last = now;
        moving_s = moves && moved ? moving_s + sample_s : 0.0;
        const bool next = moves != moved || moving_s >= part_s;
        if (moving_s >= part_s) moving_s = 0.0;
        moved = moves;
        if (next && stages.size() < max_stages) stages.push_back(time - sample_s);
    }
    return stages;
}

// What holds a platform wherever it is, with the room in which it decides where a jump ends.
std::vector<MovingArea> moving_areas(const Level& level, const LevelScene& scene) {
    std::vector<MovingArea> areas;
    if (scene.is_static()) return areas;
    const std::span<const std::uint32_t> platforms = scene.face_platforms();
    const Mesh& mesh = *level.mesh;
    std::vector<Aabb> rest(level.platforms.size());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t platform = platforms[mesh.triangle_face[t]];
        for (std::size_t k = 0; platform != no_id && k < 3; ++k)
            rest[platform].add(mesh.corner_position(mesh.triangles[t][k]).cast<double>());
    }
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const Platform& platform = level.platforms[i];
        MovingArea area;
        area.box = platform_reach(platform, rest[i]);
        if (!area.box.empty()) {
            const Vec3 around(jump_around_m, jump_above_m, jump_around_m);
            area.box.min += scene.offset() - around;
            area.box.max += scene.offset() + around;
        }
        area.period = path_period(platform);
        if (area.period <= 0.0 && platform.spin_rate != 0.0)
            area.period = 2.0 * std::numbers::pi / std::abs(platform.spin_rate);
        area.stages = stages_of(platform, area.period);
        areas.push_back(area);
    }
    return areas;
}

// Below this nothing can hold a player. Scene coordinates.
double lowest_of(const Level& level, const TickScene& scene, std::span<const MovingArea> areas) {
    double lowest = scene.bounds().empty() ? 0.0 : scene.bounds().min.y();
    for (const MovingArea& area : areas)
        if (!area.box.empty()) lowest = std::min(lowest, area.box.min.y());
    if (level.terrain)
        for (const double height : level.terrain->heights)
            lowest = std::min(lowest, height + scene.offset().y());
    return lowest - 2.0 * level.movement.radii.y() - 1.0;
}

double cell_of(const Level& level, double wanted) {
    if (wanted > 0.0) return wanted;
    const double width = std::max(level.movement.radii.x(), level.movement.radii.z());
    double floor = level.heightfield ? level.heightfield->size.prod() : 0.0;
    for (const FaceId face : walkable_faces(level))
        floor += face_area(*level.mesh, face);
    // Two hundred thousand cells of floor are enough for one look at a level.
    return std::clamp(std::sqrt(floor / 200'000.0), 1.25 * width, 5.0 * width);
}

}  // namespace

ReachSearch::Impl::Lease::Lease(const Impl& impl) : impl_(impl) {
    const std::scoped_lock lock(impl.mutex);
    if (impl.spare.empty()) {
        own_ = std::make_unique<OwnScenes>(impl.scene.for_another_thread(), impl.world.options.dt);
        return;
    }
    own_ = std::move(impl.spare.back());
    impl.spare.pop_back();
}

ReachSearch::Impl::Lease::~Lease() {
    const std::scoped_lock lock(impl_.mutex);
    impl_.spare.push_back(std::move(own_));
}

Status ReachSearch::Impl::prepare(const Level& level, const Vec3& from, const ReachOptions& options) {
    if (level.mesh.triangle_count() == 0) return Error{"reach", "the level has no triangles"};
    if (!(options.dt >= 1e-4 && options.dt <= 0.25))
        return Error{"reach", fmt::format("found a step of {} s, expected 0.0001 to 0.25", options.dt)};
    if (!(options.cell_m == 0.0 || (options.cell_m >= 0.05 && options.cell_m <= 100.0)))
        return Error{"reach", fmt::format("found cells of {} m, expected 0.05 to 100", options.cell_m)};
    if (!from.allFinite()) return Error{"reach", "found a start that is not finite"};
    const TickScene ticks(scene);
    start = from;
    world.level = &level;
    world.options = options;
    world.start = run_start(ticks, start);
    world.cell_m = cell_of(level, options.cell_m);
    world.moving = moving_areas(level, scene);
    world.lowest = lowest_of(level, ticks, world.moving);
    for (const Goal& goal : level.goals)
        world.goals.push_back(goal.position + scene.offset());
    PlayerState rest = world.start.player;
    for (std::size_t tick = 0; tick < 120 && !is_held(rest); ++tick) {
        const TickResult result =
            play_tick(ticks.at(tick, options.dt), level.movement, rest, {}, options.dt, world.start);
        if (result.respawn != Respawn::none) break;
        rest = result.state;
    }
    world.home = position_in_scene(ticks.at(0, options.dt), rest);
    faces.assign(level.mesh.face_count(), {});
    goals.assign(level.goals.size(), {});
    face_cells.assign(faces.size() + 1, 0);
    queue.resize(max_cost);
    queue_begin.assign(max_cost, 0);
    return {};
}

// The face that holds the player or that it touches; else that of all else.
std::size_t ReachSearch::Impl::face_of(const PlayerState& state) const {
    return std::min<std::size_t>(state.ground_face, faces.size());
}

std::size_t ReachSearch::Impl::first_cost(const PlayerState& state) const {
    const auto crowd = static_cast<std::size_t>(std::bit_width(face_cells[face_of(state)]));
    return std::min<std::size_t>(8, crowd / 2) + (is_held(state) ? 0 : 4);
}

void ReachSearch::Impl::enqueue(NodeId node, std::size_t cost) {
    queue[std::min(cost, max_cost - 1)].push_back(node);
}

bool ReachSearch::Impl::goals_reached(double late) const {
    const std::vector<Goal>& wanted = world.level->goals;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i].kind == GoalKind::never) return false;
        if (!goals[i].found()) return false;
        if (wanted[i].within_s && goals[i].tick * world.options.dt > late * *wanted[i].within_s) return false;
    }
    return true;
}

void ReachSearch::Impl::merge(const Harvest& harvest, NodeId from, ReachRound& news, bool& productive) {
    const auto is_faster = [](const ReachNode& node, const Reached& known) {
        return !known.found() || node.tick < known.tick;
    };
    steps += harvest.steps;
    news.steps += harvest.steps;
    for (const Found& found : harvest.found) {
        const NodeId before = archive.find(found.node.cell);
        const bool new_cell = before == no_id;
        const bool new_face = found.face != no_id && is_faster(found.node, faces[found.face]);
        const bool new_goal = found.goal != no_id && is_faster(found.node, goals[found.goal]);
        const bool faster = !new_cell && found.node.tick < archive.nodes[before].tick;
        if (!new_cell && !new_face && !new_goal && !faster) {
            archive.add_edge(from, before);
            continue;
        }
        const std::span<const Press> motion =
            std::span(harvest.presses).subspan(found.first_press, found.press_count);
        const PlayerState& state = found.node.state;
        std::size_t cost = first_cost(state) + (faster ? 4 : 0);
        if (found.face != no_id && !faces[found.face].found()) {
            ++news.faces;
            cost = 0;
            productive = true;
        }
        if (new_cell) {
            ++news.cells;
            productive |= is_held(state);
            ++face_cells[face_of(state)];
        }
        const NodeId id = archive.add(found.node, motion);
        if (new_face) faces[found.face] = {id, found.node.tick};
        if (new_goal) goals[found.goal] = {id, found.node.tick};
        enqueue(id, cost);
    }
    for (const NodeId reached : harvest.reached)
        archive.add_edge(from, reached);
    for (const ReachExit& one : harvest.exits) {
        const auto [at, is_new] = exit_at.emplace(one.spot, static_cast<std::uint32_t>(exits.size()));
        if (!is_new) {
            ++exits[at->second].times;
            continue;
        }
        ReachExit& exit = exits.emplace_back(one);
        exit.times = 1;
        exit.first_press = static_cast<std::uint32_t>(archive.presses.size());
        const auto first = harvest.presses.begin() + one.first_press;
        archive.presses.insert(archive.presses.end(), first, first + one.press_count);
    }
}

std::vector<ReachSearch::Impl::Pick> ReachSearch::Impl::pick_nodes() {
    std::vector<Pick> picks;
    for (std::size_t cost = 0; cost < max_cost && picks.size() < picks_per_round; ++cost) {
        std::vector<NodeId>& waiting = queue[cost];
        std::size_t& at = queue_begin[cost];
        for (; at < waiting.size() && picks.size() < picks_per_round; ++at) {
            const ReachNode& node = archive.nodes[waiting[at]];
            if (node.superseded) continue;
            picks.push_back({waiting[at], node.visits, node.visits + visits_per_pick, cost});
        }
        if (at == waiting.size()) {
            waiting.clear();
            at = 0;
        } else if (at > 65536 && 2 * at > waiting.size()) {
            waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(at));
            at = 0;
        }
    }
    // The fewer there are, the more is tried from each.
    const auto more = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(picks_per_round / std::max<std::size_t>(1, picks.size()), 1, 8));
    for (Pick& pick : picks)
        pick.last = pick.first + visits_per_pick * more;
    return picks;
}

std::vector<Harvest> ReachSearch::Impl::roll_out_all(std::span<const Pick> picks) const {
    std::vector<Harvest> harvests(picks.size());
    parallel_for(picks.size(), 4, [&](std::size_t begin, std::size_t end) {
        Lease lease(*this);
        for (std::size_t i = begin; i < end; ++i)
            roll_out(world, lease.scenes(), known(), picks[i].node, picks[i].first, picks[i].last,
                     harvests[i]);
    });
    return harvests;
}

bool ReachSearch::Impl::round(Team* team, bool time_is_over) {
    const std::vector<Pick> picks = pick_nodes();
    const std::vector<Harvest> harvests =
        team != nullptr ? roll_out_in_team(picks, *team, time_is_over) : roll_out_all(picks);
    const std::uint32_t visits = picks.empty() ? 0 : picks.front().last - picks.front().first;
    const std::size_t more = visits / visits_per_pick;
    ReachRound& news = rounds.emplace_back();
    for (std::size_t i = 0; i < picks.size(); ++i) {
        const Pick& pick = picks[i];
        bool productive = false;
        merge(harvests[i], pick.node, news, productive);
        archive.nodes[pick.node].visits = pick.last & 0x1fffu;
        const bool held = is_held(archive.nodes[pick.node].state);
        const std::uint32_t maximum = !held ? max_visits_in_air : productive ? 8000u : max_visits;
        if (pick.last < maximum) enqueue(pick.node, pick.cost + (productive ? 0 : more));
    }
    return !time_is_over;
}

ReachSearch::ReachSearch(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ReachSearch::ReachSearch(ReachSearch&&) noexcept = default;
ReachSearch& ReachSearch::operator=(ReachSearch&&) noexcept = default;
ReachSearch::~ReachSearch() = default;

Result<ReachSearch> ReachSearch::begin(const Level& level, const Vec3& start, const ReachOptions& options) {
    Result<LevelScene> scene = LevelScene::build(level);
    if (!scene) return scene.error();
    auto impl = std::make_unique<Impl>(std::move(*scene));
    if (Status status = impl->prepare(level, start, options); !status) return status.error();
    const TickScene ticks(impl->scene);
    const MovementScene first = ticks.at(0, options.dt);
    ReachNode root;
    root.state = impl->world.start.player;
    root.cell = impl->world.cell_key(first, root.state, 0);
    root.returns = 1;
    impl->enqueue(impl->archive.add(root, {}), 0);
    return ReachSearch(std::move(impl));
}

bool ReachSearch::exhausted() const {
    for (std::size_t cost = 0; cost < max_cost; ++cost)
        if (impl_->queue_begin[cost] < impl_->queue[cost].size()) return false;
    return true;
}

void ReachSearch::run(const ReachLimits& limits, Progress* progress) {
    const auto begin = std::chrono::steady_clock::now();
    begin_stage(progress, "Searching", 0.0, 1.0);
    while (!exhausted() && !cancelled(progress) && impl_->archive.nodes.size() < max_nodes) {
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (limits.rounds && impl_->rounds.size() >= *limits.rounds) break;
        const bool time_is_over = limits.seconds > 0.0 && seconds >= limits.seconds;
        if (time_is_over && limits.team == nullptr) break;
        if (limits.until_goals && impl_->goals_reached(limits.late)) break;
        const double by_rounds =
            limits.rounds ? static_cast<double>(impl_->rounds.size()) / static_cast<double>(*limits.rounds)
                          : 0.0;
        advance(progress, std::max(by_rounds, limits.seconds > 0.0 ? seconds / limits.seconds : 0.0));
        if (!impl_->round(limits.team, time_is_over)) break;
        if (limits.after_round && (limits.team == nullptr || limits.team->rank() == 0))
            limits.after_round(*this);
    }
}

bool ReachSearch::goals_reached(double late) const {
    return impl_->goals_reached(late);
}

const Level& ReachSearch::level() const {
    return *impl_->world.level;
}
const ReachOptions& ReachSearch::options() const {
    return impl_->world.options;
}
const Vec3& ReachSearch::start() const {
    return impl_->start;
}
double ReachSearch::cell_m() const {
    return impl_->world.cell_m;
}
const ReachArchive& ReachSearch::archive() const {
    return impl_->archive;
}
const std::vector<Reached>& ReachSearch::faces() const {
    return impl_->faces;
}
const std::vector<Reached>& ReachSearch::goals() const {
    return impl_->goals;
}
const std::vector<ReachExit>& ReachSearch::exits() const {
    return impl_->exits;
}
const std::vector<ReachRound>& ReachSearch::rounds() const {
    return impl_->rounds;
}
std::uint64_t ReachSearch::steps() const {
    return impl_->steps;
}

std::uint64_t ReachSearch::hash() const {
    Hasher hasher;
    for (const ReachNode& node : impl_->archive.nodes) {
        hasher.u64(state_hash(node.state, node.cell));
        hasher.u64(node.parent);
        hasher.u64(node.tick);
        hasher.u64(node.returns);
    }
    for (const Press& press : impl_->archive.presses)
        hasher.u64((std::uint64_t{press.ticks} << 16) | (std::uint64_t{press.buttons} >> 1 << 9) |
                   (std::uint64_t{press.stick} << 1) | (press.buttons & 1U));
    for (const std::vector<Reached>* list : {&impl_->faces, &impl_->goals})
        for (const Reached& one : *list)
            hasher.u64(one.node);
    for (const ReachExit& exit : impl_->exits) {
        hasher.u64(exit.spot);
        hasher.u64(exit.times);
    }
    hasher.u64(impl_->steps);
    return hasher.value();
}

std::vector<FaceId> walkable_faces(const Level& level) {
    const ResolvedSurfaces surfaces = resolve_surfaces(level);
    std::vector<FaceId> walkable;
    for (FaceId face = 0; face < level.mesh.face_count(); ++face) {
        const SurfaceType& type = level.surfaces[surfaces.surface[face]];
        if (!type.solid || type.hazardous) continue;
        const double slope = type.max_slope.value_or(level.movement.max_slope);
        if (face_normal(*level.mesh, face).y() >= std::cos(slope)) walkable.push_back(face);
    }
    return walkable;
}

}  // namespace slipface
