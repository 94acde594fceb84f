#include "vertex_grid.h"

#include <algorithm>

#include "slipface/base/hash.h"

namespace slipface {

VertexGrid::VertexGrid(const Mesh& mesh) : mesh_(mesh) {
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

std::uint32_t VertexGrid::nearest(const Vec3& position, double tolerance) const {
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

std::uint64_t VertexGrid::code(const Vec3& cell) {
    Hasher hasher;
    for (int axis = 0; axis < 3; ++axis)
        hasher.f64(cell[axis]);
    return hasher.value();
}

}  // namespace slipface
