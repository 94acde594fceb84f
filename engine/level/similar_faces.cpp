#include "similar_faces.h"

#include <algorithm>
#include <cmath>

#include "motion_fit.h"

namespace slipface {

double SimilarFaces::perimeter(FaceId face) const {
    const std::uint32_t first = mesh_.face_first_corner[face];
    const std::uint32_t count = mesh_.face_corner_count(face);
    double length = 0.0;
    for (std::uint32_t c = 0; c < count; ++c)
        length += static_cast<double>(
            (mesh_.corner_position(first + (c + 1) % count) - mesh_.corner_position(first + c)).norm());
    return length;
}

void SimilarFaces::sort_shapes() {
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

std::vector<FaceId> SimilarFaces::of(const std::vector<Vec3f>& polygon, double length, double area) {
    sort_shapes();
    const double wanted = length * length / area;
    auto at = std::lower_bound(shapes_.begin(), shapes_.end(), 0.999 * wanted,
                               [](const Shape& a, double value) { return a.roundness < value; });
    std::vector<FaceId> faces;
    for (; at != shapes_.end() && at->roundness < 1.001 * wanted; ++at)
        if (mesh_.face_corner_count(at->face) == polygon.size()) faces.push_back(at->face);
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

std::vector<PartMotion> SimilarFaces::motions(const std::vector<Vec3f>& polygon, FaceId face) const {
    std::vector<PartMotion> motions;
    const std::size_t count = polygon.size();
    const std::uint32_t first = mesh_.face_first_corner[face];
    Eigen::Matrix3Xd from(3, count), to(3, count);
    double old_length = 0.0;
    for (std::size_t c = 0; c < count; ++c) {
        from.col(static_cast<Eigen::Index>(c)) = polygon[c].cast<double>();
        old_length += static_cast<double>((polygon[(c + 1) % count] - polygon[c]).norm());
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
                        static_cast<double>((polygon[(c + reach) % count] - polygon[c]).norm());
                    const double new_edge =
                        static_cast<double>((corner(partner(c + reach)) - corner(partner(c))).norm());
                    fits = fits && std::abs(new_edge - scale * old_edge) <= slack;
                }
            }
            if (!fits) continue;
            for (std::size_t c = 0; c < count; ++c)
                to.col(static_cast<Eigen::Index>(c)) = corner(partner(c)).cast<double>();
            const std::optional<PartMotion> straight = fit_similarity(from, to, false);
            if (!straight) continue;
            motions.push_back(*straight);
            // The polygon is flat: a reflection in its plane does not change it.
            const Vec3 centre = from.rowwise().mean();
            Vec3 normal = Vec3::Zero();
            for (Eigen::Index c = 0; c < from.cols(); ++c)
                normal += (from.col(c) - centre).cross(from.col((c + 1) % from.cols()) - centre);
            if (!(normal.norm() > 0.0)) continue;
            normal.normalize();
            PartMotion mirrored = *straight;
            mirrored.linear =
                straight->linear * (Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose());
            mirrored.offset = (*straight)(centre)-mirrored.linear * centre;
            motions.push_back(mirrored);
        }
    }
    return motions;
}

}  // namespace slipface
