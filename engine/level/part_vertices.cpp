// What the vertices of an object say about the motions of its parts: tools that sort faces leave the vertices
// in the order of the file, and those that move parts leave each its number.
#include <algorithm>
#include <map>

#include "face_match.h"
#include "mesh_parts.h"
#include "motion_fit.h"
#include "slipface/base/key_sort.h"

namespace slipface {
namespace {

constexpr std::size_t needed = 4;  // points for a motion

// The vertices of each group in the order of the file.
class VertexOrder {
  public:
    explicit VertexOrder(const Mesh& mesh) : follows_faces_(mesh.groups.size(), true) {
        std::vector<std::uint32_t> seen_by(mesh.positions.size(), no_id);
        std::uint32_t last_group = no_id, highest = 0;
        for (const FaceId face : faces_by_group(mesh)) {
            const std::uint32_t group = mesh.face_group[face];
            if (group != last_group) highest = 0;
            last_group = group;
            for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
                const std::uint32_t vertex = mesh.corner_vertex[c];
                if (seen_by[vertex] == group) continue;
                seen_by[vertex] = group;
                const std::uint32_t number = mesh.number_in_group(group, vertex);
                if (number < highest) follows_faces_[group] = false;
                highest = std::max(highest, number);
                list_.push_back({std::uint64_t{group} << 32 | number, vertex});
            }
        }
        sort_by_key(list_);
    }

    // In the order in which the faces use them: they say nothing that the order of the faces does not.
    bool follows_faces(std::uint32_t group) const { return follows_faces_[group]; }

    // Its vertex that many numbers after the first; no_id: none.
    std::uint32_t vertex(std::uint32_t group, std::uint32_t number) const {
        const auto at = [&](std::uint64_t key) {
            return std::lower_bound(list_.begin(), list_.end(), key,
                                    [](const KeyedIndex& one, std::uint64_t k) { return one.key < k; });
        };
        const auto first = at(std::uint64_t{group} << 32);
        if (first == list_.end() || first->key >> 32 != group) return no_id;
        const std::uint64_t key = first->key + number;
        const auto found = at(key);
        return found != list_.end() && found->key == key && key >> 32 == group ? found->index : no_id;
    }

  private:
    std::vector<bool> follows_faces_;  // [group]
    std::vector<KeyedIndex> list_;     // by group, then by number
};

// The motion that puts all points onto those of the same numbers.
std::optional<PartMotion> motion_between(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    const auto fits = [&](const PartMotion& motion) {
        const double scale = scale_of(motion);
        for (std::size_t k = 0; k < from.size(); ++k)
            if (!((motion(from[k]) - to[k]).norm() <=
                  2.0 * position_tolerance(to[k]) + scale * position_tolerance(from[k])))
                return false;
        return true;
    };
    if (from.size() < needed) return std::nullopt;
    if (fits(PartMotion{})) return PartMotion{};
    const auto count = static_cast<Eigen::Index>(from.size());
    const std::optional<PartMotion> motion =
        fit_affine(Eigen::Map<const Eigen::Matrix3Xd>(from.front().data(), 3, count),
                   Eigen::Map<const Eigen::Matrix3Xd>(to.front().data(), 3, count), false);
    return motion && fits(*motion) ? motion : std::nullopt;
}

}  // namespace

VertexMotions motions_of_vertices(const Mesh& mesh, const PaintParts& parts) {
    VertexMotions motions(parts.parts.size());
    if (std::all_of(parts.parts.begin(), parts.parts.end(),
                    [](const PaintPart& part) { return part.numbers.empty(); }))
        return motions;
    const VertexOrder order(mesh);
    const ObjectNames names(mesh, parts);
    std::map<std::uint32_t, std::uint32_t> group_of;  // [name]; no_id: of several
    for (std::uint32_t group = 0; group < mesh.groups.size(); ++group)
        if (const auto [place, added] = group_of.try_emplace(names.of_group[group], group); !added)
            place->second = no_id;
    for (std::size_t i = 0; i < parts.parts.size(); ++i) {
        const PaintPart& part = parts.parts[i];
        const auto faces = names.in_mesh.find(part.object);
        if (part.numbers.empty() || faces == names.in_mesh.end() ||
            faces->second != names.in_old.at(part.object))
            continue;  // others were added or deleted, and numbers have slid
        const std::uint32_t group = group_of.at(part.object);
        if (group == no_id || order.follows_faces(group)) continue;
        std::vector<Vec3> from, to;
        std::size_t corner = 0;
        bool all = true;
        for (const AnchorFace& anchor : part.anchors)
            for (const Vec3f& position : anchor) {
                const std::uint32_t vertex =
                    corner < part.numbers.size() ? order.vertex(group, part.numbers[corner++]) : no_id;
                all = all && vertex != no_id;
                if (!all) continue;
                from.emplace_back(position.cast<double>());
                to.emplace_back(mesh.positions[vertex].cast<double>());
            }
        if (all) motions[i] = motion_between(from, to);
    }
    return motions;
}

}  // namespace slipface
