#include "similar_corners.h"

#include <algorithm>
#include <cmath>

#include "motion_fit.h"

namespace slipface {
namespace {

constexpr float same_shape = 2e-3f;  // of the sides' ratios
constexpr double same_size = 1e-3;

struct Sides {
    double opposite, shorter, longer;
    bool turned;  // the first side is the longer one
};

Sides sides_of(const ThreeCorners& three) {
    const double first = (three[1] - three[0]).norm(), second = (three[2] - three[1]).norm();
    const double longer = std::max(first, second);
    return {(three[2] - three[0]).norm() / longer, std::min(first, second) / longer, longer, first > second};
}

}  // namespace

ThreeCorners SimilarCorners::corners(const Shape& shape) const {
    const std::uint32_t first = mesh_.face_first_corner[shape.face],
                        count = mesh_.face_corner_count(shape.face);
    const auto at = [&](std::uint32_t step) {
        return mesh_.corner_position(first + (shape.corner - first + step) % count).cast<double>().eval();
    };
    return {at(count - 1), at(0), at(1)};
}

std::pair<SimilarCorners::Shapes::const_iterator, SimilarCorners::Shapes::const_iterator>
SimilarCorners::like(const ThreeCorners& three) {
    if (shapes_.empty()) {
        for (FaceId face = 0; face < mesh_.face_count(); ++face) {
            for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1];
                 ++c) {
                const Sides sides = sides_of(corners({0.0f, 0.0f, face, c}));
                if (sides.shorter > 0.0)
                    shapes_.push_back(
                        {static_cast<float>(sides.opposite), static_cast<float>(sides.shorter), face, c});
            }
        }
        std::sort(shapes_.begin(), shapes_.end(), [](const Shape& a, const Shape& b) {
            return a.opposite != b.opposite ? a.opposite < b.opposite : a.corner < b.corner;
        });
    }
    const auto opposite = static_cast<float>(sides_of(three).opposite);
    const auto below = [](const Shape& a, float value) { return a.opposite < value; };
    const auto begin = std::lower_bound(shapes_.begin(), shapes_.end(), opposite - same_shape, below);
    return {begin, std::lower_bound(begin, shapes_.end(), opposite + same_shape, below)};
}

std::size_t SimilarCorners::count(const ThreeCorners& three) {
    const auto [begin, end] = like(three);
    return static_cast<std::size_t>(end - begin);
}

std::vector<ThreeCorners> SimilarCorners::of(const ThreeCorners& three, std::size_t most) {
    const Sides wanted = sides_of(three);
    std::vector<std::pair<double, const Shape*>> found;  // change of size
    const auto [begin, end] = like(three);
    for (auto at = begin; at != end; ++at) {
        if (std::abs(at->shorter - static_cast<float>(wanted.shorter)) > same_shape) continue;
        const double change = std::abs(std::log(sides_of(corners(*at)).longer / wanted.longer));
        found.push_back({change < same_size ? 0.0 : change, &*at});
    }
    const std::size_t count = std::min(most, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), found.end());
    std::vector<ThreeCorners> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(corners(*found[i].second));
    return result;
}

std::vector<PartMotion> SimilarCorners::motions(const ThreeCorners& from, const ThreeCorners& to) {
    std::vector<PartMotion> motions;
    const Sides old = sides_of(from), now = sides_of(to);
    Eigen::Matrix3Xd before(3, 3), after(3, 3);
    before << from[0], from[1], from[2];
    for (const bool reversed : {false, true}) {
        // Of equal sides each may be the other.
        if (old.shorter < 1.0 - static_cast<double>(same_shape) && reversed != (old.turned != now.turned))
            continue;
        after << to[reversed ? 2 : 0], to[1], to[reversed ? 0 : 2];
        const std::optional<PartMotion> straight = fit_similarity(before, after, false);
        const Vec3 across = (from[1] - from[0]).cross(from[2] - from[1]);
        if (!straight || !(across.norm() > 0.0)) continue;
        motions.push_back(*straight);
        // A reflection in their plane does not change them.
        const Vec3 normal = across.normalized();
        PartMotion mirrored = *straight;
        mirrored.linear =
            straight->linear * (Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose());
        mirrored.offset = (*straight)(from[1]) - mirrored.linear * from[1];
        motions.push_back(mirrored);
    }
    return motions;
}

}  // namespace slipface
