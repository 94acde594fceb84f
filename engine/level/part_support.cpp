#include "part_support.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "motion_fit.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr std::size_t max_sampled_keys = 48;  // of a part

double cell_size(const Mesh& mesh) {
    const Aabb& box = mesh.bounds;
    if (box.empty()) return 1.0;
    return std::max(16.0 * position_tolerance(box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs())),
                    2e-4 * box.size().norm());
}

// Without material and hash.
FaceKey anchor_key(const AnchorFace& anchor) {
    FaceKey key;
    Vec3 vector = Vec3::Zero();
    for (std::size_t c = 0; c < anchor.size(); ++c) {
        const Vec3 here = (anchor[c] - anchor[0]).cast<double>();
        const Vec3 next = (anchor[(c + 1) % anchor.size()] - anchor[0]).cast<double>();
        key.centroid += anchor[c].cast<double>() / static_cast<double>(anchor.size());
        vector += 0.5 * here.cross(next);
    }
    key.area = vector.norm();
    if (key.area > 0.0) key.normal = vector / key.area;
    return key;
}

}  // namespace

PartSupport::PartSupport(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces,
                         const PaintParts& parts, const std::vector<StoredOverride>& stored)
    : mesh_(mesh),
      index_(index),
      surfaces_(surfaces),
      stored_(parts),
      grid_(mesh.positions.size(), cell_size(mesh),
            [&](std::size_t i) -> Vec3 { return mesh.positions[i].cast<double>(); }),
      names_(mesh, parts),
      samples_(parts.parts.size()) {
    const auto before = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    for (std::size_t part = 0; part < samples_.size(); ++part) {
        std::vector<Vec3> points;
        for (const AnchorFace& anchor : parts.parts[part].anchors)
            for (const Vec3f& corner : anchor)
                points.emplace_back(corner.cast<double>());
        std::sort(points.begin(), points.end(), before);
        points.erase(std::unique(points.begin(), points.end()), points.end());
        // Neighbours one after another say the same; a large step lets a wrong motion fail early.
        const std::size_t step = points.size() % 7 != 0 ? 7 : points.size() % 5 != 0 ? 5 : 1;
        for (std::size_t i = 0; i < points.size(); ++i)
            samples_[part].points.push_back(points[i * step % points.size()]);
    }
    for (std::size_t i = 0; i < stored.size() && i < parts.of.size(); ++i)
        if (parts.of[i] > 0 && parts.of[i] <= samples_.size())
            samples_[parts.of[i] - 1u].keys.push_back(&stored[i].key);
    for (Sample& sample : samples_) {
        const std::size_t step = (sample.keys.size() + max_sampled_keys - 1) / max_sampled_keys;
        if (step < 2) continue;
        for (std::size_t i = 0; i * step < sample.keys.size(); ++i)
            sample.keys[i] = sample.keys[i * step];
        sample.keys.resize(sample.keys.size() / step);
    }
}

double PartSupport::tolerance(const PartMotion& motion, const Vec3& from, const Vec3& to) const {
    return std::min(2.0 * position_tolerance(to) + scale_of(motion) * position_tolerance(from),
                    grid_.widest());
}

std::uint32_t PartSupport::nearest(const Vec3& position, double tolerance) const {
    std::uint32_t best = no_id;
    double best_distance = tolerance;
    grid_.near(position, tolerance, [&](std::uint32_t vertex) {
        const double distance = (mesh_.positions[vertex].cast<double>() - position).norm();
        if (distance > best_distance || (distance == best_distance && best != no_id)) return;
        best = vertex;
        best_distance = distance;
    });
    return best;
}

std::uint32_t PartSupport::vertex_at(const Vec3& point, const PartMotion& motion) const {
    const Vec3 to = motion(point);
    return nearest(to, tolerance(motion, point, to));
}

// The fraction of the part's anchor corners that are vertices after the motion; 0 as soon as it must be
// below `least`.
double PartSupport::corners_hit(const Sample& sample, const PartMotion& motion, double least) const {
    const auto allowed = static_cast<std::size_t>((1.0 - least) * static_cast<double>(sample.points.size()));
    std::size_t misses = 0;
    for (const Vec3& point : sample.points)
        if (vertex_at(point, motion) == no_id && ++misses > allowed) return 0.0;
    return sample.points.empty()
               ? 0.0
               : 1.0 - static_cast<double>(misses) / static_cast<double>(sample.points.size());
}

double PartSupport::rest(std::size_t part, const PartMotion& motion) const {
    std::optional<double> most;
    for (const Vec3& point : samples_[part].points) {
        const std::uint32_t vertex = vertex_at(point, motion);
        if (vertex == no_id) continue;
        most = std::max(most.value_or(0.0), (mesh_.positions[vertex].cast<double>() - motion(point)).norm());
    }
    return most.value_or(PartMotion{}.rest);
}

// Whether the mesh has the painted face after the motion, and which way it looks.
PartSupport::Side PartSupport::find_face(const FaceKey& key, const PartMotion& motion,
                                         bool& same_material) const {
    const FaceKey moved = moved_key(key, motion);
    bool same = false, other = false;
    const double reach =
        std::min(4.0 * position_tolerance(moved.centroid), tolerance(motion, key.centroid, moved.centroid));
    for (const FaceId face : index_.near(moved.centroid, reach)) {
        const FaceKey& found = index_.key(face);
        if (std::abs(found.area - moved.area) > 0.02 * std::max(found.area, moved.area)) continue;
        const double along = found.normal.dot(moved.normal);
        if (std::abs(along) < 0.998 && !moved.normal.isZero()) continue;
        (along >= 0.0 ? same : other) = true;
        same_material = same_material || index_.base(face) == base_material(key.material, surfaces_);
    }
    return same && other ? Side::both : same ? Side::same : other ? Side::other : Side::none;
}

const MeshParts& PartSupport::all() {
    if (all_) return *all_;
    all_ = mesh_parts(mesh_);
    vertex_part_.assign(mesh_.positions.size(), no_id);
    for (FaceId face = 0; face < mesh_.face_count(); ++face)
        for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c)
            vertex_part_[mesh_.corner_vertex[c]] = all_->of[face];
    // Parts by the place of their box.
    std::vector<std::pair<double, std::uint32_t>> stored;
    for (std::size_t i = 0; i < stored_.parts.size(); ++i)
        stored.push_back({stored_.parts[i].box.min.x(), static_cast<std::uint32_t>(i)});
    std::sort(stored.begin(), stored.end());
    owner_.assign(all_->parts.size(), no_id);
    std::size_t visits = 0;
    for (std::size_t part = 0; part < all_->parts.size(); ++part) {
        const Aabb& box = all_->parts[part].box;
        const double slack = 4.0 * position_tolerance(box.max) + 4.0 * position_tolerance(box.min);
        auto at = std::lower_bound(stored.begin(), stored.end(),
                                   std::pair<double, std::uint32_t>{box.min.x() - slack, 0});
        for (; at != stored.end() && at->first <= box.min.x() + slack; ++at) {
            const Aabb& old = stored_.parts[at->second].box;
            if ((old.min - box.min).cwiseAbs().maxCoeff() <= slack &&
                (old.max - box.max).cwiseAbs().maxCoeff() <= slack)
                owner_[part] = at->second;
        }
        // What is left of a part that lost faces lies in its box.
        const double size = box.size().norm();
        for (std::size_t i = 0; i < stored_.parts.size() && owner_[part] == no_id && visits < 4'000'000;
             ++i, ++visits) {
            const Aabb& old = stored_.parts[i].box;
            if (lies_in(box, old, slack) && size >= 0.5 * old.size().norm())
                owner_[part] = static_cast<std::uint32_t>(i);
        }
        for (std::size_t i = 0; i < stored_.parts.size() && owner_[part] == no_id && visits < 8'000'000;
             ++i, ++visits) {
            const Aabb& old = stored_.parts[i].box;
            if (similar_box(box, old, 2.0 * box_slack)) owner_[part] = static_cast<std::uint32_t>(i);
        }
    }
    return *all_;
}

bool PartSupport::is_taken(std::size_t i, const PartMotion& motion) {
    all();
    std::size_t hits = 0, taken = 0;
    for (const Vec3& point : samples_[i].points) {
        const std::uint32_t vertex = vertex_at(point, motion);
        if (vertex == no_id || vertex_part_[vertex] == no_id) continue;
        ++hits;
        const std::uint32_t there = vertex_part_[vertex], owner = owner_[there];
        const bool stayed = owner != no_id && owner != i && !samples_[owner].gone;
        taken += stayed || differ(i, there) ? 1 : 0;
    }
    return 10 * taken > 3 * hits;
}

bool PartSupport::is_another_object(std::size_t i, const PartMotion& motion) {
    const std::uint32_t name = stored_.parts[i].object;
    const std::vector<std::uint32_t> parts = parts_at(i, motion);
    const auto others = std::count_if(parts.begin(), parts.end(), [&](std::uint32_t part) {
        const std::uint32_t owner = owner_[part], there = all_->parts[part].object;
        return owner != no_id && !samples_[owner].gone && there != name &&
               there == stored_.parts[owner].object;
    });
    return name != 0 && 2 * static_cast<std::size_t>(others) > parts.size();
}

std::vector<std::uint32_t> PartSupport::parts_at(std::size_t i, const PartMotion& motion) {
    all();
    std::vector<std::uint32_t> parts;
    for (const Vec3& point : samples_[i].points) {
        const std::uint32_t vertex = vertex_at(point, motion);
        if (vertex != no_id && vertex_part_[vertex] != no_id) parts.push_back(vertex_part_[vertex]);
    }
    return parts;
}

MotionSupport PartSupport::support(std::size_t part, const PartMotion& motion, double least) const {
    const Sample& sample = samples_[part];
    MotionSupport result;
    result.corners = corners_hit(sample, motion, least);
    if (result.corners < least || sample.keys.empty()) return result;
    for (const FaceKey* key : sample.keys) {
        bool same_material = false;
        if (find_face(*key, motion, same_material) != Side::none) result.keys += same_material ? 1.0 : 0.5;
    }
    result.keys /= static_cast<double>(sample.keys.size());
    return result;
}

PartSupport::Looks PartSupport::looks(std::size_t part, const PartMotion& motion) const {
    // Painted or not: where an edit cut the part's faces, what lies there is a neighbour's.
    std::vector<FaceKey> rim;
    for (const AnchorFace& anchor : stored_.parts[part].anchors)
        if (const FaceKey key = anchor_key(anchor); key.area > 0.0) rim.push_back(key);
    std::vector<const FaceKey*> faces = samples_[part].keys;
    for (const FaceKey& key : rim)
        faces.push_back(&key);
    double same = 0.0, other = 0.0, both = 0.0, all = 0.0;  // area
    for (const FaceKey* key : faces) {
        bool same_material = false;
        const Side side = find_face(*key, motion, same_material);
        same += side == Side::same ? key->area : 0.0;
        other += side == Side::other ? key->area : 0.0;
        both += side == Side::both ? key->area : 0.0;
        all += key->area;
    }
    // A bevel or an inset turns over faces that are narrower than it is, but leaves others as they were.
    constexpr double much_more = 10.0;
    if (other > much_more * same && 2.0 * other > all - both) return Looks::back;
    return same == 0.0 && 2.0 * both > all ? Looks::both : Looks::as_before;
}

bool PartSupport::stays_inside(std::size_t i, const PartMotion& motion) const {
    const Aabb& box = stored_.parts[i].box;
    const Vec3 slack = Vec3::Constant(1e-3 * box.size().norm());
    return std::all_of(samples_[i].points.begin(), samples_[i].points.end(), [&](const Vec3& point) {
        if (vertex_at(point, motion) == no_id) return true;
        const Vec3 to = motion(point);
        return ((to - box.min + slack).array() >= 0.0).all() && ((box.max - to + slack).array() >= 0.0).all();
    });
}

Aabb PartSupport::moved_box(std::size_t i, const PartMotion& motion) const {
    Aabb box;
    for (const Vec3& point : samples_[i].points)
        box.add(motion(point));
    return box;
}

bool PartSupport::fills_box(std::size_t i, const PartMotion& motion) {
    return is_rigid(motion) || becomes_box(i, motion, 0.2);
}

bool PartSupport::becomes_box(std::size_t i, const PartMotion& motion, double slack) {
    all();
    const Aabb moved = moved_box(i, motion);
    std::uint32_t part = no_id;
    for (const Vec3& point : samples_[i].points) {
        if (part != no_id) break;
        const std::uint32_t vertex = vertex_at(point, motion);
        if (vertex != no_id) part = vertex_part_[vertex];
    }
    if (part == no_id) return false;
    return similar_box(all_->parts[part].box, moved, slack);
}

bool PartSupport::has_similar_box(std::size_t i) {
    const Aabb& old = stored_.parts[i].box;
    return std::any_of(all().parts.begin(), all().parts.end(),
                       [&](const PaintPart& part) { return similar_box(part.box, old, box_slack); });
}

bool lies_in(const Aabb& a, const Aabb& b, double slack) {
    return ((a.min - b.min).array() >= -slack).all() && ((b.max - a.max).array() >= -slack).all();
}

bool similar_box(const Aabb& a, const Aabb& b, double slack) {
    const double most = slack * b.size().norm();
    return (a.min - b.min).norm() <= most && (a.max - b.max).norm() <= most;
}

}  // namespace slipface
