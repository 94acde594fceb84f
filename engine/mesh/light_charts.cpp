#include "slipface/mesh/light_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "slipface/base/hash.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

// On floors u is the x axis; on other faces u is horizontal and v is the steepest line of the plane. So
// neighbours in one plane have the same axes.
void set_axes(LightChart& chart, const Vec3& normal) {
    if (std::abs(normal.y()) > 0.999) {
        chart.u = Vec3::UnitX();
    } else {
        chart.u = Vec3(normal.z(), 0, -normal.x()).normalized();
    }
    chart.v = normal.cross(chart.u).normalized();
    chart.u = chart.v.cross(normal).normalized();
}

// The number of texels along a side of `length` metres. `step`: the distance between them.
std::uint16_t divide(double length, double texel_m, double& step) {
    step = 0.0;
    if (length < 0.35 * texel_m) return 1;
    const double wanted = std::ceil(length / texel_m - 1e-6) + 1.0;
    const double count = std::min(std::max(wanted, 2.0), static_cast<double>(max_light_chart_side));
    step = length / (count - 1.0);
    return static_cast<std::uint16_t>(count);
}

LightChart chart_of(const Mesh& mesh, FaceId face, double texel_m) {
    LightChart chart;
    const Vec3 normal = face_normal(mesh, face);
    if (normal.squaredNorm() < 0.5) return chart;
    set_axes(chart, normal);
    const Vec3 centre = face_centroid(mesh, face);
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t i = mesh.face_first_corner[face]; i < mesh.face_first_corner[face + 1]; ++i) {
        const Vec3 offset = mesh.corner_position(i).cast<double>() - centre;
        const Vec2 position(offset.dot(chart.u), offset.dot(chart.v));
        low = low.cwiseMin(position);
        high = high.cwiseMax(position);
    }
    chart.width = divide(high.x() - low.x(), texel_m, chart.step.x());
    chart.height = divide(high.y() - low.y(), texel_m, chart.step.y());
    const Vec2 start(chart.width == 1 ? 0.5 * (low.x() + high.x()) : low.x(),
                     chart.height == 1 ? 0.5 * (low.y() + high.y()) : low.y());
    chart.origin = centre + start.x() * chart.u + start.y() * chart.v;
    return chart;
}

std::uint64_t geometry_hash(const Mesh& mesh, double texel_m) {
    Hasher hasher;
    hasher.f64(texel_m);
    for (const std::uint32_t corner : mesh.face_first_corner)
        hasher.u64(corner);
    for (std::uint32_t corner = 0; corner < mesh.corner_vertex.size(); ++corner) {
        const Vec3 position = mesh.corner_position(corner).cast<double>();
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(position[axis]);
    }
    return hasher.value();
}

// The width of an approximately square map: a multiple of 64.
int map_width(std::uint64_t texels, int widest) {
    const double side = std::sqrt(1.04 * static_cast<double>(texels));
    const int rounded = 64 * static_cast<int>(std::ceil(side / 64.0));
    return std::max(rounded, 64 * ((widest + 63) / 64));
}

// Shelf packing: highest first, from left to right; a new shelf when the row is full. Returns the height
// used.
int pack(std::vector<LightChart>& charts, int width) {
    std::vector<std::uint32_t> order(charts.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (charts[a].height != charts[b].height) return charts[a].height > charts[b].height;
        return charts[a].width > charts[b].width;
    });
    int x = 0, y = 0, shelf = 0;
    for (const std::uint32_t face : order) {
        LightChart& chart = charts[face];
        if (chart.width == 0) continue;
        if (x + chart.width > width) {
            y += shelf;
            x = shelf = 0;
        }
        shelf = std::max<int>(shelf, chart.height);
        if (y + shelf > max_light_map_side) return y + shelf;
        chart.x = static_cast<std::uint16_t>(x);
        chart.y = static_cast<std::uint16_t>(y);
        x += chart.width;
    }
    return y + shelf;
}

}  // namespace

Vec2 LightChart::coordinate(const Vec3& point) const {
    const Vec3 offset = point - origin;
    const double i = width > 1 ? offset.dot(u) / step.x() : 0.0;
    const double j = height > 1 ? offset.dot(v) / step.y() : 0.0;
    return {std::clamp(i, 0.0, std::max(0.0, width - 1.0)), std::clamp(j, 0.0, std::max(0.0, height - 1.0))};
}

Result<LightCharts> light_charts(const Mesh& mesh, double texel_m) {
    if (!(texel_m > 0.0) || !std::isfinite(texel_m))
        return Error{"light map", "a texel of " + to_text(texel_m) + " m; expected more than 0"};
    LightCharts result;
    std::uint64_t texels = 0;
    int widest = 1;
    result.charts.reserve(mesh.face_count());
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const LightChart chart = chart_of(mesh, face, texel_m);
        texels += std::uint64_t{chart.width} * chart.height;
        widest = std::max<int>(widest, chart.width);
        result.charts.push_back(chart);
    }
    result.width = map_width(texels, widest);
    result.height = result.width > max_light_map_side ? result.width : pack(result.charts, result.width);
    if (result.height > max_light_map_side || result.width > max_light_map_side) {
        return Error{"light map", std::to_string(texels) + " texels of " + to_text(texel_m) +
                                      " m do not fit into " + std::to_string(max_light_map_side) + " x " +
                                      std::to_string(max_light_map_side) + "; take larger texels"};
    }
    result.height = std::max(result.height, 1);
    result.geometry = geometry_hash(mesh, texel_m);
    return result;
}

}  // namespace slipface
