#include "area_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr std::size_t few_samples = 24, many_samples = 320;  // points
constexpr std::size_t max_tried = 24, max_found = 6;
constexpr std::size_t max_old_corners = 240, max_new_corners = 900, max_edges = 4000;
constexpr double off_plane = 0.08;   // of a face's size
constexpr double nearly = 0.06;      // of the painted area
constexpr double inside_box = 0.95;  // of the mesh's corners

// Every n-th of `list`, so that at most `most` are left.
template <class T>
void thin_out(std::vector<T>& list, std::size_t most) {
    if (list.size() <= most) return;
    for (std::size_t i = 0; i < most; ++i)
        list[i] = list[i * list.size() / most];
    list.resize(most);
}

// Leaves one of those that are nearly the same, the first.
void remove_near(std::vector<Vec3>& points, double distance) {
    std::map<std::array<long long, 3>, Vec3> kept;
    std::erase_if(points, [&](const Vec3& point) {
        const auto cell = [&](int axis) { return std::llround(point[axis] / distance); };
        return !kept.emplace(std::array{cell(0), cell(1), cell(2)}, point).second;
    });
}

}  // namespace

AreaFit::AreaFit(FaceLookup& lookup, SurfaceTable surfaces, const PaintParts& parts,
                 const std::vector<StoredOverride>& stored)
    : lookup_(lookup),
      mesh_(lookup.mesh),
      index_(lookup.index),
      parts_(parts),
      stored_(stored),
      surfaces_(surfaces),
      painted_(parts.parts.size()) {
    for (const Material& of : mesh_.materials)
        of_mesh_.push_back(material(base_material(of.name, surfaces)));
    for (std::size_t i = 0; i < stored.size() && i < parts.of.size(); ++i)
        if (parts.of[i] > 0 && parts.of[i] <= painted_.size())
            painted_[parts.of[i] - 1u].push_back(static_cast<std::uint32_t>(i));
}

std::uint32_t AreaFit::material(const std::string& base) {
    return materials_.emplace(base, static_cast<std::uint32_t>(materials_.size())).first->second;
}

void AreaFit::collect_old(std::span<const std::size_t> parts) {
    old_ = {};
    box_ = {};
    exact_.clear();
    std::vector<double> extents;
    for (const std::size_t part : parts) {
        box_.add(parts_.parts[part].box.min);
        box_.add(parts_.parts[part].box.max);
        for (const std::uint32_t i : painted_[part]) {
            const FaceKey& key = stored_[i].key;
            const Vec3 normal = unit_or_zero(key.normal);
            if (!(key.area > 0.0) || normal.isZero()) continue;
            old_.faces.push_back(
                {key.centroid, normal, key.area, material(base_material(key.material, surfaces_))});
            extents.push_back(std::sqrt(key.area));
            if (i >= parts_.outlines.count()) continue;
            for (const Vec3& corner : parts_.outlines.corners(i, key))
                old_.corners.push_back(corner);
        }
        for (const AnchorFace& anchor : parts_.parts[part].anchors)
            for (std::size_t c = 0; c < anchor.corners.size(); ++c) {
                exact_.push_back(anchor.corners[c].cast<double>());
                old_.edges.push_back(
                    (anchor.corners[(c + 1) % anchor.corners.size()] - anchor.corners[c]).cast<double>());
            }
    }
    if (extents.empty()) return;
    std::nth_element(extents.begin(), extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2),
                     extents.end());
    face_size_ = extents[extents.size() / 2];
    slack_ = 0.05 * face_size_ + 4.0 * position_tolerance(box_.max);
    old_.corners.insert(old_.corners.begin(), exact_.begin(), exact_.end());
    thin_out(old_.corners, max_edges);
    remove_near(old_.corners, slack_);
    thin_out(old_.corners, max_old_corners);
    thin_out(old_.edges, max_edges);
    thin_out(exact_, max_old_corners);
    find_directions(old_);
}

void AreaFit::collect_new(std::span<const FaceId> places) {
    new_ = {};
    is_place_.assign(mesh_.face_count(), false);
    std::vector<std::uint32_t> vertices;
    for (const FaceId face : places) {
        is_place_[face] = true;
        const FaceKey& key = index_.key(face);
        const Vec3 normal = unit_or_zero(key.normal);
        if (!(key.area > 0.0) || normal.isZero()) continue;
        new_.faces.push_back({key.centroid, normal, key.area, of_mesh_[mesh_.face_material[face]]});
        const std::uint32_t first = mesh_.face_first_corner[face], count = mesh_.face_corner_count(face);
        for (std::uint32_t c = 0; c < count; ++c) {
            vertices.push_back(mesh_.corner_vertex[first + c]);
            new_.edges.push_back(
                (mesh_.corner_position(first + (c + 1) % count) - mesh_.corner_position(first + c))
                    .cast<double>());
        }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    thin_out(vertices, max_new_corners);
    for (const std::uint32_t vertex : vertices)
        new_.corners.push_back(mesh_.positions[vertex].cast<double>());
    thin_out(new_.edges, max_edges);
    find_directions(new_);
}

// Of faces chosen by their area: the centroid, and the middle between it and each corner.
std::vector<AreaFit::Sample> AreaFit::samples_of(std::span<const std::size_t> parts, std::size_t most) const {
    double all = 0.0;
    for (const std::size_t part : parts)
        for (const std::uint32_t i : painted_[part])
            all += stored_[i].key.area;
    std::vector<Sample> samples;
    if (!(all > 0.0 && std::isfinite(all))) return samples;
    const double step = 5.0 * all / static_cast<double>(most);
    double next = 0.5 * step, sum = 0.0;
    for (const std::size_t part : parts) {
        for (const std::uint32_t i : painted_[part]) {
            const FaceKey& key = stored_[i].key;
            sum += key.area;
            if (sum < next) continue;
            const double weight = 1.0 + std::floor((sum - next) / step);  // in steps
            next += weight * step;
            const Vec3 normal = unit_or_zero(key.normal);
            const auto found = materials_.find(base_material(key.material, surfaces_));
            if (normal.isZero() || found == materials_.end()) continue;
            std::vector<Vec3> corners;
            if (i < parts_.outlines.count()) corners = parts_.outlines.corners(i, key);
            if (corners.size() > 4) corners.resize(4);
            const double share = weight / static_cast<double>(corners.size() + 1);
            const double size = std::sqrt(key.area);
            samples.push_back({key.centroid, normal, size, share, found->second});
            for (const Vec3& corner : corners)
                samples.push_back({0.5 * (key.centroid + corner), normal, size, share, found->second});
        }
    }
    return samples;
}

// The face of the sample's material that is at the point; no_id: none.
FaceId AreaFit::face_under(const Sample& sample, const Vec3& point, const Vec3& normal) {
    const Vec3 reach = (off_plane * sample.size * normal.cwiseAbs()).array() + position_tolerance(point);
    Aabb box;
    box.add(point - reach);
    box.add(point + reach);
    FaceId best = no_id;
    double nearest = off_plane * sample.size + position_tolerance(point);
    for (const TriangleId triangle : lookup_.tree()->triangles_in(box)) {
        ++visits_;
        const FaceId face = lookup_.tree()->triangle_face(triangle);
        if (!is_place_[face] || of_mesh_[mesh_.face_material[face]] != sample.material) continue;
        const FaceKey& key = index_.key(face);
        if (!(key.normal.dot(normal) > 0.95) || !index_.covers(face, point, normal)) continue;
        const double off = std::abs(key.normal.dot(key.centroid - point));
        if (off > nearest) continue;
        nearest = off;
        best = face;
    }
    return best;
}

// Zero as soon as it must be below `least`.
double AreaFit::covered(std::span<const Sample> samples, const PartMotion& motion, double least) {
    double all = 0.0, found = 0.0, missed = 0.0;
    for (const Sample& sample : samples)
        all += sample.weight;
    for (const Sample& sample : samples) {
        const Vec3 point = motion(sample.point);
        if (face_under(sample, point, motion.linear * sample.normal) != no_id)
            found += sample.weight;
        else
            missed += sample.weight;
        if (all - missed < least * all) return 0.0;
    }
    return all > 0.0 ? found / all : 0.0;
}

double AreaFit::covered(std::span<const std::size_t> parts, const PartMotion& motion) {
    if (lookup_.tree() == nullptr) return 0.0;
    is_place_.assign(mesh_.face_count(), true);
    return covered(samples_of(parts, many_samples), motion, 0.0);
}

// Whether the mesh's corners were in the box of the parts before the motion.
bool AreaFit::fits_box(const PartMotion& motion) const {
    const Vec3 room = Vec3::Constant(box_room());
    std::size_t inside = 0;
    for (const Vec3& corner : new_.corners) {
        const Vec3 before = motion.linear.transpose() * (corner - motion.offset);
        inside += ((before - box_.min + room).array() >= 0.0).all() &&
                          ((box_.max - before + room).array() >= 0.0).all()
                      ? 1
                      : 0;
    }
    return static_cast<double>(inside) >= inside_box * static_cast<double>(new_.corners.size());
}

// Moves the samples into the planes of the faces that they are on, and the corners onto corners, by least
// squares.
PartMotion AreaFit::refined(std::span<const Sample> samples, PartMotion motion) {
    constexpr double of_corner = 0.1, of_exact = 1.0;  // weights, beside that of a sample of average size
    constexpr int rounds = 8;
    const Vec3 middle = box_.centre();
    for (int round = 0; round < rounds; ++round) {
        Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
        Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
        const Vec3 centre = motion(middle);
        const double size = box_.size().norm();
        const auto add = [&](const Vec3& at, const Vec3& normal, double off, double weight) {
            Eigen::Matrix<double, 6, 1> row;
            row << ((at - centre) / size).cross(normal), normal;
            sum += weight * row * row.transpose();
            right -= weight * off * row;
        };
        for (const Sample& sample : samples) {
            const Vec3 point = motion(sample.point);
            const FaceId face = face_under(sample, point, motion.linear * sample.normal);
            if (face == no_id) continue;
            const FaceKey& key = index_.key(face);
            add(point, key.normal, key.normal.dot(point - key.centroid), sample.weight);
        }
        const bool last = round + 1 == rounds;
        const double reach = (last ? 0.2 : round < 2 ? 4.0 : round < 4 ? 2.0 : 1.0) * slack_;
        for (const std::vector<Vec3>* corners : {&old_.corners, &exact_}) {
            const bool exact = corners == &exact_;
            if (last && !exact) continue;
            for (const Vec3& corner : *corners) {
                const Vec3 point = motion(corner);
                const Vec3* best = nullptr;
                double nearest = reach;
                for (const Vec3& other : new_.corners) {
                    const double distance = (other - point).norm();
                    if (distance > nearest) continue;
                    nearest = distance;
                    best = &other;
                }
                if (best == nullptr) continue;
                for (int axis = 0; axis < 3; ++axis)
                    add(point, Vec3::Unit(axis), (point - *best)[axis], exact ? of_exact : of_corner);
            }
        }
        sum += 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
        const Eigen::Matrix<double, 6, 1> step = sum.ldlt().solve(right);
        if (!step.allFinite()) break;
        const Vec3 spin = step.head<3>() / size;
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        turn.col(0) += spin.cross(Vec3::UnitX());
        turn.col(1) += spin.cross(Vec3::UnitY());
        turn.col(2) += spin.cross(Vec3::UnitZ());
        // Orthogonal again, by Gram and Schmidt.
        turn.col(0).normalize();
        turn.col(1) = (turn.col(1) - turn.col(0).dot(turn.col(1)) * turn.col(0)).normalized();
        turn.col(2) = turn.col(0).cross(turn.col(1));
        if (!turn.allFinite()) break;
        motion.linear = turn * motion.linear;
        motion.offset = centre + step.tail<3>() - motion.linear * middle;
    }
    return motion;
}

// The fraction of the mesh's corners that the motion puts a painted corner onto.
double AreaFit::corners_met(const PartMotion& motion) const {
    std::size_t met = 0;
    for (const Vec3& corner : new_.corners) {
        const Vec3 before = motion.linear.transpose() * (corner - motion.offset);
        met += std::any_of(old_.corners.begin(), old_.corners.end(),
                           [&](const Vec3& other) { return (other - before).norm() < 0.3 * slack_; })
                   ? 1
                   : 0;
    }
    return static_cast<double>(met) / static_cast<double>(std::max<std::size_t>(1, new_.corners.size()));
}

std::vector<AreaMotion> AreaFit::motions(std::span<const std::size_t> parts, std::span<const FaceId> places) {
    std::vector<AreaMotion> found;
    collect_old(parts);
    collect_new(places);
    if (old_.faces.empty() || new_.faces.empty() || lookup_.tree() == nullptr) return found;
    const std::vector<Sample> few = samples_of(parts, few_samples), many = samples_of(parts, many_samples);
    const auto better = [](const AreaMotion& a, const AreaMotion& b) { return a.covered > b.covered; };
    std::vector<AreaMotion> rough;
    const std::size_t pairs = old_.corners.size() * new_.corners.size();
    work_ += 50 * (old_.faces.size() + new_.faces.size() + old_.edges.size() + new_.edges.size());
    for (const Eigen::Matrix3d& turn : turns()) {
        work_ += 4 * pairs;
        for (const Vec3& offset : offsets(turn)) {
            if (!may_search()) return found;
            PartMotion motion;
            motion.linear = turn;
            motion.offset = offset;
            if (!fits_box(motion)) continue;
            const double worst = rough.size() < max_tried ? 0.2 : rough.back().covered;
            const double covered = this->covered(few, motion, worst);
            if (covered <= 0.0) continue;
            rough.push_back({motion, covered, 0.0});
            std::stable_sort(rough.begin(), rough.end(), better);
            if (rough.size() > max_tried) rough.pop_back();
        }
    }
    for (const AreaMotion& candidate : rough) {
        if (!may_search()) break;
        work_ += 10 * pairs;
        const PartMotion motion = refined(many, candidate.motion);
        found.push_back({motion, covered(many, motion, 0.0), corners_met(motion)});
    }
    std::stable_sort(found.begin(), found.end(), better);
    // Of those that differ by less than half a face the one that puts most corners onto corners.
    std::vector<AreaMotion> different;
    for (const AreaMotion& one : found) {
        const double near = 0.5 * face_size_;
        const auto known = std::find_if(different.begin(), different.end(), [&](const AreaMotion& other) {
            return (one.motion(box_.min) - other.motion(box_.min)).norm() < near &&
                   (one.motion(box_.max) - other.motion(box_.max)).norm() < near &&
                   (one.motion.linear - other.motion.linear).norm() < 0.1;
        });
        if (known == different.end() && different.size() < max_found)
            different.push_back(one);
        else if (known != different.end() && one.covered > known->covered - nearly &&
                 one.corners > known->corners)
            *known = {one.motion, known->covered, one.corners};
    }
    return different;
}

}  // namespace slipface
