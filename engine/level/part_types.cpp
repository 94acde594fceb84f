#include "part_types.h"

#include <algorithm>

#include "face_match.h"

namespace slipface {
namespace {

constexpr std::size_t max_compared = 64;  // faces of a part

}  // namespace

PartTypes::PartTypes(const PaintParts& parts, const std::vector<StoredOverride>& stored)
    : faces_(parts.parts.size()) {
    for (std::size_t i = 0; i < stored.size() && i < parts.of.size(); ++i)
        if (parts.of[i] > 0 && parts.of[i] <= faces_.size()) faces_[parts.of[i] - 1u].push_back(&stored[i]);
}

bool PartTypes::differ(std::size_t part, const PartMotion& a, const PartMotion& b) const {
    return !all_found(faces_[part], a, b) || !all_found(faces_[part], b, a);
}

// Whether the faces after `from` are among those after `to`, with their types.
bool PartTypes::all_found(const Faces& faces, const PartMotion& from, const PartMotion& to) {
    struct Moved {
        FaceKey key;
        const std::string* type;
    };
    std::vector<Moved> moved;
    for (const StoredOverride* face : faces)
        moved.push_back({moved_key(face->key, to), &face->type});
    std::sort(moved.begin(), moved.end(),
              [](const Moved& a, const Moved& b) { return a.key.centroid.x() < b.key.centroid.x(); });
    const std::size_t step = faces.size() / max_compared + 1;
    for (std::size_t i = 0; i < faces.size(); i += step) {
        const FaceKey key = moved_key(faces[i]->key, from);
        const double slack = 8.0 * position_tolerance(key.centroid);
        auto at = std::lower_bound(moved.begin(), moved.end(), key.centroid.x() - slack,
                                   [](const Moved& one, double x) { return one.key.centroid.x() < x; });
        const auto same = [&](const Moved& other) {
            return (other.key.centroid - key.centroid).cwiseAbs().maxCoeff() <= slack &&
                   other.key.normal.dot(key.normal) > 0.99 && *other.type == faces[i]->type;
        };
        while (at != moved.end() && at->key.centroid.x() <= key.centroid.x() + slack && !same(*at))
            ++at;
        if (at == moved.end() || at->key.centroid.x() > key.centroid.x() + slack) return false;
    }
    return true;
}

}  // namespace slipface
