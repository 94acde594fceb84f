#include "slipface/mesh/up_doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "slipface/mesh/upright.h"

namespace slipface {
namespace {

constexpr double least_flat = 0.4, least_lead = 1.25, lowest = 0.8;

// [level axis] the fraction of the area whose normal is within 45 degrees of the axis.
Vec3 flat_fractions(const Mesh& mesh) {
    Vec3 flat = Vec3::Zero();
    double all = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 origin = mesh.corner_position(a).cast<double>();
        const Vec3 normal = (mesh.corner_position(b).cast<double>() - origin)
                                .cross(mesh.corner_position(c).cast<double>() - origin);
        const double area = normal.norm();  // twice the triangle's
        all += area;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(normal[axis]) > std::sqrt(0.5) * area) flat[axis] += area;
    }
    return all > 0.0 ? Vec3(flat / all) : Vec3::Zero();
}

// The axis of the file, without its sign, that is along the level's `axis`.
UpAxis file_axis(UpAxis up, int axis) {
    const Vec3f along = upright_rotation(up).transpose() * Vec3f::Unit(axis);
    Eigen::Index largest = 0;
    along.cwiseAbs().maxCoeff(&largest);
    constexpr UpAxis axes[] = {UpAxis::x, UpAxis::y, UpAxis::z};
    return axes[largest];
}

}  // namespace

std::string UpDoubt::text() const {
    return fmt::format("with {} up {:.0f} % of the surface is floor or ceiling, instead of {:.0f} %",
                       up_axis_names[static_cast<std::size_t>(better_up)], 100 * better_flat, 100 * flat);
}

std::optional<UpDoubt> up_doubt(const Mesh& mesh, const ImportSummary& summary) {
    if (summary.up_from != ImportSource::guessed) return std::nullopt;
    const Vec3 flat = flat_fractions(mesh);
    for (const int axis : {0, 2}) {
        const int a = 1, b = 2 - axis;  // the others
        if (flat[axis] < least_flat || flat[axis] < least_lead * std::max(flat[a], flat[b])) continue;
        if (summary.size[axis] > lowest * std::min(summary.size[a], summary.size[b])) continue;
        return UpDoubt{file_axis(summary.up, axis), flat[1], flat[axis]};
    }
    return std::nullopt;
}

}  // namespace slipface
