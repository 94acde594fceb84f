#include "open_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "slipface/level/find_start.h"

namespace slipface {

namespace {

constexpr double nearly_all = 0.7;  // of what is reached from the best start
constexpr double height_weight = 2.0;
constexpr double sure_jump = 0.9;            // of the highest jump
constexpr std::size_t max_arc_cells = 16;    // of a jump, along its direction
constexpr std::size_t max_searched = 64;     // regions from which everything reached is counted
constexpr std::size_t max_ways = 2'000'000;  // followed for that
constexpr std::size_t max_stood_at = 400;
constexpr std::array<std::array<int, 2>, 4> sides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

}  // namespace

OpenFloor::OpenFloor(const MovementScene& scene, const MovementSettings& settings)
    : scene_(scene), settings_(settings), columns_(floor_columns(scene, settings)) {
    step_ = settings.step_up ? settings.step_height : settings.skin;
    const double gravity = std::max(settings.gravity, 1e-3);
    jump_ = std::max(step_, sure_jump * settings.jump_speed * settings.jump_speed / (2.0 * gravity));
    connect();
    attribute();
    judge();
}

std::size_t OpenFloor::root(std::size_t i) {
    while (parent_[i] != i)
        i = parent_[i] = parent_[parent_[i]];
    return i;
}

bool OpenFloor::walks(const FloorColumns::Place& a, const FloorColumns::Place& b) const {
    if (!a.floor || !b.floor) return false;
    if (std::abs(a.top - b.top) > step_ + std::max(a.rise, b.rise)) return false;
    return std::min(a.ceiling, b.ceiling) - std::max(a.top, b.top) >= columns_.body;
}

// Visits the places on which a jump from `from` along (dx, dz) may end: as high as the jump until its highest
// point, and then on its parabola.
template <class Visit>
void OpenFloor::arcs(std::size_t cell, const FloorColumns::Place& from, int dx, int dz, Visit visit) const {
    const double headroom = from.ceiling - from.top - columns_.body;
    const double height = std::min(jump_, std::max(0.0, headroom));
    const double gravity = std::max(settings_.gravity, 1e-3), speed = std::max(settings_.walk_speed, 1e-3);
    const double to_apex = std::sqrt(2.0 * height / gravity) * speed;
    auto column = static_cast<int>(cell % static_cast<std::size_t>(columns_.columns));
    auto row = static_cast<int>(cell / static_cast<std::size_t>(columns_.columns));
    for (std::size_t k = 1; k <= max_arc_cells; ++k) {
        column += dx;
        row += dz;
        if (column < 0 || row < 0 || column >= columns_.columns || row >= columns_.rows) return;
        const double beyond = std::max(0.0, static_cast<double>(k - 1) * columns_.cell - to_apex) / speed;
        const double feet = from.top + height - 0.5 * gravity * beyond * beyond;
        const std::size_t at = columns_.cell_at(column, row);
        const auto places = columns_.places_in(at);
        if (places.empty()) continue;
        // The highest that is not above the feet.
        std::size_t i = places.size();
        while (i > 0 && places[i - 1].top > feet)
            --i;
        if (i == 0) return;
        const FloorColumns::Place& place = places[i - 1];
        const double low = std::max(place.top, std::min(feet, from.top));
        if (place.ceiling - low < columns_.body) return;
        if (place.floor) visit(columns_.first[at] + i - 1);
        if (place.ceiling - feet < columns_.body && place.top > from.top) return;
    }
}

void OpenFloor::connect() {
    parent_.resize(columns_.places.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    region_.assign(columns_.places.size(), no_id);
    const auto each = [&](const auto& visit) {
        for (int row = 0; row < columns_.rows; ++row)
            for (int column = 0; column < columns_.columns; ++column) {
                const std::size_t at = columns_.cell_at(column, row);
                for (std::size_t i = columns_.first[at]; i < columns_.first[at + 1]; ++i)
                    if (columns_.places[i].floor) visit(column, row, at, i);
            }
    };
    const auto neighbour = [&](int column, int row,
                               const std::array<int, 2>& side) -> std::optional<std::size_t> {
        const int x = column + side[0], z = row + side[1];
        if (x < 0 || z < 0 || x >= columns_.columns || z >= columns_.rows) return std::nullopt;
        return columns_.cell_at(x, z);
    };
    each([&](int column, int row, std::size_t, std::size_t i) {
        for (std::size_t side = 0; side < 2; ++side) {
            const auto to = neighbour(column, row, sides[side]);
            if (!to) continue;
            for (std::size_t k = columns_.first[*to]; k < columns_.first[*to + 1]; ++k) {
                if (!walks(columns_.places[i], columns_.places[k])) continue;
                const std::size_t a = root(i), b = root(k);
                parent_[std::max(a, b)] = std::min(a, b);
            }
        }
    });
    for (std::size_t i = 0; i < columns_.places.size(); ++i) {
        if (!columns_.places[i].floor) continue;
        if (const std::size_t top = root(i); top == i) {
            region_[i] = static_cast<std::uint32_t>(regions_.size());
            regions_.emplace_back();
        } else {
            region_[i] = region_[top];
        }
    }
    each([&](int column, int row, std::size_t at, std::size_t i) {
        for (const auto& side : sides) {
            const auto to = neighbour(column, row, side);
            if (!to) continue;
            bool walked = false;
            for (std::size_t k = columns_.first[*to]; k < columns_.first[*to + 1]; ++k)
                walked = walked || walks(columns_.places[i], columns_.places[k]);
            if (walked) continue;
            arcs(at, columns_.places[i], side[0], side[1], [&](std::size_t k) {
                if (region_[k] != region_[i]) ways_.emplace_back(region_[i], region_[k]);
            });
        }
    });
    std::sort(ways_.begin(), ways_.end());
    ways_.erase(std::unique(ways_.begin(), ways_.end()), ways_.end());
}

std::uint32_t OpenFloor::region_near(std::size_t cell, double y) const {
    const auto in_cell = [&](std::size_t at) {
        for (std::size_t i = columns_.first[at]; i < columns_.first[at + 1]; ++i) {
            const FloorColumns::Place& place = columns_.places[i];
            if (place.floor && std::abs(place.top - y) <= step_ + place.rise) return region_[i];
        }
        return no_id;
    };
    if (const std::uint32_t region = in_cell(cell); region != no_id) return region;
    const auto columns = static_cast<std::size_t>(columns_.columns);
    const auto column = static_cast<int>(cell % columns), row = static_cast<int>(cell / columns);
    for (const auto& [dx, dz] : sides) {
        const int x = column + dx, z = row + dz;
        if (x < 0 || z < 0 || x >= columns_.columns || z >= columns_.rows) continue;
        if (const std::uint32_t region = in_cell(columns_.cell_at(x, z)); region != no_id) return region;
    }
    return no_id;
}

// Floor beside a wall, where no whole cell is free, counts for the region beside it.
void OpenFloor::attribute() {
    for (std::size_t i = 0; i < columns_.standings.size(); ++i) {
        const FloorColumns::Standing& standing = columns_.standings[i];
        const std::uint32_t at = region_near(standing.cell, standing.y);
        if (at == no_id) continue;
        Region& region = regions_[at];
        ++region.cells;
        region.front += standing.front ? 1 : 0;
        region.inside += std::min(standing.from_above, standing.from_below) >= 1 ? 1 : 0;
        region.inverted += std::max(standing.from_above, standing.from_below) <= -1 ? 1 : 0;
        Spot spot{i, at, 0};
        const auto columns = static_cast<std::size_t>(columns_.columns);
        const auto column = static_cast<int>(standing.cell % columns),
                   row = static_cast<int>(standing.cell / columns);
        for (const auto& [dx, dz] : sides) {
            const int x = column + dx, z = row + dz;
            if (x < 0 || z < 0 || x >= columns_.columns || z >= columns_.rows) continue;
            const std::size_t to = columns_.cell_at(x, z);
            for (std::size_t k = columns_.first[to]; k < columns_.first[to + 1]; ++k)
                spot.links += region_[k] == at && std::abs(columns_.places[k].top - standing.y) <=
                                                      step_ + columns_.places[k].rise
                                  ? 1
                                  : 0;
        }
        spots_.push_back(spot);
    }
}

void OpenFloor::judge() {
    const double area = columns_.cell * columns_.cell;
    std::vector<std::uint32_t> order(regions_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return regions_[a].cells > regions_[b].cells; });
    order.resize(std::min(order.size(), max_searched));
    std::vector<std::uint32_t> seen(regions_.size(), no_id), open;
    std::size_t followed = 0;
    for (const std::uint32_t from : order) {
        if (regions_[from].cells == 0 || followed > max_ways) break;
        open.assign(1, from);
        seen[from] = from;
        std::size_t cells = 0;
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            open.pop_back();
            cells += regions_[at].cells;
            for (auto way = std::lower_bound(ways_.begin(), ways_.end(), std::pair(at, 0u));
                 way != ways_.end() && way->first == at; ++way, ++followed) {
                if (seen[way->second] == from) continue;
                seen[way->second] = from;
                open.push_back(way->second);
            }
        }
        regions_[from].reached = static_cast<double>(cells) * area;
    }
    // As the faces are wound, and if that gives less than half as much, wound the other way round throughout.
    double best[2] = {0.0, 0.0};
    const auto fits_reading = [](const Region& region, bool backs) {
        const bool front = 2 * region.front >= region.cells;
        const bool solid = 2 * region.inside > region.cells, inverted = 2 * region.inverted > region.cells;
        return backs ? !front && !solid && !inverted : front && !solid;
    };
    for (const Region& region : regions_)
        for (const bool backs : {false, true})
            if (fits_reading(region, backs))
                best[backs ? 1 : 0] = std::max(best[backs ? 1 : 0], region.reached);
    const bool backs = best[0] < 0.5 * best[1];
    const double most = best[backs ? 1 : 0];
    const double smallest = settings_.radii.x() * settings_.radii.z();
    for (Region& region : regions_) {
        region.solid = 2 * (backs ? region.inverted : region.inside) > region.cells;
        region.candidate = fits_reading(region, backs);
        region.good = region.candidate && region.reached >= nearly_all * most && region.reached >= smallest;
    }
}

// The region in whose room the centre is, in the cell moved by (dx, dz); null: none.
const OpenFloor::Region* OpenFloor::region_around(const Vec3& centre, int dx, int dz) const {
    if (columns_.places.empty()) return nullptr;
    const double x = (centre.x() - columns_.origin.x()) / columns_.cell + dx;
    const double z = (centre.z() - columns_.origin.y()) / columns_.cell + dz;
    if (!(x >= 0 && z >= 0 && x < columns_.columns && z < columns_.rows)) return nullptr;
    const std::size_t at = columns_.cell_at(static_cast<int>(x), static_cast<int>(z));
    for (std::size_t i = columns_.first[at]; i < columns_.first[at + 1]; ++i) {
        const FloorColumns::Place& place = columns_.places[i];
        if (place.top <= centre.y() && centre.y() <= place.ceiling)
            return region_[i] == no_id ? nullptr : &regions_[region_[i]];
    }
    return nullptr;
}

bool OpenFloor::is_good(const Vec3& centre) const {
    const auto good = [&](int dx, int dz) {
        const Region* region = region_around(centre, dx, dz);
        return region != nullptr && region->good;
    };
    // Beside a wall the cell itself has no place.
    return good(0, 0) ||
           std::any_of(sides.begin(), sides.end(), [&](const auto& side) { return good(side[0], side[1]); });
}

bool OpenFloor::in_solid(const Vec3& centre) const {
    const Region* region = region_around(centre, 0, 0);
    return region != nullptr && region->solid;
}

std::optional<Vec3> OpenFloor::stand_at(const FloorColumns::Standing& standing) const {
    const auto [x, z] = columns_.middle(standing.cell);
    // Above small bumps of the floor around the point.
    const double lift = 0.25 * settings_.radii.y();
    Vec3 point(x, standing.y, z), normal = Vec3::UnitY();
    if (const auto hit = cast_ray(scene_.collision, point + Vec3(0, lift, 0), {0.0, -1.0, 0.0}, 2.0 * lift)) {
        point = hit->point;
        normal = hit->normal;
    } else if (scene_.heightfield != nullptr && settings_.heightfield) {
        if (const auto ground = terrain_at(*scene_.heightfield, x, z)) {
            point.y() = ground->height;
            normal = ground->normal;
        }
    }
    if (normal.y() < std::cos(settings_.max_slope)) return std::nullopt;
    const double standing_on = centre_on(Vec3::Zero(), normal, settings_).dot(normal) / normal.y();
    const Vec3 above = point + Vec3(0.0, standing_on + lift, 0.0);
    if (!has_room(scene_, settings_, settings_.radii, above)) return std::nullopt;
    const auto landed = drop(scene_, settings_, above, 2.0 * lift + settings_.skin);
    if (!landed || !fits(scene_, settings_, *landed)) return std::nullopt;
    return landed;
}

std::optional<Vec3> OpenFloor::best(bool& all_tried) const {
    // Of good floors the larger ones: a crate from which all is reached is a poor place to begin.
    std::size_t largest = 0;
    for (const Region& region : regions_)
        if (region.good) largest = std::max(largest, region.cells);
    const auto is_large = [&](const Spot& spot) {
        return regions_[spot.region].good && 2 * regions_[spot.region].cells >= largest;
    };
    double lowest = std::numeric_limits<double>::infinity();
    for (const Spot& spot : spots_)
        if (is_large(spot)) lowest = std::min(lowest, columns_.standings[spot.standing].y);
    struct Candidate {
        bool open = false;
        double cost = 0.0;
        std::size_t standing = 0;
        bool operator<(const Candidate& other) const {
            if (open != other.open) return open;
            return cost != other.cost ? cost < other.cost : standing < other.standing;
        }
    };
    std::vector<Candidate> candidates;
    const Vec3 middle = 0.5 * (columns_.bounds.min + columns_.bounds.max);
    for (const Spot& spot : spots_) {
        if (!is_large(spot)) continue;
        const FloorColumns::Standing& standing = columns_.standings[spot.standing];
        const auto [x, z] = columns_.middle(standing.cell);
        const Vec3 away(x - middle.x(), height_weight * (standing.y - lowest), z - middle.z());
        candidates.push_back({spot.links >= 4, away.squaredNorm(), spot.standing});
    }
    std::sort(candidates.begin(), candidates.end());
    SearchEffort effort;
    std::size_t tried = 0;
    for (const Candidate& candidate : candidates) {
        const FloorColumns::Standing& standing = columns_.standings[candidate.standing];
        const auto [x, z] = columns_.middle(standing.cell);
        const Vec3 at(x, standing.y + settings_.radii.y(), z);
        const Vec3 reach = 1.5 * settings_.radii;
        if (tried++ == max_stood_at || !effort.spend(crowd_in(scene_, {at - reach, at + reach}))) {
            all_tried = false;
            return std::nullopt;
        }
        if (const auto landed = stand_at(standing)) return landed;
    }
    return std::nullopt;
}

std::optional<Vec3> find_open_floor(const MovementScene& scene, const MovementSettings& settings,
                                    bool* all_tried) {
    bool all = true;
    const auto floor = OpenFloor(scene, settings).best(all);
    if (all_tried != nullptr) *all_tried = *all_tried && all;
    return floor;
}

}  // namespace slipface
