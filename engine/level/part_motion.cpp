// Finds how parts moved. A motion is guessed from few faces or from boxes and then checked against all
// anchors and a sample of the painted faces.
#include "part_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "face_index.h"
#include "mesh_parts.h"
#include "slipface/base/hash.h"
#include "slipface/base/key_sort.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr std::size_t max_sampled_keys = 48;        // of a part
constexpr std::size_t max_guesses_per_part = 8000;  // motions examined
constexpr std::size_t max_guesses = 500'000;        // of all parts
constexpr std::size_t max_candidates_per_anchor = 400;
constexpr double enough_anchors = 0.7;    // fraction of anchor corners that a motion must explain
constexpr double clearly_more = 0.15;     // than staying explains; the most is 2
constexpr double clearly_more_rim = 0.1;  // of the anchor corners alone
constexpr double lost_below = 0.3;
constexpr double in_place = 0.85;             // fraction of anchor corners of a part that stayed
constexpr double box_slack = 0.05;            // of a box's diagonal, by which edits in place change it
constexpr double vote_slack = 0.3;            // by which parts yield to the motion of other parts
constexpr std::size_t max_candidates = 1000;  // motions to vote on

// Finds vertices near a position.
class VertexGrid {
  public:
    explicit VertexGrid(const Mesh& mesh) : mesh_(mesh) {
        const double extent = mesh.bounds.empty() ? 1.0 : mesh.bounds.size().norm();
        const double reach = mesh.bounds.empty() ? 0.0
                                                 : std::max(mesh.bounds.min.cwiseAbs().maxCoeff(),
                                                            mesh.bounds.max.cwiseAbs().maxCoeff());
        cell_ = std::max(16.0 * position_tolerance(Vec3::Constant(reach)), 2e-4 * extent);
        entries_.resize(mesh.positions.size());
        for (std::size_t i = 0; i < entries_.size(); ++i)
            entries_[i] = {code((mesh.positions[i].cast<double>() / cell_).array().floor()),
                           static_cast<std::uint32_t>(i)};
        sort_by_key(entries_);
    }

    double widest() const { return 0.45 * cell_; }

    // The nearest vertex within `tolerance`, at most widest(); no_id: none.
    std::uint32_t nearest(const Vec3& position, double tolerance) const {
        std::uint64_t codes[8];
        std::size_t count = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 offset((corner & 1) != 0 ? tolerance : -tolerance,
                              (corner & 2) != 0 ? tolerance : -tolerance,
                              (corner & 4) != 0 ? tolerance : -tolerance);
            const std::uint64_t here = code(((position + offset) / cell_).array().floor());
            if (std::find(codes, codes + count, here) == codes + count) codes[count++] = here;
        }
        std::uint32_t best = no_id;
        double best_distance = tolerance;
        for (std::size_t i = 0; i < count; ++i) {
            auto entry = std::lower_bound(entries_.begin(), entries_.end(), codes[i],
                                          [](const KeyedIndex& a, std::uint64_t key) { return a.key < key; });
            for (; entry != entries_.end() && entry->key == codes[i]; ++entry) {
                const double distance = (mesh_.positions[entry->index].cast<double>() - position).norm();
                if (distance > best_distance || (distance == best_distance && best != no_id)) continue;
                best = entry->index;
                best_distance = distance;
            }
        }
        return best;
    }

  private:
    static std::uint64_t code(const Vec3& cell) {
        Hasher hasher;
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(cell[axis]);
        return hasher.value();
    }

    const Mesh& mesh_;
    double cell_ = 1.0;
    std::vector<KeyedIndex> entries_;
};

double scale_of(const Motion& motion) {
    return std::cbrt(std::abs(motion.linear.determinant()));
}

// How much a motion does: of two that explain the same, the lesser one is the likelier.
double effort(const Motion& motion, const Vec3& centre, double size) {
    const double scale = std::max(1e-9, scale_of(motion));
    const double mirrored = motion.linear.determinant() < 0.0 ? 2.0 : 0.0;
    return mirrored + std::abs(std::log(scale)) +
           (motion.linear / scale - Eigen::Matrix3d::Identity()).norm() +
           1e-3 * (motion(centre) - centre).norm() / (size + 1e-9);
}

// The 48 ways to turn and mirror a box along the axes.
std::vector<Eigen::Matrix3d> axis_turns() {
    std::vector<Eigen::Matrix3d> turns;
    int axes[3] = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
            for (int row = 0; row < 3; ++row)
                turn(row, axes[row]) = (signs >> row & 1) != 0 ? -1.0 : 1.0;
            turns.push_back(turn);
        }
    } while (std::next_permutation(axes, axes + 3));
    return turns;
}

struct Support {
    double corners = 0.0, keys = 0.0;  // fractions
    double ranks = 0.0;                // fraction of anchors with their place in the file's order
    double sum() const { return corners + keys; }
};

class Finder {
  public:
    Finder(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces, const PaintParts& parts,
           const std::vector<const FaceKey*>& keys)
        : mesh_(mesh), index_(index), surfaces_(surfaces), stored_(parts), grid_(mesh) {
        parts_.resize(parts.parts.size());
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            std::vector<Vec3>& points = parts_[part].points;
            for (const AnchorFace& anchor : parts.parts[part].anchors)
                for (const Vec3f& corner : anchor.corners)
                    points.push_back(corner.cast<double>());
            std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
                return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
            });
            points.erase(std::unique(points.begin(), points.end()), points.end());
            // Neighbours one after another say the same; a large step lets a wrong motion fail early.
            std::vector<Vec3> spread;
            const std::size_t step = points.size() % 7 != 0 ? 7 : points.size() % 5 != 0 ? 5 : 1;
            for (std::size_t i = 0; i < points.size(); ++i)
                spread.push_back(points[i * step % points.size()]);
            points = std::move(spread);
        }
        for (std::size_t i = 0; i < keys.size() && i < parts.of.size(); ++i)
            if (parts.of[i] > 0 && parts.of[i] <= parts_.size())
                parts_[parts.of[i] - 1u].keys.push_back(keys[i]);
        for (Part& part : parts_) {
            const std::size_t step = (part.keys.size() + max_sampled_keys - 1) / max_sampled_keys;
            if (step < 2) continue;
            for (std::size_t i = 0; i * step < part.keys.size(); ++i)
                part.keys[i] = part.keys[i * step];
            part.keys.resize(part.keys.size() / step);
        }
    }

    std::vector<Motion> run() && {
        for (std::size_t part = 0; part < parts_.size(); ++part)
            find(part);
        vote();
        std::vector<Motion> motions;
        for (Part& part : parts_) {
            part.best.flipped = is_flipped(part);
            part.best.lost = !part.points.empty() && part.best_support.corners < lost_below &&
                             part.best_support.keys < lost_below && !has_similar_box(motions.size());
            motions.push_back(part.best);
        }
        return motions;
    }

  private:
    struct Part {
        std::vector<Vec3> points;
        std::vector<const FaceKey*> keys;  // a sample
        Motion best;
        Support best_support, staying;
        double best_rating = 0.0;
        bool searched = false;
    };

    double tolerance(const Motion& motion, const Vec3& from, const Vec3& to) const {
        return std::min(2.0 * position_tolerance(to) + scale_of(motion) * position_tolerance(from),
                        grid_.widest());
    }

    // The fraction of the part's anchor corners that are vertices after the motion; 0 as soon as it must be
    // below `least`.
    double corners_hit(const Part& part, const Motion& motion, double least) const {
        const auto allowed =
            static_cast<std::size_t>((1.0 - least) * static_cast<double>(part.points.size()));
        std::size_t misses = 0;
        for (const Vec3& point : part.points) {
            const Vec3 to = motion(point);
            if (grid_.nearest(to, tolerance(motion, point, to)) == no_id && ++misses > allowed) return 0.0;
        }
        return part.points.empty()
                   ? 0.0
                   : 1.0 - static_cast<double>(misses) / static_cast<double>(part.points.size());
    }

    enum class Side { none, same, other, both };

    // Whether the mesh has the painted face after the motion, and which way it looks.
    Side find_face(const FaceKey& key, const Motion& motion, bool& same_material) const {
        const FaceKey moved = moved_key(key, motion);
        bool same = false, other = false;
        const double reach = std::min(4.0 * position_tolerance(moved.centroid),
                                      tolerance(motion, key.centroid, moved.centroid));
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

    // The parts of the mesh, found when they are first needed.
    const MeshParts& all() {
        if (all_) return *all_;
        all_ = mesh_parts(mesh_, surfaces_);
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
                if (((box.min - old.min).array() >= -slack).all() &&
                    ((old.max - box.max).array() >= -slack).all() && size >= 0.5 * old.size().norm())
                    owner_[part] = static_cast<std::uint32_t>(i);
            }
        }
        return *all_;
    }

    // True if the motion puts the part where another one stayed.
    bool is_taken(std::size_t i, const Motion& motion) {
        all();
        std::size_t hits = 0, taken = 0;
        for (const Vec3& point : parts_[i].points) {
            const Vec3 to = motion(point);
            const std::uint32_t vertex = grid_.nearest(to, tolerance(motion, point, to));
            if (vertex == no_id || vertex_part_[vertex] == no_id) continue;
            ++hits;
            const std::uint32_t owner = owner_[vertex_part_[vertex]];
            taken += owner != no_id && owner != i ? 1 : 0;
        }
        return 10 * taken > 3 * hits;
    }

    double ranks_kept(std::size_t i, const Motion& motion) {
        const std::vector<AnchorFace>& anchors = stored_.parts[i].anchors;
        std::size_t kept = 0;
        for (const AnchorFace& anchor : anchors) {
            Vec3 centroid = Vec3::Zero();
            for (const Vec3f& corner : anchor.corners)
                centroid += corner.cast<double>() / static_cast<double>(anchor.corners.size());
            const Vec3 to = motion(centroid);
            const double reach = std::min(4.0 * position_tolerance(to), tolerance(motion, centroid, to));
            bool same = false;
            for (const FaceId face : index_.near(to, reach))
                same = same || all().rank[face] == anchor.rank;
            kept += same ? 1 : 0;
        }
        return anchors.empty() ? 0.0 : static_cast<double>(kept) / static_cast<double>(anchors.size());
    }

    Support support(const Part& part, const Motion& motion, double least) const {
        Support result;
        result.corners = corners_hit(part, motion, least);
        if (result.corners < least || part.keys.empty()) return result;
        for (const FaceKey* key : part.keys) {
            bool same_material = false;
            if (find_face(*key, motion, same_material) != Side::none)
                result.keys += same_material ? 1.0 : 0.5;
        }
        result.keys /= static_cast<double>(part.keys.size());
        return result;
    }

    bool is_flipped(const Part& part) const {
        std::size_t same = 0, other = 0;
        for (const FaceKey* key : part.keys) {
            bool same_material = false;
            const Side side = find_face(*key, part.best, same_material);
            same += side == Side::same ? 1 : 0;
            other += side == Side::other ? 1 : 0;
        }
        return other > same;
    }

    void consider(std::size_t i, const Motion& motion) {
        Part& part = parts_[i];
        ++guesses_;
        Support found = support(part, motion, enough_anchors);
        if (found.corners < enough_anchors || found.sum() < part.best_support.sum() - vote_slack) return;
        found.ranks = ranks_kept(i, motion);
        // What explains all needs to explain only a little more than staying does.
        const double more = found.sum() - part.staying.sum();
        const bool whole = found.sum() > 2.0 - 1e-9;
        if (more <= (whole ? 1e-9 : clearly_more) || !fills_box(i, motion)) return;
        if (found.corners < part.staying.corners + clearly_more_rim) return;
        if (!whole && part.staying.corners >= 0.5 && stays_inside(i, motion)) return;
        if (is_taken(i, motion)) return;
        add_candidate(i, motion);
        const PaintPart& old = stored_.parts[i];
        const double cost = effort(motion, old.box.centre(), old.box.size().norm());
        // Deleted faces make one of a symmetric part's motions fit a little better by chance, so the order
        // and the effort count more than a little.
        const double rating = found.sum() + 0.3 * found.ranks - 0.1 * std::min(cost, 2.0);
        if (!part.best.is_identity() && rating <= part.best_rating) return;
        part.best = motion;
        part.best_support = found;
        part.best_rating = rating;
    }

    // A part of equal tiles that lost some at its rim looks as if it had moved by a tile, but nothing of it
    // is at a new place.
    bool stays_inside(std::size_t i, const Motion& motion) const {
        const Aabb& box = stored_.parts[i].box;
        const Vec3 slack = Vec3::Constant(1e-3 * box.size().norm());
        return std::all_of(parts_[i].points.begin(), parts_[i].points.end(), [&](const Vec3& point) {
            const Vec3 to = motion(point);
            if (grid_.nearest(to, tolerance(motion, point, to)) == no_id) return true;
            return ((to - box.min + slack).array() >= 0.0).all() &&
                   ((box.max - to + slack).array() >= 0.0).all();
        });
    }

    // Tiles may repeat at half their size in a subdivided part. So a part that was scaled must fill its new
    // box.
    bool fills_box(std::size_t i, const Motion& motion) {
        if ((motion.linear.transpose() * motion.linear).isIdentity(1e-3)) return true;
        all();
        Aabb moved;
        std::uint32_t part = no_id;
        for (const Vec3& point : parts_[i].points) {
            const Vec3 to = motion(point);
            moved.add(to);
            if (part != no_id) continue;
            const std::uint32_t vertex = grid_.nearest(to, tolerance(motion, point, to));
            if (vertex != no_id) part = vertex_part_[vertex];
        }
        if (part == no_id) return false;
        const Aabb& box = all_->parts[part].box;
        const double slack = 0.2 * moved.size().norm();
        return (moved.min - box.min).norm() <= slack && (moved.max - box.max).norm() <= slack;
    }

    void find(std::size_t i) {
        Part& part = parts_[i];
        part.staying = support(part, Motion{}, 0.0);
        part.best_support = part.staying;
        if (part.points.size() < 3 || part.staying.corners >= in_place) return;
        part.searched = true;
        try_known(i);
        try_ranks(i);
        if (part.best.is_identity() || part.best_support.sum() < 2.0 - 1e-9 ||
            part.best_support.ranks < 0.75) {
            try_boxes(i);
            try_faces(i);
        }
        if (!part.best.is_identity()) known_.push_back(part.best);
    }

    void try_known(std::size_t i) {
        for (std::size_t k = 0; k < known_.size() && k < 64 && guesses_ < max_guesses; ++k)
            consider(i, known_[k]);
    }

    // Whether the mesh has a part that fills nearly the same box: an edited part.
    bool has_similar_box(std::size_t i) {
        const Aabb& old = stored_.parts[i].box;
        const double slack = box_slack * old.size().norm();
        return std::any_of(all().parts.begin(), all().parts.end(), [&](const PaintPart& part) {
            return (part.box.min - old.min).norm() <= slack && (part.box.max - old.max).norm() <= slack;
        });
    }

    // A part with as many faces has them in the same order: any affine motion, even a shear, follows from the
    // anchors' centroids.
    void try_ranks(std::size_t i) {
        const PaintPart& old = stored_.parts[i];
        const MeshParts& all_parts = all();
        const auto count = static_cast<Eigen::Index>(old.anchors.size());
        Eigen::Matrix3Xd from(3, count), to(3, count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const AnchorFace& anchor = old.anchors[static_cast<std::size_t>(k)];
            from.col(k).setZero();
            for (const Vec3f& corner : anchor.corners)
                from.col(k) += corner.cast<double>() / static_cast<double>(anchor.corners.size());
        }
        std::size_t tried = 0;
        for (std::size_t part = 0; part < all_parts.parts.size() && tried < 100; ++part) {
            if (all_parts.parts[part].faces != old.faces || guesses_ > max_guesses) continue;
            ++tried;
            bool fits = count >= 3;
            for (Eigen::Index k = 0; k < count && fits; ++k) {
                const AnchorFace& anchor = old.anchors[static_cast<std::size_t>(k)];
                fits = anchor.rank < old.faces;
                if (!fits) break;
                const FaceId face = all_parts.sorted[all_parts.first[part] + anchor.rank];
                fits = mesh_.face_corner_count(face) == anchor.corners.size();
                to.col(k) = index_.key(face).centroid;
            }
            if (!fits) continue;
            for (const bool mirrored : {false, true})
                if (const std::optional<Motion> motion = affine(from, to, mirrored)) consider(i, *motion);
        }
    }

    // The least-squares affine motion. What is flat says nothing about the third direction: it becomes the
    // new plane's normal, scaled as the plane was.
    static std::optional<Motion> affine(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                                        bool mirrored) {
        const Vec3 old_centre = from.rowwise().mean();
        const Vec3 new_centre = to.rowwise().mean();
        const Eigen::Matrix3Xd a = from.colwise() - old_centre;
        const Eigen::Matrix3Xd b = to.colwise() - new_centre;
        const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
        const Vec3 sizes = svd.singularValues();
        if (!(sizes[1] > 1e-4 * sizes[0])) return std::nullopt;
        const bool flat = !(sizes[2] > 1e-4 * sizes[0]);
        if (!flat && mirrored) return std::nullopt;  // the fit decides
        Eigen::Matrix3d moved;                       // columns: where the three directions go
        for (int k = 0; k < 3; ++k)
            moved.col(k) = k == 2 && flat ? Vec3(Vec3::Zero()) : Vec3(b * svd.matrixV().col(k) / sizes[k]);
        if (flat) {
            const Vec3 normal = moved.col(0).cross(moved.col(1));
            if (!(normal.norm() > 0.0)) return std::nullopt;
            const double side = svd.matrixU().determinant() < 0.0 ? -1.0 : 1.0;
            moved.col(2) = (mirrored ? -side : side) * normal / std::sqrt(normal.norm());
        }
        Motion motion;
        motion.linear = moved * svd.matrixU().transpose();
        motion.offset = new_centre - motion.linear * old_centre;
        if (!motion.linear.allFinite() || std::abs(motion.linear.determinant()) < 1e-12) return std::nullopt;
        return motion;
    }

    // The part's box became the box of a part with as many faces, or of the same shape; or the whole level's
    // box became the mesh's.
    void try_boxes(std::size_t i) {
        const PaintPart& old = stored_.parts[i];
        if (!stored_.bounds.empty() && !mesh_.bounds.empty()) try_box(i, stored_.bounds, mesh_.bounds);
        const auto sorted_size = [](const Aabb& box) {
            Vec3 size = box.size();
            std::sort(size.data(), size.data() + 3);
            return size;
        };
        const Vec3 size = sorted_size(old.box);
        std::size_t tried = 0;
        for (const PaintPart& part : all().parts) {
            if (part.faces != old.faces && !(sorted_size(part.box) - size).isZero(1e-4 * size.z())) continue;
            if (++tried > 100 || guesses_ > max_guesses) break;
            try_box(i, old.box, part.box);
        }
    }

    void try_box(std::size_t i, const Aabb& from, const Aabb& to) {
        static const std::vector<Eigen::Matrix3d> turns = axis_turns();
        const Vec3 old_size = from.size();
        const Vec3 new_size = to.size();
        for (const Eigen::Matrix3d& turn : turns) {
            Motion motion;
            const Vec3 turned = turn.cwiseAbs() * old_size;
            Vec3 scale = Vec3::Ones();
            bool possible = true;
            double sum = 0.0;
            int thick = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const bool flat = turned[axis] < 1e-6 * old_size.maxCoeff();
                possible = possible && flat == (new_size[axis] < 1e-5 * new_size.maxCoeff());
                if (flat) continue;
                scale[axis] = new_size[axis] / turned[axis];
                sum += scale[axis];
                ++thick;
            }
            if (!possible || thick == 0) continue;
            for (int axis = 0; axis < 3; ++axis)
                if (turned[axis] < 1e-6 * old_size.maxCoeff()) scale[axis] = sum / thick;
            // Sizes in a file are rounded: what is nearly rigid is rigid.
            if ((scale - Vec3::Ones()).isZero(1e-5)) scale.setOnes();
            motion.linear = scale.asDiagonal() * turn;
            motion.offset = to.centre() - motion.linear * from.centre();
            consider(i, motion);
        }
    }

    struct Shape {
        double roundness;  // perimeter^2 / area
        FaceId face;
    };

    double perimeter(FaceId face) const {
        const std::uint32_t first = mesh_.face_first_corner[face];
        const std::uint32_t count = mesh_.face_corner_count(face);
        double length = 0.0;
        for (std::uint32_t c = 0; c < count; ++c)
            length += static_cast<double>(
                (mesh_.corner_position(first + (c + 1) % count) - mesh_.corner_position(first + c)).norm());
        return length;
    }

    void sort_shapes() {
        if (!shapes_.empty()) return;
        for (FaceId face = 0; face < mesh_.face_count(); ++face) {
            const double length = perimeter(face);
            const double area = index_.key(face).area;
            if (area > 0.0) shapes_.push_back({length * length / area, face});
        }
        std::sort(shapes_.begin(), shapes_.end(), [](const Shape& a, const Shape& b) {
            return a.roundness != b.roundness ? a.roundness < b.roundness : a.face < b.face;
        });
    }

    // Faces of the anchor's shape, the ones of its size first.
    std::vector<FaceId> similar_faces(const std::vector<Vec3f>& anchor, double length, double area) const {
        const double wanted = length * length / area;
        auto at = std::lower_bound(shapes_.begin(), shapes_.end(), 0.999 * wanted,
                                   [](const Shape& a, double value) { return a.roundness < value; });
        std::vector<FaceId> faces;
        for (; at != shapes_.end() && at->roundness < 1.001 * wanted; ++at)
            if (mesh_.face_corner_count(at->face) == anchor.size()) faces.push_back(at->face);
        const auto change = [&](FaceId face) {
            const double ratio = std::abs(std::log(index_.key(face).area / area));
            return ratio < 1e-3 ? 0.0 : ratio;
        };
        std::sort(faces.begin(), faces.end(), [&](FaceId a, FaceId b) {
            const double left = change(a), right = change(b);
            return left != right ? left < right : a < b;
        });
        return faces;
    }

    // An anchor became a face of the same shape, turned, mirrored and scaled.
    void try_faces(std::size_t i) {
        sort_shapes();
        struct Anchor {
            const std::vector<Vec3f>* corners;
            std::vector<FaceId> faces;
        };
        std::vector<Anchor> anchors;
        for (const AnchorFace& face : stored_.parts[i].anchors) {
            const std::vector<Vec3f>& corners = face.corners;
            double length = 0.0;
            Vec3 sum = Vec3::Zero();
            for (std::size_t c = 0; c < corners.size(); ++c) {
                const Vec3 here = (corners[c] - corners[0]).cast<double>();
                const Vec3 next = (corners[(c + 1) % corners.size()] - corners[0]).cast<double>();
                length += (next - here).norm();
                sum += here.cross(next);
            }
            if (sum.norm() > 0.0)
                anchors.push_back({&corners, similar_faces(corners, length, 0.5 * sum.norm())});
        }
        std::stable_sort(anchors.begin(), anchors.end(),
                         [](const Anchor& a, const Anchor& b) { return a.faces.size() < b.faces.size(); });
        const std::size_t begin = guesses_;
        std::size_t used = 0;
        for (const Anchor& anchor : anchors) {
            if (anchor.faces.empty()) continue;
            if (++used > 3) break;
            for (std::size_t k = 0; k < anchor.faces.size() && k < max_candidates_per_anchor; ++k) {
                if (guesses_ - begin > max_guesses_per_part || guesses_ > max_guesses) return;
                try_face(i, *anchor.corners, anchor.faces[k]);
            }
            if (parts_[i].best_support.sum() > 1.9 && !parts_[i].best.is_identity()) break;
        }
    }

    void try_face(std::size_t i, const std::vector<Vec3f>& anchor, FaceId face) {
        const std::size_t count = anchor.size();
        const std::uint32_t first = mesh_.face_first_corner[face];
        Eigen::Matrix3Xd from(3, count), to(3, count);
        double old_length = 0.0;
        for (std::size_t c = 0; c < count; ++c) {
            from.col(static_cast<Eigen::Index>(c)) = anchor[c].cast<double>();
            old_length += static_cast<double>((anchor[(c + 1) % count] - anchor[c]).norm());
        }
        const double scale = perimeter(face) / old_length;
        const double slack = 1e-3 * scale * old_length / static_cast<double>(count) +
                             4.0 * position_tolerance(mesh_.corner_position(first).cast<double>());
        const auto corner = [&](std::size_t c) {
            return mesh_.corner_position(first + static_cast<std::uint32_t>(c));
        };
        for (std::size_t shift = 0; shift < count; ++shift) {
            for (const bool reversed : {false, true}) {
                const auto partner = [&](std::size_t c) {
                    return reversed ? (shift + count - c % count) % count : (shift + c) % count;
                };
                bool fits = true;
                for (std::size_t c = 0; c < count && fits; ++c) {
                    for (const std::size_t reach : {std::size_t{1}, std::size_t{2}}) {
                        const double old_edge =
                            static_cast<double>((anchor[(c + reach) % count] - anchor[c]).norm());
                        const double new_edge =
                            static_cast<double>((corner(partner(c + reach)) - corner(partner(c))).norm());
                        fits = fits && std::abs(new_edge - scale * old_edge) <= slack;
                    }
                }
                if (!fits) continue;
                for (std::size_t c = 0; c < count; ++c)
                    to.col(static_cast<Eigen::Index>(c)) = corner(partner(c)).cast<double>();
                const std::optional<Motion> straight = similarity(from, to, false);
                if (!straight) continue;
                refine_and_consider(i, *straight);
                // The anchor is flat: a reflection in its plane does not change it.
                const Vec3 centre = from.rowwise().mean();
                Vec3 normal = Vec3::Zero();
                for (Eigen::Index c = 0; c < from.cols(); ++c)
                    normal += (from.col(c) - centre).cross(from.col((c + 1) % from.cols()) - centre);
                if (!(normal.norm() > 0.0)) continue;
                normal.normalize();
                Motion mirrored = *straight;
                mirrored.linear =
                    straight->linear * (Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose());
                mirrored.offset = (*straight)(centre)-mirrored.linear * centre;
                refine_and_consider(i, mirrored);
            }
        }
    }

    static std::optional<Motion> similarity(Eigen::Matrix3Xd from, const Eigen::Matrix3Xd& to,
                                            bool mirrored) {
        if (mirrored) from.row(0) *= -1.0;
        const Eigen::Matrix4d fitted = Eigen::umeyama(from, to, true);
        if (!fitted.allFinite()) return std::nullopt;
        Motion motion;
        motion.linear = fitted.topLeftCorner<3, 3>();
        if (mirrored) motion.linear.col(0) *= -1.0;
        motion.offset = fitted.topRightCorner<3, 1>();
        if (std::abs(scale_of(motion) - 1.0) < 1e-5) motion.linear /= scale_of(motion);
        return motion;
    }

    // A motion from one small face is not exact far from it: it is fitted again to all corners that it nearly
    // hits.
    void refine_and_consider(std::size_t i, const Motion& rough) {
        const Part& part = parts_[i];
        ++guesses_;
        std::vector<Vec3> from, to;
        const auto allowed =
            static_cast<std::size_t>((1.0 - enough_anchors) * static_cast<double>(part.points.size()));
        std::size_t misses = 0;
        for (const Vec3& point : part.points) {
            const std::uint32_t vertex = grid_.nearest(rough(point), grid_.widest());
            if (vertex == no_id) {
                if (++misses > allowed) return;
                continue;
            }
            from.push_back(point);
            to.push_back(mesh_.positions[vertex].cast<double>());
        }
        if (from.size() < 3) return;
        const auto columns = [](const std::vector<Vec3>& points) {
            return Eigen::Matrix3Xd(Eigen::Map<const Eigen::Matrix3Xd>(
                points.front().data(), 3, static_cast<Eigen::Index>(points.size())));
        };
        const Eigen::Matrix3Xd old_points = columns(from);
        const bool flat = (stored_.parts[i].box.size().minCoeff() <= 0.0);
        consider(i, rough);
        // A flat part's reflection is lost in a fit, so it is put back after it.
        if (const std::optional<Motion> fitted =
                similarity(old_points, columns(to), rough.linear.determinant() < 0.0);
            fitted && !flat)
            consider(i, *fitted);
        if (flat) {
            if (const std::optional<Motion> fitted = similarity(old_points, columns(to), false))
                consider(i, *fitted);
        }
    }

    static bool same(const Motion& a, const Motion& b, const Aabb& box) {
        const double size = 1e-4 * (box.size().norm() + 1.0);
        return (a(box.min) - b(box.min)).norm() < size && (a(box.max) - b(box.max)).norm() < size &&
               (a(box.centre()) - b(box.centre())).norm() < size &&
               (a.linear - b.linear).norm() < 1e-3 * (a.linear.norm() + b.linear.norm());
    }

    void add_candidate(std::size_t i, const Motion& motion) {
        constexpr std::size_t max_of_part = 100;
        if (i != candidates_part_) candidates_of_part_ = 0;
        candidates_part_ = i;
        if (candidates_.size() == max_candidates || candidates_of_part_ == max_of_part) return;
        for (const Motion& known : candidates_)
            if (same(known, motion, stored_.parts[i].box)) return;
        candidates_.push_back(motion);
        ++candidates_of_part_;
    }

    // Equal crates can go to each other's new places, and symmetric parts can turn. The motion that explains
    // the most parts is theirs, then the one that explains the most of the others.
    void vote() {
        struct Voter {
            std::size_t part;
            std::vector<std::size_t> motions;
        };
        std::vector<Voter> voters;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!parts_[i].searched || parts_[i].best.is_identity()) continue;
            Voter voter{i, {}};
            for (std::size_t k = 0; k < candidates_.size() && votes_ < max_guesses; ++k) {
                ++votes_;
                const Support found = support(parts_[i], candidates_[k], enough_anchors);
                if (found.corners >= enough_anchors &&
                    found.sum() >= parts_[i].best_support.sum() - vote_slack &&
                    !is_taken(i, candidates_[k]) && fills_box(i, candidates_[k]))
                    voter.motions.push_back(k);
            }
            voters.push_back(std::move(voter));
        }
        while (!voters.empty()) {
            std::vector<std::size_t> votes(candidates_.size(), 0);
            for (const Voter& voter : voters)
                for (const std::size_t k : voter.motions)
                    ++votes[k];
            std::size_t most = no_id;
            const auto cost = [&](std::size_t k) {
                return effort(candidates_[k], stored_.bounds.centre(), stored_.bounds.size().norm());
            };
            for (std::size_t k = 0; k < votes.size(); ++k)
                if (votes[k] >= 2 && (most == no_id || votes[k] > votes[most] ||
                                      (votes[k] == votes[most] && cost(k) < cost(most))))
                    most = k;
            if (most == no_id) break;
            std::erase_if(voters, [&](const Voter& voter) {
                if (std::find(voter.motions.begin(), voter.motions.end(), most) == voter.motions.end())
                    return false;
                Part& part = parts_[voter.part];
                part.best = candidates_[most];
                part.best_support = support(part, part.best, enough_anchors);
                return true;
            });
        }
        // A part that is still there, damaged, and also looks like another one, has not become that one.
        for (const Voter& voter : voters) {
            Part& part = parts_[voter.part];
            const Aabb& box = stored_.parts[voter.part].box;
            const double moved = (part.best(box.centre()) - box.centre()).norm();
            if (moved <= box_slack * box.size().norm() || !has_similar_box(voter.part)) continue;
            part.best = Motion{};
            part.best_support = part.staying;
        }
    }

    const Mesh& mesh_;
    const FaceIndex& index_;
    SurfaceTable surfaces_;
    const PaintParts& stored_;
    VertexGrid grid_;
    std::vector<Part> parts_;
    std::optional<MeshParts> all_;
    std::vector<std::uint32_t> vertex_part_;  // [vertex] of the mesh
    std::vector<std::uint32_t> owner_;        // [part of the mesh] the stored part with its box, or no_id
    std::vector<Shape> shapes_;
    std::vector<Motion> known_;       // the parts' best, to be tried with the next parts
    std::vector<Motion> candidates_;  // all that nearly explain as much
    std::size_t candidates_part_ = 0, candidates_of_part_ = 0, votes_ = 0;
    std::size_t guesses_ = 0;
};

}  // namespace

std::vector<Motion> find_motions(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces,
                                 const PaintParts& parts, const std::vector<const FaceKey*>& keys) {
    return Finder(mesh, index, surfaces, parts, keys).run();
}

FaceKey moved_key(const FaceKey& key, const Motion& motion) {
    if (motion.is_identity()) return key;
    FaceKey moved = key;
    moved.loop_hash = 0;
    moved.centroid = motion(key.centroid);
    // An area's vector moves with the cofactors. A tool that mirrors keeps faces looking outwards, so a
    // negative determinant does not turn them; `flipped` says if they turned.
    const Eigen::Matrix3d& m = motion.linear;
    Eigen::Matrix3d cofactors;
    cofactors.col(0) = m.col(1).cross(m.col(2));
    cofactors.col(1) = m.col(2).cross(m.col(0));
    cofactors.col(2) = m.col(0).cross(m.col(1));
    Vec3 vector = cofactors * key.normal;
    if (m.determinant() < 0.0) vector = -vector;
    const double length = vector.norm();
    moved.area = key.area * (key.normal.isZero() ? std::cbrt(std::pow(m.determinant(), 2)) : length);
    if (length > 0.0) moved.normal = vector / (motion.flipped ? -length : length);
    return moved;
}

}  // namespace slipface
