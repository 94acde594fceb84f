// A level file has outlines in few bytes, too rough for long thin faces: their corners are looked for among
// the vertices of the mesh. Their mean and their area, which are known exactly, tell whether they are the
// right ones.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "face_matcher.h"

namespace slipface {
namespace {

constexpr std::size_t max_near = 6;             // vertices near a corner
constexpr std::size_t max_tried = 400;          // of all choices of them
constexpr std::size_t max_looked = 10'000'000;  // triangles, for all faces
constexpr double bent = 0.15;                   // of a face's size, off its plane
constexpr double rough = 0.1;                   // of what is narrow in a face: its corners must be exact

double area_along(std::span<const Vec3> corners, const Vec3& normal) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t c = 0; c < corners.size(); ++c)
        sum += (corners[c] - corners[0]).cross(corners[(c + 1) % corners.size()] - corners[0]);
    return 0.5 * normal.dot(sum);
}

// The shortest edge, or how high the face is above the longest.
double narrowest(std::span<const Vec3> corners, double area) {
    double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const double length = (corners[(c + 1) % corners.size()] - corners[c]).norm();
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
    }
    return std::min(shortest, 2.0 * area / longest);
}

// Chooses one of the positions near each corner so that all have the mean and the area.
class CornerChoice {
  public:
    CornerChoice(std::span<const std::vector<Vec3>> near, const FaceKey& key) : near_(near), key_(key) {}

    // `last`: where the last corner is within `reach`, seen along the normal, if it is none of the positions.
    bool find(std::vector<Vec3>& chosen, const Vec3* last = nullptr, double reach = 0.0) {
        chosen.clear();
        tried_ = 0;
        last_ = last;
        reach_ = reach;
        return add(chosen, Vec3::Zero());
    }

  private:
    bool add(std::vector<Vec3>& chosen, const Vec3& sum) {
        if (++tried_ > max_tried) return false;
        if (chosen.size() + 1 == near_.size()) return add_last(chosen, sum);
        for (const Vec3& position : near_[chosen.size()]) {
            chosen.push_back(position);
            if (add(chosen, sum + position)) return true;
            chosen.pop_back();
        }
        return false;
    }

    bool add_last(std::vector<Vec3>& chosen, const Vec3& sum) {
        const auto count = static_cast<double>(near_.size());
        const Vec3 rest = count * key_.centroid - sum;
        bool fits = false;
        if (last_ != nullptr) {
            const Vec3 normal = key_.normal.normalized(), offset = rest - *last_;
            fits = (offset - normal.dot(offset) * normal).norm() <= reach_;
        } else {
            const double slack = count * position_tolerance(key_.centroid);
            fits = std::any_of(near_.back().begin(), near_.back().end(),
                               [&](const Vec3& position) { return (position - rest).norm() <= slack; });
        }
        if (!fits) return false;
        chosen.push_back(rest);
        if (has_area(chosen)) return true;
        chosen.pop_back();
        return false;
    }

    bool has_area(std::span<const Vec3> corners) const {
        double length = 0.0;
        for (std::size_t c = 0; c < corners.size(); ++c)
            length += (corners[(c + 1) % corners.size()] - corners[c]).norm();
        return std::abs(area_along(corners, key_.normal.normalized()) - key_.area) <=
               1e-3 * key_.area + position_tolerance(key_.centroid) * length;
    }

    std::span<const std::vector<Vec3>> near_;  // [corner]
    const FaceKey& key_;
    const Vec3* last_ = nullptr;
    double reach_ = 0.0;
    std::size_t tried_ = 0;
};

}  // namespace

// The outline becomes exact, or stays as it is if an edit moved or took out more than one of its corners.
bool FaceMatcher::sharpen(std::size_t i) {
    if (sharp_[i] || outline_visits_ > max_looked) return sharp_[i];
    const FaceKey& key = this->key(i);
    const double rounding = this->rounding(i);
    std::vector<Vec3>& outline = outlines_[i];
    const Vec3 normal = unit_or_zero(key.normal);
    const double off = bent * std::sqrt(key.area);
    std::vector<std::vector<Vec3>> near(outline.size());
    std::size_t gone = 0;
    for (std::size_t c = 0; c < outline.size(); ++c) {
        const Vec3 reach = (off * normal.cwiseAbs()).array() + rounding + position_tolerance(outline[c]);
        Aabb box;
        box.add(outline[c] - reach);
        box.add(outline[c] + reach);
        for (const TriangleId triangle : lookup_.tree()->triangles_in(box)) {
            ++outline_visits_;
            for (const std::uint32_t corner : mesh_.triangles[triangle]) {
                const Vec3 position = mesh_.corner_position(corner).cast<double>();
                const Vec3 offset = position - outline[c];
                const double along = normal.dot(offset);
                if (std::abs(along) <= off + position_tolerance(position) &&
                    (offset - along * normal).norm() <= rounding + position_tolerance(position) &&
                    std::find(near[c].begin(), near[c].end(), position) == near[c].end())
                    near[c].push_back(position);
            }
        }
        gone += near[c].empty() ? 1 : 0;
        if (gone > 1) return false;
        std::stable_sort(near[c].begin(), near[c].end(), [&](const Vec3& a, const Vec3& b) {
            return (a - outline[c]).squaredNorm() < (b - outline[c]).squaredNorm();
        });
        if (near[c].size() > max_near) near[c].resize(max_near);
    }
    std::vector<Vec3> exact;
    if (gone == 0 && CornerChoice(near, key).find(exact)) outline = exact;
    // An edit may have taken one corner: the mean says where it was.
    for (std::size_t c = 0; c < outline.size() && exact.empty(); ++c) {
        std::rotate(near.begin(), near.begin() + 1, near.end());
        std::rotate(outline.begin(), outline.begin() + 1, outline.end());
        if (gone > 0 && !near.back().empty()) continue;
        if (CornerChoice(near, key).find(exact, &outline.back(), rounding)) outline = exact;
    }
    sharp_[i] = !exact.empty();
    return sharp_[i];
}

// Whether rounding of the outline could move it over a face as narrow as this.
bool FaceMatcher::is_rough(std::size_t i, FaceId face) const {
    std::vector<Vec3> corners;
    for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c)
        corners.emplace_back(mesh_.corner_position(c).cast<double>());
    return rounding(i) > rough * narrowest(corners, index_.key(face).area);
}

// Those that rounding could make another face's.
void FaceMatcher::sharpen_outlines() {
    sharp_.assign(stored_.size(), false);
    for (std::size_t i = 0; i < stored_.size(); ++i) {
        if (outlines_[i].empty()) continue;
        if (rounding(i) > rough * narrowest(outlines_[i], key(i).area)) sharpen(i);
    }
}

double FaceMatcher::rounding(std::size_t i) const {
    const PartMotion* const motion = motion_of(i);
    const double scale = motion == nullptr ? 1.0 : motion->linear.colwise().norm().maxCoeff();
    return scale * parts_.outlines.rounding(i, stored_[i].key);
}

}  // namespace slipface
