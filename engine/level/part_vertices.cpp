// What the vertices of a part say about its motion. Most edits leave them in the order of the file, and those
// that only move parts leave each its number.
#include <algorithm>
#include <cmath>

#include "motion_finder.h"
#include "motion_fit.h"

namespace slipface {
namespace {

constexpr double nearly_all = 0.9;  // of what the parts' vertices can say
constexpr double most = 0.6;        // of a part's vertices are where they were, and some were moved
constexpr std::size_t little = 12;  // points beyond those that a motion needs
constexpr std::size_t needed = 4;   // points for an affine motion

}  // namespace

// The motion that puts each point onto the vertex of its number, in the file or in its object. Identity if
// most of them are where they were.
std::optional<PartMotion> MotionFinder::motion_of_vertices(std::size_t i, bool by_object) {
    const std::vector<Vec3>& points = support_.points(i);
    const std::vector<std::uint32_t>& numbers = support_.numbers(i);
    std::vector<Vec3> old_points, new_points;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const std::uint32_t vertex =
            by_object ? support_.numbered_in_object(i, numbers[k]) : support_.numbered(numbers[k]);
        if (vertex == no_id) continue;  // rounding put two vertices at one position
        old_points.push_back(points[k]);
        new_points.push_back(mesh_.positions[vertex].cast<double>());
    }
    const auto count = static_cast<Eigen::Index>(old_points.size());
    if (old_points.size() < needed ||
        static_cast<double>(count) < nearly_all * static_cast<double>(points.size()))
        return std::nullopt;
    const Eigen::Map<const Eigen::Matrix3Xd> from(old_points.front().data(), 3, count);
    const Eigen::Map<const Eigen::Matrix3Xd> to(new_points.front().data(), 3, count);
    const auto fits = [&](const PartMotion& motion) {
        for (Eigen::Index k = 0; k < count; ++k)
            if (!support_.hits(motion, from.col(k), to.col(k))) return false;
        // The faces must be there as well, though perhaps with new materials.
        return support_.support(i, motion, nearly_all).keys >= 0.5 * nearly_all;
    };
    if (fits(PartMotion{})) return PartMotion{};
    const std::optional<PartMotion> motion = fit_affine(from, to, false);
    if (motion && fits(*motion)) return motion;
    Eigen::Index kept = 0;
    for (Eigen::Index k = 0; k < count; ++k)
        kept += support_.hits(PartMotion{}, from.col(k), to.col(k)) ? 1 : 0;
    return static_cast<double>(kept) >= most * static_cast<double>(count) ? std::optional(PartMotion{})
                                                                          : std::nullopt;
}

// If the numbers of nearly all vertices explain the mesh, they decide, even where a symmetric level looks as
// if nothing had happened, or where parts that are alike changed places.
void MotionFinder::trust_vertices() {
    Motions motions(parts_.size());
    // By their objects; and of these, that are in another place.
    std::vector<bool> named(parts_.size(), false), moved(parts_.size(), false);
    std::size_t all = 0, kept = 0, parts = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        motions[i] = motion_of_vertices(i, true);  // tools write objects in another order than they read them
        named[i] = motions[i].has_value();
        const Vec3 centre = stored_.parts[i].box.centre();
        moved[i] = named[i] && !support_.hits(*motions[i], centre, centre);
        const std::size_t points = support_.points(i).size();
        const std::size_t more = moved[i] ? points : std::max(points, needed) - needed;
        if (!motions[i]) motions[i] = motion_of_vertices(i, false);
        all += more;
        if (!motions[i] || more == 0) continue;
        kept += more;
        ++parts;
    }
    if (kept < little || static_cast<double>(kept) < nearly_all * static_cast<double>(all)) return;
    undo_exchanges(motions, named);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        if (!motions[i]) continue;
        const bool stays = motions[i]->is_identity();
        const bool unclear = !stays && part.staying.sum() > 2.0 - 1e-9;
        // A tool that sorts the vertices of a square floor along the other axis turns their numbers over. It
        // leaves an object its place.
        if (unclear && parts < few_parts && !moved[i] && !turns_in_place(i, *motions[i])) continue;
        part.certain = true;
        part.best = *motions[i];
        part.best.guessed = motions[i]->guessed ||
                            (unclear && parts < few_parts && types_.differ(i, PartMotion{}, part.best));
        part.best_support = support_.support(i, part.best, 0.0);
        if (stays) continue;
        support_.set_gone(i);
        known_.push_back(part.best);
    }
}

}  // namespace slipface
