// Motions that put the planes of painted faces onto planes of the mesh, to be tried.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "area_fit.h"

namespace slipface {
namespace {

constexpr std::size_t max_directions = 24, max_turns = 32, max_planes = 60, flat_sides = 4;
constexpr std::size_t max_faces = 5'000;   // the largest, of which directions are made
constexpr double one_direction = 0.99992;  // the cosine of 0.7 degrees
constexpr double flat_enough = 0.02;       // of the area: what is not in the direction of a floor
constexpr double near_axis = 0.98;         // the cosine of 11 degrees
constexpr double steep = 0.6;              // the sine of an edge's slope
constexpr double few_planes = 0.3;         // of the area: less than this in common directions is a hill

// The frame of two directions.
Eigen::Matrix3d frame(const Vec3& a, const Vec3& b) {
    Eigen::Matrix3d axes;
    axes.col(0) = a;
    axes.col(2) = a.cross(b).normalized();
    axes.col(1) = axes.col(2).cross(a);
    return axes;
}

void add_turn(std::vector<Eigen::Matrix3d>& turns, const Eigen::Matrix3d& turn) {
    for (const Eigen::Matrix3d& known : turns)
        if ((known - turn).norm() < 0.01) return;
    turns.push_back(turn);
}

// The mean of a hill's normals; the axis that it is near.
template <class Faces>
Vec3 mean_normal(const Faces& faces) {
    Vec3 sum = Vec3::Zero();
    for (const auto& face : faces)
        sum += face.area * face.normal;
    const Vec3 mean = unit_or_zero(sum.normalized());
    const Vec3 axis = mean.array().round();
    return axis.dot(mean) > near_axis ? axis : mean;
}

// The direction across `normal` along which the points' box is smallest: that of a rectangle's side.
Vec3 side_of_rectangle(const std::vector<Vec3>& points, const Vec3& normal) {
    constexpr int steps = 180;  // of a right angle
    const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
    Vec3 best = x;
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < steps; ++i) {
        // Along the side of a square, which is as good as a circle.
        const double t = 2.0 * i / steps - 1.0;
        const Vec3 along = (x + t * y).normalized(), across = normal.cross(along);
        double ends[4] = {1e300, -1e300, 1e300, -1e300};
        for (const Vec3& point : points) {
            const double u = along.dot(point), v = across.dot(point);
            ends[0] = std::min(ends[0], u);
            ends[1] = std::max(ends[1], u);
            ends[2] = std::min(ends[2], v);
            ends[3] = std::max(ends[3], v);
        }
        const double area = (ends[1] - ends[0]) * (ends[3] - ends[2]);
        if (area >= smallest) continue;
        smallest = area;
        best = along;
    }
    return best;
}

// The directions of edges as they are seen along `normal`, either way, the ones of most length first.
std::vector<Vec3> edge_directions(const std::vector<Vec3>& edges, const Vec3& normal, std::size_t most) {
    struct Bundle {
        Vec3 along;
        double length;
    };
    std::vector<Vec3> sorted;
    for (const Vec3& edge : edges)
        if (std::abs(edge.dot(normal)) < steep * edge.norm())
            sorted.push_back(edge - normal.dot(edge) * normal);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Vec3& a, const Vec3& b) { return a.squaredNorm() > b.squaredNorm(); });
    std::vector<Bundle> bundles;
    for (const Vec3& edge : sorted) {
        const double length = edge.norm();
        const auto found = std::find_if(bundles.begin(), bundles.end(), [&](const Bundle& bundle) {
            return std::abs(bundle.along.dot(edge)) > one_direction * length;
        });
        if (found != bundles.end())
            found->length += length;
        else if (bundles.size() < 4 * most)
            bundles.push_back({edge / length, length});
    }
    std::stable_sort(bundles.begin(), bundles.end(),
                     [](const Bundle& a, const Bundle& b) { return a.length > b.length; });
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < bundles.size() && i < most; ++i)
        directions.push_back(bundles[i].along);
    return directions;
}

}  // namespace

void AreaFit::find_directions(Side& side) {
    std::stable_sort(side.faces.begin(), side.faces.end(),
                     [](const Face& a, const Face& b) { return a.area > b.area; });
    if (side.faces.size() > max_faces) side.faces.resize(max_faces);
    for (const Face& face : side.faces) {
        auto found = std::find_if(
            side.directions.begin(), side.directions.end(),
            [&](const Direction& known) { return known.normal.dot(face.normal) > one_direction; });
        if (found == side.directions.end()) {
            if (side.directions.size() == 4 * max_directions) continue;
            found = side.directions.insert(found, {face.normal, 0.0, {}});
        }
        found->area += face.area;
        found->of_material[face.material] += face.area;
    }
    std::stable_sort(side.directions.begin(), side.directions.end(),
                     [](const Direction& a, const Direction& b) { return a.area > b.area; });
    side.kinds = side.directions.size();
    if (side.directions.size() > max_directions) side.directions.resize(max_directions);
}

std::vector<Eigen::Matrix3d> AreaFit::turns() const {
    double all = 0.0, common = 0.0, other = 0.0;
    for (const Face& face : old_.faces)
        all += face.area;
    for (const Direction& direction : old_.directions) {
        common += direction.area;
        if (std::abs(direction.normal.dot(old_.directions[0].normal)) < one_direction)
            other += direction.area;
    }
    const bool hill =
        common < few_planes * all || (old_.kinds > max_directions && 2 * old_.kinds > old_.faces.size());
    if (hill) return turns_of_edges(mean_normal(old_.faces), mean_normal(new_.faces));
    if (other >= flat_enough * all) return turns_of_pairs();
    std::vector<Eigen::Matrix3d> turns;
    for (std::size_t i = 0; i < new_.directions.size() && i < flat_sides; ++i) {
        const Direction& side = new_.directions[i];
        if (side.area < 0.2 * new_.directions[0].area) break;
        for (const Eigen::Matrix3d& turn : turns_of_edges(old_.directions[0].normal, side.normal))
            add_turn(turns, turn);
    }
    return turns;
}

// How much painted area is in directions in which the mesh has faces of its material.
double AreaFit::shared_area(const Eigen::Matrix3d& turn) const {
    double shared = 0.0;
    for (const Direction& direction : old_.directions) {
        const Vec3 normal = turn * direction.normal;
        for (const Direction& other : new_.directions) {
            if (other.normal.dot(normal) < 0.9995) continue;
            for (const auto& [material, area] : direction.of_material) {
                const auto found = other.of_material.find(material);
                if (found != other.of_material.end()) shared += std::min(area, found->second);
            }
        }
    }
    return shared;
}

std::vector<Eigen::Matrix3d> AreaFit::turns_of_pairs() const {
    constexpr std::size_t pairs = 3;
    struct Pair {
        const Vec3 *a, *b;
        double weight;
    };
    std::vector<Pair> old;
    for (std::size_t i = 0; i < old_.directions.size(); ++i)
        for (std::size_t k = i + 1; k < old_.directions.size(); ++k) {
            const Direction &a = old_.directions[i], &b = old_.directions[k];
            const double sine = a.normal.cross(b.normal).norm();
            if (sine > 0.3) old.push_back({&a.normal, &b.normal, sine * std::min(a.area, b.area)});
        }
    std::stable_sort(old.begin(), old.end(),
                     [](const Pair& a, const Pair& b) { return a.weight > b.weight; });
    std::vector<Eigen::Matrix3d> all;
    for (std::size_t i = 0; i < old.size() && i < pairs; ++i)
        for (const Direction& a : new_.directions)
            for (const Direction& b : new_.directions)
                if (std::abs(a.normal.dot(b.normal) - old[i].a->dot(*old[i].b)) < 0.01)
                    add_turn(all, frame(a.normal, b.normal) * frame(*old[i].a, *old[i].b).transpose());
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < all.size(); ++i)
        order.push_back({-shared_area(all[i]), i});
    std::sort(order.begin(), order.end());
    std::vector<Eigen::Matrix3d> best;
    for (std::size_t i = 0; i < order.size() && i < max_turns; ++i)
        best.push_back(all[order[i].second]);
    return best;
}

// Of a floor or a hill, which looks in one direction: by its edges, too.
std::vector<Eigen::Matrix3d> AreaFit::turns_of_edges(const Vec3& old_normal, const Vec3& new_normal) const {
    constexpr std::size_t old_edges = 2, new_edges = 10;
    std::vector<Eigen::Matrix3d> turns;
    if (old_normal.isZero() || new_normal.isZero()) return turns;
    const auto add = [&](const Vec3& from, const Vec3& to) {
        for (const double sign : {1.0, -1.0})
            add_turn(turns, frame(new_normal, sign * to) * frame(old_normal, from).transpose());
    };
    for (const Vec3& from : edge_directions(old_.edges, old_normal, old_edges))
        for (const Vec3& to : edge_directions(new_.edges, new_normal, new_edges))
            add(from, to);
    const Vec3 from = side_of_rectangle(old_.corners, old_normal),
               to = side_of_rectangle(new_.corners, new_normal);
    add(from, to);
    add(from, new_normal.cross(to));
    return turns;
}

std::vector<Vec3> AreaFit::offsets(const Eigen::Matrix3d& turn) const {
    double all = 0.0;
    for (const Direction& direction : old_.directions)
        all += direction.area;
    // Three directions that are far from a plane.
    Vec3 normals[3] = {old_.directions[0].normal, Vec3::Zero(), Vec3::Zero()};
    for (const bool last : {false, true}) {
        double best = flat_enough * all;
        for (const Direction& direction : old_.directions) {
            const Vec3 across = normals[0].cross(last ? normals[1] : direction.normal);
            const double room = last ? std::abs(across.dot(direction.normal)) : across.norm();
            if (room < 0.2 || room * direction.area <= best) continue;
            best = room * direction.area;
            normals[last ? 2 : 1] = direction.normal;
        }
        if (normals[last ? 2 : 1].isZero()) return offsets_of_corners(turn);
    }
    return offsets_of_planes(turn, normals);
}

// The planes across `normal`, of both sides, the ones of most area.
std::vector<AreaFit::Plane> AreaFit::planes(const Side& side, const Vec3& normal, double slack) {
    std::vector<Plane> all;
    for (const Face& face : side.faces) {
        const double along = face.normal.dot(normal);
        if (std::abs(along) < 0.9995) continue;
        // Both sides of a wall are different materials here.
        all.push_back({normal.dot(face.centroid), face.area, 2 * face.material + (along > 0.0 ? 1 : 0)});
    }
    std::sort(all.begin(), all.end(), [](const Plane& a, const Plane& b) {
        return std::tuple(a.material, a.offset, a.area) < std::tuple(b.material, b.offset, b.area);
    });
    std::vector<Plane> merged;
    for (const Plane& plane : all) {
        if (!merged.empty() && merged.back().material == plane.material &&
            plane.offset - merged.back().offset < slack)
            merged.back().area += plane.area;
        else
            merged.push_back(plane);
    }
    std::stable_sort(merged.begin(), merged.end(),
                     [](const Plane& a, const Plane& b) { return a.area > b.area; });
    if (merged.size() > max_planes) merged.resize(max_planes);
    return merged;
}

std::vector<Vec3> AreaFit::offsets_of_planes(const Eigen::Matrix3d& turn, const Vec3 (&normals)[3]) const {
    constexpr std::size_t peaks = 3;
    const double slack = 0.2 * slack_;
    Eigen::Matrix3d rows;
    std::vector<double> steps[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 after = turn * normals[axis];
        rows.row(axis) = after.transpose();
        std::vector<std::pair<double, double>> votes;  // step, area
        const std::vector<Plane> there = planes(new_, after, slack);
        for (const Plane& from : planes(old_, normals[axis], slack))
            for (const Plane& to : there)
                if (from.material == to.material)
                    votes.push_back({to.offset - from.offset, std::min(from.area, to.area)});
        std::sort(votes.begin(), votes.end());
        // Windows of twice the slack, the one of most area first.
        for (std::size_t peak = 0; peak < peaks; ++peak) {
            double best = 0.0, at = 0.0, sum = 0.0;
            for (std::size_t begin = 0, end = 0; begin < votes.size(); ++begin) {
                for (; end < votes.size() && votes[end].first <= votes[begin].first + 2.0 * slack; ++end)
                    sum += votes[end].second;
                if (sum > best * (1.0 + 1e-9)) {
                    best = sum;
                    double mean = 0.0;
                    for (std::size_t k = begin; k < end; ++k)
                        mean += votes[k].second * votes[k].first;
                    at = mean / sum;
                }
                sum -= votes[begin].second;
            }
            if (best <= 0.0) break;
            steps[axis].push_back(at);
            std::erase_if(votes, [&](const auto& vote) { return std::abs(vote.first - at) <= 2.0 * slack; });
        }
    }
    const Eigen::Matrix3d inverse = rows.inverse();
    std::vector<Vec3> offsets;
    if (!inverse.allFinite()) return offsets;
    for (const double x : steps[0])
        for (const double y : steps[1])
            for (const double z : steps[2])
                offsets.emplace_back(inverse * Vec3(x, y, z));
    return offsets;
}

// The steps that put most corners onto corners, among those that keep the mesh's corners in the box of the
// parts.
std::vector<Vec3> AreaFit::offsets_of_corners(const Eigen::Matrix3d& turn) const {
    constexpr std::size_t peaks = 4;
    constexpr double max_cells = 30'000.0;
    // Everything here is turned back: a step takes a corner of the mesh to where it was.
    std::vector<Vec3> back;
    for (const Vec3& corner : new_.corners)
        back.emplace_back(turn.transpose() * corner);
    const Vec3 room = Vec3::Constant(box_room() + slack_);
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> along;
        for (const Vec3& corner : back)
            along.push_back(corner[axis]);
        std::sort(along.begin(), along.end());
        const std::size_t outside = along.size() / 50;
        low[axis] = box_.min[axis] - along[outside] - room[axis];
        high[axis] = box_.max[axis] - along[along.size() - 1 - outside] + room[axis];
    }
    if (!(low.array() < high.array()).all() || !(high - low).allFinite()) return {};
    double cell = slack_;
    const auto cells = [&] { return ((high - low) / cell).array().ceil() + 2.0; };
    while (cells().prod() > max_cells)
        cell *= 1.2;
    const Eigen::Vector3i count = cells().cast<int>();
    std::vector<std::uint32_t> votes(static_cast<std::size_t>(count.prod()), 0);
    const auto index = [&](int x, int y, int z) {
        return static_cast<std::size_t>((x * count.y() + y) * count.z() + z);
    };
    for (const Vec3& from : old_.corners) {
        for (const Vec3& to : back) {
            const Vec3 step = from - to;
            if (!((step.array() >= low.array()).all() && (step.array() < high.array()).all())) continue;
            const Eigen::Vector3i at = ((step - low) / cell).cast<int>();
            // The ends of the cell, so that no edge of cells divides what is near.
            for (int k = 0; k < 8; ++k)
                ++votes[index(at.x() + (k & 1), at.y() + (k >> 1 & 1), at.z() + (k >> 2))];
        }
    }
    // The middle, too: the turn may be known too little for corners to meet.
    std::vector<Vec3> offsets{turn * (-0.5 * (low + high))};
    for (std::size_t peak = 0; peak < peaks; ++peak) {
        const auto best = std::max_element(votes.begin(), votes.end());
        if (*best < 3) break;
        const int at = static_cast<int>(best - votes.begin());
        const int x = at / (count.y() * count.z()), y = at / count.z() % count.y(), z = at % count.z();
        const Vec3 rough = low + cell * Vec3(x, y, z);
        Vec3 sum = Vec3::Zero();
        double found = 0.0;
        for (const Vec3& from : old_.corners) {
            for (const Vec3& to : back) {
                if ((from - to - rough).cwiseAbs().maxCoeff() > cell) continue;
                sum += from - to;
                found += 1.0;
            }
        }
        if (found > 0.0) offsets.emplace_back(turn * (-sum / found));
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                for (int k = -1; k <= 1; ++k)
                    if (x + i >= 0 && x + i < count.x() && y + j >= 0 && y + j < count.y() && z + k >= 0 &&
                        z + k < count.z())
                        votes[index(x + i, y + j, z + k)] = 0;
    }
    return offsets;
}

}  // namespace slipface
