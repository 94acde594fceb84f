// Old faces that were cut along lines between their own corners, as triangulating does.
#include <algorithm>
#include <set>

#include "face_matcher.h"
#include "packed_faces.h"

namespace slipface {
namespace {

constexpr std::size_t max_corners_cut = 32;

}  // namespace

// The old faces at whose place there was no other, sorted.
std::vector<std::size_t> FaceMatcher::single_faces() const {
    std::vector<KeyedIndex> places;
    for (std::uint32_t i = 0; i < stored_.size(); ++i)
        places.push_back({packed_hash(stored_[i].key.loop_hash), i});
    sort_by_key(places);
    std::vector<std::size_t> single;
    for (std::size_t k = 0; k < places.size(); ++k)
        if ((k == 0 || places[k - 1].key != places[k].key) &&
            (k + 1 == places.size() || places[k + 1].key != places[k].key))
            single.push_back(places[k].index);
    std::sort(single.begin(), single.end());
    return single;
}

// New faces of its material whose corners are all the old one's, and whose edges are its edges or lie between
// two of them, are the old face and nothing else.
bool FaceMatcher::match_triangles(std::size_t i) {
    const std::size_t corners = outlines_[i].size();
    if (corners < 4 || corners > max_corners_cut) return false;
    const std::vector<Vec3>& outline = outlines_[i];
    Aabb box;
    for (const Vec3& corner : outline)
        box.add(corner);
    const double reach = corner_reach(i);
    const auto corner_at = [&](const Vec3& position) {
        std::size_t c = 0;
        while (c < corners && (position - outline[c]).norm() > reach)
            ++c;
        return c;
    };
    std::vector<FaceId> pieces;
    std::set<std::pair<std::size_t, std::size_t>> edges;  // of the pieces, but for those between two of them
    for (const FaceId face : faces_in(i, box)) {
        if (!is_free(face)) continue;
        std::vector<std::size_t> at;
        for (std::uint32_t c = mesh_.face_first_corner[face]; c < mesh_.face_first_corner[face + 1]; ++c)
            at.push_back(corner_at(mesh_.corner_position(c).cast<double>()));
        if (std::find(at.begin(), at.end(), corners) != at.end()) continue;
        pieces.push_back(face);
        for (std::size_t c = 0; c < at.size(); ++c) {
            const std::size_t next = at[(c + 1) % at.size()];
            if (edges.erase({next, at[c]}) == 0 && !edges.insert({at[c], next}).second) return false;
        }
    }
    if (pieces.size() < 2 || edges.size() != corners) return false;
    for (std::size_t c = 0; c < corners; ++c)
        if (!edges.contains({c, (c + 1) % corners})) return false;
    for (const FaceId piece : pieces)
        claim(piece, i, MatchStage::exact);
    return true;
}

}  // namespace slipface
