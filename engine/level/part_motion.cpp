// Finds how parts moved. A motion is guessed from few faces or from boxes and then checked against all
// anchors and a sample of the painted faces.
#include "part_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "face_index.h"
#include "mesh_parts.h"
#include "motion_fit.h"
#include "part_support.h"
#include "similar_faces.h"

namespace slipface {
namespace {

constexpr std::size_t max_guesses_per_part = 8000;  // motions examined
constexpr std::size_t max_guesses = 500'000;        // of all parts
constexpr std::size_t max_candidates_per_anchor = 400;
constexpr double enough_anchors = 0.7;    // fraction of anchor corners that a motion must explain
constexpr double clearly_more = 0.15;     // than staying explains; the most is 2
constexpr double clearly_more_rim = 0.1;  // of the anchor corners alone
constexpr double lost_below = 0.3;
constexpr double in_place = 0.85;             // fraction of anchor corners of a part that stayed
constexpr double vote_slack = 0.3;            // by which parts yield to the motion of other parts
constexpr std::size_t max_candidates = 1000;  // motions to vote on

class Finder {
  public:
    Finder(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces, const PaintParts& parts,
           const std::vector<const FaceKey*>& keys)
        : mesh_(mesh),
          index_(index),
          stored_(parts),
          support_(mesh, index, surfaces, parts, keys),
          similar_(mesh, index),
          parts_(parts.parts.size()) {}

    std::vector<PartMotion> run() && {
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            parts_[part].staying = support_.support(part, PartMotion{}, 0.0);
            if (parts_[part].staying.corners < lost_below) support_.set_gone(part);
        }
        for (std::size_t part = 0; part < parts_.size(); ++part)
            find(part);
        trust_order();
        vote();
        std::vector<PartMotion> motions;
        for (Part& part : parts_) {
            part.best.flipped = support_.is_flipped(motions.size(), part.best);
            part.best.lost = !support_.points(motions.size()).empty() &&
                             part.best_support.corners < lost_below && part.best_support.keys < lost_below &&
                             !support_.has_similar_box(motions.size());
            motions.push_back(part.best);
        }
        return motions;
    }

  private:
    struct Part {
        PartMotion best;
        MotionSupport best_support, staying;
        double best_rating = 0.0;
        bool searched = false;
    };

    void consider(std::size_t i, const PartMotion& motion) {
        Part& part = parts_[i];
        ++guesses_;
        MotionSupport found = support_.support(i, motion, enough_anchors);
        if (found.corners < enough_anchors || found.sum() < part.best_support.sum() - vote_slack) return;
        found.ranks = support_.ranks_kept(i, motion);
        // What explains all needs to explain only a little more than staying does.
        const double more = found.sum() - part.staying.sum();
        const bool whole = found.sum() > 2.0 - 1e-9;
        if (more <= (whole ? 1e-9 : clearly_more) || !support_.fills_box(i, motion)) return;
        if (found.corners < part.staying.corners + clearly_more_rim) return;
        if (!whole && part.staying.corners >= 0.5 && support_.stays_inside(i, motion)) return;
        if (support_.is_taken(i, motion)) return;
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

    void find(std::size_t i) {
        Part& part = parts_[i];
        part.best_support = part.staying;
        if (support_.points(i).size() < 3) return;
        if (part.staying.corners >= in_place) return try_order(i);
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

    // A part with as many faces has them in the same order: any affine motion, even a shear, follows from the
    // anchors' centroids.
    void try_ranks(std::size_t i) {
        for (const PartMotion& motion : rank_motions(i))
            consider(i, motion);
    }

    // A symmetric part that was turned or mirrored in its own place looks as if nothing had happened, but its
    // faces come in another order. A tool that sorts faces has the same effect, so this is a guess.
    void try_order(std::size_t i) {
        Part& part = parts_[i];
        if (stored_.parts[i].anchors.size() < 4) return;
        const bool unclear = part.staying.sum() > 2.0 - 1e-9;  // else faces have other materials, or are gone
        const bool in_order = support_.in_order(i);
        ++(in_order ? in_order_ : out_of_order_);
        if (in_order && unclear) return;
        for (const PartMotion& motion : rank_motions(i)) {
            // Not a reflection in a diagonal, which is what sorting along another axis looks like.
            const Eigen::Matrix3d turn = motion.linear.array().round();
            const bool quarter = turn.determinant() > 0.0 && turn.trace() == 1.0;
            const Vec3 centre = stored_.parts[i].box.centre();
            const bool in_its_place =
                (motion(centre) - centre).norm() < box_slack * stored_.parts[i].box.size().norm();
            if (!in_its_place || !turn.isUnitary() || !motion.linear.isApprox(turn, 1e-4) ||
                !(turn.isDiagonal() || quarter) || turn.isIdentity() ||
                support_.support(i, motion, 1.0 - 1e-9).sum() < 2.0 - 1e-9 ||
                support_.ranks_kept(i, motion) < 1.0 - 1e-9)
                continue;
            part.best = motion;
            part.best.guessed = unclear;
            if (!in_order) --out_of_order_;
            return;
        }
    }

    // Where other parts are out of order too, a tool sorted the faces. The few faces of a box can come into
    // the order of a turned one by chance.
    void trust_order() {
        constexpr std::size_t few_anchors = 8;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            Part& part = parts_[i];
            if (!part.best.guessed) continue;
            const bool few = stored_.parts[i].anchors.size() < few_anchors;
            if (out_of_order_ > 0 || (few && in_order_ == 0)) part.best = PartMotion{};
        }
    }

    std::vector<PartMotion> rank_motions(std::size_t i) {
        std::vector<PartMotion> motions;
        const PaintPart& old = stored_.parts[i];
        const MeshParts& all_parts = support_.all();
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
                if (const std::optional<PartMotion> motion = fit_affine(from, to, mirrored))
                    motions.push_back(*motion);
        }
        return motions;
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
        for (const PaintPart& part : support_.all().parts) {
            if (part.faces != old.faces && !(sorted_size(part.box) - size).isZero(1e-4 * size.z())) continue;
            if (++tried > 100 || guesses_ > max_guesses) break;
            try_box(i, old.box, part.box);
        }
    }

    void try_box(std::size_t i, const Aabb& from, const Aabb& to) {
        for (const PartMotion& motion : box_motions(from, to))
            consider(i, motion);
    }

    // An anchor became a face of the same shape, turned, mirrored and scaled.
    void try_faces(std::size_t i) {
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
                anchors.push_back({&corners, similar_.of(corners, length, 0.5 * sum.norm())});
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
                for (const PartMotion& motion : similar_.motions(*anchor.corners, anchor.faces[k]))
                    refine_and_consider(i, motion);
            }
            if (parts_[i].best_support.sum() > 1.9 && !parts_[i].best.is_identity()) break;
        }
    }

    // A motion from one small face is not exact far from it: it is fitted again to all corners that it nearly
    // hits.
    void refine_and_consider(std::size_t i, const PartMotion& rough) {
        ++guesses_;
        std::vector<Vec3> from, to;
        if (!near_vertices(i, rough, from, to) || from.size() < 3) return;
        const Eigen::Matrix3Xd old_points = columns(from);
        const bool flat = (stored_.parts[i].box.size().minCoeff() <= 0.0);
        consider(i, rough);
        // A flat part's reflection is lost in a fit, so it is put back after it.
        if (const std::optional<PartMotion> fitted =
                fit_similarity(old_points, columns(to), rough.linear.determinant() < 0.0);
            fitted && !flat)
            consider(i, *fitted);
        if (flat) {
            if (const std::optional<PartMotion> fitted = fit_similarity(old_points, columns(to), false))
                consider(i, *fitted);
        }
    }

    static bool same(const PartMotion& a, const PartMotion& b, const Aabb& box) {
        const double size = 1e-4 * (box.size().norm() + 1.0);
        return (a(box.min) - b(box.min)).norm() < size && (a(box.max) - b(box.max)).norm() < size &&
               (a(box.centre()) - b(box.centre())).norm() < size &&
               (a.linear - b.linear).norm() < 1e-3 * (a.linear.norm() + b.linear.norm());
    }

    void add_candidate(std::size_t i, const PartMotion& motion) {
        constexpr std::size_t max_of_part = 100;
        if (i != candidates_part_) candidates_of_part_ = 0;
        candidates_part_ = i;
        if (candidates_.size() == max_candidates || candidates_of_part_ == max_of_part) return;
        for (const PartMotion& known : candidates_)
            if (same(known, motion, stored_.parts[i].box)) return;
        candidates_.push_back(motion);
        ++candidates_of_part_;
    }

    // `rough`, which was fitted to a part far away and is less exact here, fitted to this part. Nothing if it
    // does not put the part's corners near vertices.
    std::optional<PartMotion> refitted(std::size_t i, const PartMotion& rough) const {
        std::vector<Vec3> from, to;
        if (!near_vertices(i, rough, from, to) || from.size() < 4) return std::nullopt;
        return fit_affine(columns(from), columns(to), rough.linear.determinant() < 0.0);
    }

    // The part's corners that are near vertices after the motion; false if too few are.
    bool near_vertices(std::size_t i, const PartMotion& rough, std::vector<Vec3>& from,
                       std::vector<Vec3>& to) const {
        const std::vector<Vec3>& points = support_.points(i);
        const auto allowed =
            static_cast<std::size_t>((1.0 - enough_anchors) * static_cast<double>(points.size()));
        std::size_t misses = 0;
        for (const Vec3& point : points) {
            const std::uint32_t vertex = support_.grid().nearest(rough(point), support_.grid().widest());
            if (vertex == no_id) {
                if (++misses > allowed) return false;
                continue;
            }
            from.push_back(point);
            to.push_back(mesh_.positions[vertex].cast<double>());
        }
        return true;
    }

    static Eigen::Matrix3Xd columns(const std::vector<Vec3>& corners) {
        return Eigen::Map<const Eigen::Matrix3Xd>(corners.front().data(), 3,
                                                  static_cast<Eigen::Index>(corners.size()));
    }

    // Equal crates can go to each other's new places, and symmetric parts can turn. The motion that explains
    // the most parts is theirs, then the one that explains the most of the others.
    void vote() {
        struct Voter {
            std::size_t part;
            std::vector<std::size_t> motions;
            std::vector<PartMotion> exact;  // of `motions`, as they are for this part
        };
        std::vector<Voter> voters;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!parts_[i].searched || parts_[i].best.is_identity()) continue;
            Voter voter{i, {}, {}};
            for (std::size_t k = 0; k < candidates_.size() && votes_ < max_guesses; ++k) {
                ++votes_;
                const auto allowed = [&](const PartMotion& motion) {
                    const MotionSupport found = support_.support(i, motion, enough_anchors);
                    // What puts every corner in its place may miss faces: they were extruded or deleted.
                    const bool fits = found.sum() >= parts_[i].best_support.sum() - vote_slack ||
                                      found.corners > 1.0 - 1e-9;
                    return found.corners >= enough_anchors && fits && !support_.is_taken(i, motion) &&
                           support_.fills_box(i, motion);
                };
                std::optional<PartMotion> motion = candidates_[k];
                if (!allowed(*motion)) motion = refitted(i, candidates_[k]);
                if (!motion || !allowed(*motion)) continue;
                voter.motions.push_back(k);
                voter.exact.push_back(*motion);
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
                const auto own = std::find(voter.motions.begin(), voter.motions.end(), most);
                if (own == voter.motions.end()) return false;
                Part& part = parts_[voter.part];
                part.best = voter.exact[static_cast<std::size_t>(own - voter.motions.begin())];
                part.best_support = support_.support(voter.part, part.best, enough_anchors);
                return true;
            });
        }
        // A part that is still there, damaged, and also looks like another one, has not become that one.
        for (const Voter& voter : voters) {
            Part& part = parts_[voter.part];
            const Aabb& box = stored_.parts[voter.part].box;
            const double moved = (part.best(box.centre()) - box.centre()).norm();
            if (moved <= box_slack * box.size().norm() || !support_.has_similar_box(voter.part)) continue;
            part.best = PartMotion{};
            part.best_support = part.staying;
        }
    }

    const Mesh& mesh_;
    const FaceIndex& index_;
    const PaintParts& stored_;
    PartSupport support_;
    SimilarFaces similar_;
    std::vector<Part> parts_;
    std::vector<PartMotion> known_;       // the parts' best, to be tried with the next parts
    std::vector<PartMotion> candidates_;  // all that nearly explain as much
    std::size_t candidates_part_ = 0, candidates_of_part_ = 0, votes_ = 0;
    std::size_t guesses_ = 0;
    std::size_t in_order_ = 0, out_of_order_ = 0;  // parts that stayed
};

}  // namespace

std::vector<PartMotion> find_motions(const Mesh& mesh, const FaceIndex& index, SurfaceTable surfaces,
                                     const PaintParts& parts, const std::vector<const FaceKey*>& keys) {
    return Finder(mesh, index, surfaces, parts, keys).run();
}

FaceKey moved_key(const FaceKey& key, const PartMotion& motion) {
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
