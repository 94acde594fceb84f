// What the vertices of a part say about its motion. Most edits leave them in the order of the file, and those
// that only move parts leave each its number.
#include <algorithm>

#include "motion_finder.h"
#include "motion_fit.h"

namespace slipface {
namespace {

constexpr double nearly_all = 0.9;  // of what the parts' vertices can say
constexpr std::size_t little = 12;  // points beyond those that a motion needs
constexpr std::size_t few_parts = 3;
constexpr std::size_t needed = 4;  // points for an affine motion

}  // namespace

// The motion that puts each point onto the vertex of its number. Identity if they are where they were.
std::optional<PartMotion> MotionFinder::motion_of_vertices(std::size_t i) {
    const std::vector<Vec3>& points = support_.points(i);
    const std::vector<std::uint32_t>& numbers = support_.numbers(i);
    if (numbers.size() < needed) return std::nullopt;
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::Matrix3Xd from(3, count), to(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const std::uint32_t vertex = support_.numbered(numbers[static_cast<std::size_t>(k)]);
        if (vertex == no_id) return std::nullopt;
        from.col(k) = points[static_cast<std::size_t>(k)];
        to.col(k) = mesh_.positions[vertex].cast<double>();
    }
    const auto fits = [&](const PartMotion& motion) {
        for (Eigen::Index k = 0; k < count; ++k)
            if (!support_.hits(motion, from.col(k), to.col(k))) return false;
        // The faces must be there as well, though perhaps with new materials.
        return support_.support(i, motion, nearly_all).keys >= 0.5 * nearly_all;
    };
    if (fits(PartMotion{})) return PartMotion{};
    const std::optional<PartMotion> motion = fit_affine(from, to, false);
    return motion && fits(*motion) ? motion : std::nullopt;
}

// If the numbers of nearly all vertices explain the mesh, they decide, even where a symmetric level looks as
// if nothing had happened, or where parts that are alike changed places.
void MotionFinder::trust_vertices() {
    std::vector<std::optional<PartMotion>> motions(parts_.size());
    std::size_t all = 0, kept = 0, parts = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const std::size_t more = std::max(support_.points(i).size(), needed) - needed;
        motions[i] = motion_of_vertices(i);
        all += more;
        if (!motions[i] || more == 0) continue;
        kept += more;
        ++parts;
    }
    if (kept < little || static_cast<double>(kept) < nearly_all * static_cast<double>(all)) return;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        if (!motions[i]) continue;
        const bool stays = motions[i]->is_identity();
        const bool unclear = !stays && part.staying.sum() > 2.0 - 1e-9;
        // A tool that sorts the vertices of a square floor along the other axis turns their numbers over.
        if (unclear && parts < few_parts && !turns_in_place(i, *motions[i])) continue;
        part.certain = true;
        part.best = *motions[i];
        part.best.guessed = unclear && parts < few_parts && types_.differ(i, PartMotion{}, part.best);
        part.best_support = support_.support(i, part.best, 0.0);
        if (stays) continue;
        support_.set_gone(i);
        known_.push_back(part.best);
    }
}

}  // namespace slipface
