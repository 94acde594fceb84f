#include "slipface/mesh/size_doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace slipface {
namespace {

constexpr double smallest_level = 2.0, largest_level = 4000.0, usual_level = 60.0;  // metres
constexpr double highest_level = 400.0;                                             // metres
constexpr double large_level = 100.0, large_edge = 8.0;                             // metres
// Millimetre, centimetre, inch, Quake unit, foot, metre, and the inverses of those that may be mistaken for
// metres.
constexpr double units[] = {0.001, 0.01,         0.0254,       1.0 / 32.0, 0.3048,
                            1.0,   1.0 / 0.3048, 1.0 / 0.0254, 100.0,      1000.0};

// The 10th percentile of the lengths of the edges, metres.
double short_edge(const Mesh& mesh) {
    std::vector<float> lengths;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        const std::uint32_t first = mesh.face_first_corner[face], count = mesh.face_corner_count(face);
        for (std::uint32_t i = 0; i < count; ++i)
            lengths.push_back(
                (mesh.corner_position(first + (i + 1) % count) - mesh.corner_position(first + i)).norm());
    }
    if (lengths.empty()) return 0.0;
    const auto tenth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 10);
    std::nth_element(lengths.begin(), tenth, lengths.end());
    return *tenth;
}

}  // namespace

std::string SizeDoubt::text() const {
    return fmt::format("{:.6g} m across: too {} for a player; a scale of {:.6g} makes it {:.3g} m", extent,
                       too_large ? "large" : "small", better_scale, better_extent);
}

std::optional<SizeDoubt> size_doubt(const Mesh& mesh, const ImportSummary& summary) {
    if (summary.scale_from == ImportSource::given) return std::nullopt;
    SizeDoubt doubt;
    doubt.extent = summary.size.maxCoeff();
    if (!(doubt.extent > 0)) return std::nullopt;
    doubt.too_large = doubt.extent > largest_level || summary.size.y() > highest_level ||
                      (doubt.extent > large_level && short_edge(mesh) > large_edge);
    if (!doubt.too_large && !(doubt.extent < smallest_level)) return std::nullopt;
    const double in_file_units = doubt.extent / summary.scale;
    const auto* const best = std::min_element(std::begin(units), std::end(units), [&](double a, double b) {
        return std::abs(std::log(a * in_file_units / usual_level)) <
               std::abs(std::log(b * in_file_units / usual_level));
    });
    doubt.better_scale = *best;
    doubt.better_extent = *best * in_file_units;
    return doubt;
}

}  // namespace slipface
