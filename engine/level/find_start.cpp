#include "slipface/level/find_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "open_floor.h"
#include "start_room.h"

namespace slipface {

namespace {

constexpr double max_spawn_position = 1e9;
constexpr double longest_push = 2.0;  // fractions of the player's height
constexpr double yaw_of_nothing = 0.0;

// A spawn that was moved, and by how much.
struct Moved {
    Vec3 centre = Vec3::Zero();
    double distance = 0.0;
};

// Straight up, to where there is room, and down again onto the floor.
std::optional<Moved> lifted(const MovementScene& scene, const MovementSettings& settings,
                            const Vec3& centre) {
    constexpr int steps = 24;
    const double highest = 2.0 * settings.radii.y() + 0.1;
    for (int i = 1; i <= steps; ++i) {
        const double lift = highest * i / steps;
        const Vec3 up = centre + Vec3(0.0, lift, 0.0);
        if (!has_room(scene, settings, settings.radii, up)) continue;
        const auto landed = drop(scene, settings, up, lift);
        if (!landed || !fits(scene, settings, *landed)) return std::nullopt;
        return Moved{*landed, landed->y() - centre.y()};
    }
    return std::nullopt;
}

double depth_below(const MovementScene& scene, const Vec3& centre) {
    double lowest = scene.collision.bounds().empty() ? centre.y() : scene.collision.bounds().min.y();
    for (const MovingPart& part : scene.platforms)
        if (const Aabb box = part.at_end().bounds(); !box.empty()) lowest = std::min(lowest, box.min.y());
    return std::max(0.0, centre.y() - lowest) + 1.0;
}

bool has_floor(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre) {
    if (scene.heightfield && settings.heightfield && terrain_at(*scene.heightfield, centre.x(), centre.z()))
        return true;
    return first_contact(scene, settings.radii, centre, {0.0, -depth_below(scene, centre), 0.0}).has_value();
}

// The shortest of a few ways out, to the side and aslant. `all_tried`: false if there were too many triangles
// to try them all.
std::optional<Moved> pushed_out(const MovementScene& scene, const MovementSettings& settings,
                                const Vec3& centre, double less_than, bool& all_tried) {
    const double step = settings.radii.minCoeff() / 8.0;
    const Vec3 reach = settings.radii.array() + less_than;
    Aabb around{centre - reach, centre + reach};
    around.min.y() -= depth_below(scene, centre);
    const std::size_t crowd = crowd_in(scene, around);
    SearchEffort effort;
    for (int i = 1; i * step < less_than; ++i) {
        for (int y = 0; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                for (int x = -1; x <= 1; ++x) {
                    if (x == 0 && z == 0) continue;
                    all_tried = effort.spend(crowd);
                    if (!all_tried) return std::nullopt;
                    const Vec3 to = centre + Vec3(x, y, z).normalized() * (i * step);
                    if (has_room(scene, settings, settings.radii, to) && has_floor(scene, settings, to))
                        return Moved{to, i * step};
                }
            }
        }
    }
    return std::nullopt;
}

// Floor below the body's rim on all four sides: nobody slides off an edge.
bool is_firm(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre) {
    for (const auto& [x, z] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
        const Vec3 at = centre + Vec3(x * settings.radii.x(), 0.0, z * settings.radii.z());
        const bool terrain = scene.heightfield && settings.heightfield &&
                             terrain_at(*scene.heightfield, at.x(), at.z()).has_value();
        if (!terrain && !cast_ray(scene.collision, at, {0.0, -1.0, 0.0})) return false;
    }
    return true;
}

// A ladder or a sticky wall may hold a player who has no floor.
bool has_hold(const MovementScene& scene, const MovementSettings& settings, const Vec3& centre) {
    const Vec3 reach = settings.radii.array() + 0.1;
    std::array<Overlap, 64> near;
    const std::size_t count = std::min(near.size(), find_overlaps(scene.collision, reach, centre, near));
    return std::any_of(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const Overlap& overlap) {
                           if (overlap.surface >= scene.surfaces.size()) return false;
                           const SurfaceType& type = scene.surfaces[overlap.surface];
                           return type.climbable || type.sticky;
                       });
}

// Towards the farthest view of 16, so that nobody begins with the face to a wall.
double open_yaw(const MovementScene& scene, const Vec3& centre) {
    constexpr int directions = 16;
    constexpr double turn = 6.283185307179586 / directions;
    double best = yaw_of_nothing, farthest = -1.0;
    const double far = (scene.collision.bounds().max - scene.collision.bounds().min).norm();
    for (int i = 0; i < directions; ++i) {
        const double yaw = i * turn;
        const auto hit = cast_ray(scene.collision, centre, {-std::sin(yaw), 0.0, -std::cos(yaw)}, far);
        const double distance = hit ? hit->t : far;
        // A clear step more, so that rounding chooses no direction.
        if (distance > farthest * 1.01 + 1e-6) {
            farthest = distance;
            best = yaw;
        }
    }
    return best;
}

std::string metres(double distance) {
    return fmt::format("{:.2f} m", distance);
}

class StartFinder {
  public:
    StartFinder(const MovementScene& scene, const Vec3& offset, const MovementSettings& settings)
        : scene_(scene), offset_(offset), settings_(settings) {}

    Start at(const Spawn& spawn) {
        Start start{
            .position = spawn.position, .yaw = spawn.yaw, .spawn = spawn.name, .stands = true, .note = {}};
        const Vec3 centre = spawn.position + offset_;
        const std::string subject = fmt::format("Spawn \"{}\"", spawn.name);
        if (fits(scene_, settings_, centre)) {
            // What moves may come by later.
            if (has_floor(scene_, settings_, centre) || !scene_.platforms.empty() ||
                has_hold(scene_, settings_, centre))
                return start;
            return elsewhere(start, subject + " has nothing below it");
        }
        if (const auto moved = made_to_fit(centre, start.note)) {
            start.position = *moved - offset_;
            start.note = subject + start.note;
            return start;
        }
        return elsewhere(start, subject + " lies inside the level");
    }

    Start without_spawn() {
        Start start;
        Vec3 centre = offset_;
        std::string note;
        bool room = fits(scene_, settings_, centre);
        if (!room) {
            if (const auto moved = made_to_fit(centre, note)) {
                centre = *moved;
                room = true;
            }
        }
        // A fall from high above is no start that somebody meant.
        const bool low = room && drop(scene_, settings_, centre, 2.0 * settings_.radii.y());
        if (!low || !is_firm(scene_, settings_, centre) || !open_floor().is_good(centre))
            return elsewhere(start, "The level has no spawn");
        start.position = centre - offset_;
        start.note = "The level has no spawn; the player starts at the origin";
        if (!note.empty()) start.note += "," + note;
        return start;
    }

  private:
    // What may take a tenth of a second is done if it is needed, and once.
    const OpenFloor& open_floor() {
        if (!open_floor_) open_floor_.emplace(scene_, settings_);
        return *open_floor_;
    }

    // Says in `note` how.
    std::optional<Vec3> made_to_fit(const Vec3& centre, std::string& note) {
        auto up = lifted(scene_, settings_, centre);
        if (up && open_floor().in_solid(up->centre)) up.reset();
        const double limit = longest_push * settings_.radii.y();
        auto out =
            pushed_out(scene_, settings_, centre, up ? std::min(up->distance, limit) : limit, all_tried_);
        if (out && open_floor().in_solid(out->centre)) out.reset();
        if (!up && !out) return std::nullopt;
        const bool sideways = out && (!up || out->distance < up->distance);
        note = fmt::format(" {} {}", sideways ? "pushed out of the level by" : "lifted onto the floor by",
                           metres(sideways ? out->distance : up->distance));
        return sideways ? out->centre : up->centre;
    }

    Start elsewhere(Start start, const std::string& why) {
        const auto floor = open_floor().best(all_tried_);
        if (floor) {
            start.position = *floor - offset_;
            start.yaw = open_yaw(scene_, *floor);
            start.note = why + "; the player begins on open floor, with most of the level within reach";
            const auto below = cast_ray(scene_.collision, *floor, {0.0, -1.0, 0.0});
            if (below && below->back_face)
                start.note +=
                    ". Its faces look down: the level is upside down or inside out; import it with "
                    "another axis or flipped";
        } else {
            start.stands = false;
            start.note = why + ", and there is no floor with room for the player: the player falls";
        }
        if (!all_tried_) start.note += ". Too many triangles lie in one place to look everywhere";
        return start;
    }

    const MovementScene& scene_;
    const Vec3& offset_;
    const MovementSettings& settings_;
    std::optional<OpenFloor> open_floor_;
    bool all_tried_ = true;
};

}  // namespace

std::vector<Spawn> all_spawns(const Level& level) {
    std::vector<Spawn> spawns;
    if (has_spawn(level)) spawns.push_back({level.spawn, level.spawn_yaw, level.spawn_name});
    spawns.insert(spawns.end(), level.more_spawns.begin(), level.more_spawns.end());
    return spawns;
}

void set_spawns(Level& level, std::vector<Spawn> spawns) {
    level.spawn_is_set = !spawns.empty();
    const Spawn first = spawns.empty() ? Spawn{} : spawns.front();
    level.spawn = first.position;
    level.spawn_yaw = first.yaw;
    level.spawn_name = first.name;
    if (!spawns.empty()) spawns.erase(spawns.begin());
    level.more_spawns = std::move(spawns);
}

std::string spawns_problem(std::span<const Spawn> spawns) {
    if (spawns.size() > max_spawns)
        return fmt::format("found {} spawns, expected at most {}", spawns.size(), max_spawns);
    std::set<std::string_view> names;
    for (const Spawn& spawn : spawns) {
        if (spawn.name.empty()) return "A spawn needs a name";
        if (!names.insert(spawn.name).second)
            return fmt::format("Another spawn is called \"{}\"", spawn.name);
        if (!(spawn.position.cwiseAbs().maxCoeff() <= max_spawn_position) || !std::isfinite(spawn.yaw))
            return fmt::format("The spawn \"{}\" has an invalid position: not finite, or beyond 1e9 m",
                               spawn.name);
    }
    return {};
}

Vec3 centre_on(const Vec3& point, const Vec3& normal, const MovementSettings& settings) {
    // The point of an ellipsoid whose outward normal is -normal lies at centre - R^2 normal / |R normal|.
    const Vec3 scaled = settings.radii.cwiseProduct(normal);
    return point + settings.radii.cwiseProduct(scaled) / scaled.norm() + normal * settings.skin;
}

Result<Start> find_start(const Level& level, const MovementScene& scene, const Vec3& offset,
                         const MovementSettings& settings, std::string_view name) {
    StartFinder finder(scene, offset, settings);
    const std::vector<Spawn> spawns = all_spawns(level);
    if (name.empty()) return spawns.empty() ? finder.without_spawn() : finder.at(spawns.front());
    std::string names;
    constexpr std::size_t max_listed = 20;
    for (std::size_t i = 0; i < spawns.size(); ++i) {
        if (spawns[i].name == name) return finder.at(spawns[i]);
        if (i < max_listed) names += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", spawns[i].name);
        if (i == max_listed) names += fmt::format(" or one of {} more", spawns.size() - i);
    }
    return Error{"spawn", fmt::format("found no spawn \"{}\", expected {}", name,
                                      names.empty() ? "none, the level has no spawn" : names)};
}

Result<Start> find_start(const Level& level, LevelScene& scene, const MovementSettings& settings,
                         std::string_view name) {
    return find_start(level, scene.at(0.0), scene.offset(), settings, name);
}

Result<Start> settle_start(Level& level, std::string_view name) {
    Result<LevelScene> scene = LevelScene::build(level);
    if (!scene) return scene.error();
    Result<Start> start = find_start(level, *scene, level.movement, name);
    if (!start) return start;
    level.spawn = start->position;
    level.spawn_yaw = start->yaw;
    level.spawn_is_set = true;
    return start;
}

}  // namespace slipface
