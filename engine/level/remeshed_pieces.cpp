// Which pieces of the mesh an edit made anew of stored parts, as a remesh does: with other faces, and of one
// material.
#include <algorithm>

#include "face_matcher.h"
#include "part_support.h"

namespace slipface {

const MeshParts& FaceMatcher::pieces() {
    if (pieces_) return *pieces_;
    pieces_ = mesh_parts(mesh_, surfaces_);
    mixed_.resize(pieces_->parts.size(), false);
    for (FaceId face = 0; face < mesh_.face_count(); ++face) {
        const std::uint32_t piece = pieces_->of[face];
        const FaceId first = pieces_->sorted[pieces_->first[piece]];
        if (index_.base(face) != index_.base(first)) mixed_[piece] = true;
    }
    return *pieces_;
}

// Whether the face is of a piece that was remeshed from the stored face's part, which loses the materials.
bool FaceMatcher::is_remeshed(FaceId face, std::size_t i) {
    const std::size_t old = i < parts_.of.size() ? parts_.of[i] : 0;
    if (old == 0 || old > parts_.parts.size()) return false;
    const std::uint32_t piece = pieces().of[face];
    const std::vector<std::size_t>& from = remeshed_from(piece);
    return std::binary_search(from.begin(), from.end(), old - 1) &&
           pieces().parts[piece].faces != parts_.parts[old - 1].faces;
}

// The stored parts that were remeshed to this piece of one material: the one whose box it fills; or one of
// which nothing is left, and that it lies in; or those of its object, if all of that was remeshed.
const std::vector<std::size_t>& FaceMatcher::remeshed_from(std::uint32_t piece) {
    const MeshParts& pieces = this->pieces();
    remeshed_from_.resize(pieces.parts.size());
    if (remeshed_from_[piece]) return *remeshed_from_[piece];
    std::vector<std::size_t>& from = remeshed_from_[piece].emplace();
    if (mixed_[piece] || pieces.scattered[piece]) return from;
    const PaintPart& part = pieces.parts[piece];
    const bool object = remeshed_objects().contains(part.object.name);
    lookup_.visits += parts_.parts.size();
    for (std::size_t old = 0; old < parts_.parts.size(); ++old) {
        const std::uint32_t name = parts_.parts[old].object.name;
        if (objects_.differ(name, part.object.name)) continue;
        const Aabb box = moved_box(old);
        if (similar_box(part.box, box, remeshed_slack) ||
            (object && name == part.object.name && touch(part.box, box)) ||
            (is_gone(old) && lies_in(part.box, box, 1e-3 * part.box.size().norm()) && is_new(part, old)))
            from.push_back(old);
    }
    return from;
}

// The names of objects that were remeshed: nothing of them is as it was.
const std::set<std::uint32_t>& FaceMatcher::remeshed_objects() {
    if (remeshed_objects_) return *remeshed_objects_;
    remeshed_objects_.emplace();
    for (const PaintPart& part : parts_.parts)
        if (!part.anchors.empty()) remeshed_objects_->insert(part.object.name);
    for (std::size_t old = 0; old < parts_.parts.size(); ++old)
        if (!is_gone(old)) remeshed_objects_->erase(parts_.parts[old].object.name);
    if (remeshed_objects_->empty()) return *remeshed_objects_;  // the pieces of a large mesh take a while
    const std::set<std::uint32_t> made =
        objects_of_one_material(index_, pieces(), parts_, stored_, surfaces_);
    std::erase_if(*remeshed_objects_, [&](std::uint32_t name) { return !made.contains(name); });
    return *remeshed_objects_;
}

bool FaceMatcher::is_of_remeshed_object(FaceId face) {
    return !remeshed_objects().empty() &&
           remeshed_objects().contains(pieces().parts[pieces().of[face]].object.name);
}

// Whether no painted face of the part is as it was.
bool FaceMatcher::is_gone(std::size_t part) {
    if (gone_.empty()) {
        gone_.resize(parts_.parts.size(), true);
        for (std::size_t i = 0; i < stored_.size() && i < parts_.of.size(); ++i)
            if (found_[i] == MatchStage::exact && parts_.of[i] > 0 && parts_.of[i] <= gone_.size())
                gone_[parts_.of[i] - 1u] = false;
    }
    return gone_[part];
}

// Whether no stored part but `old` fills the box of this part of the mesh.
bool FaceMatcher::is_new(const PaintPart& part, std::size_t old) const {
    for (std::size_t i = 0; i < parts_.parts.size(); ++i)
        if (i != old && similar_box(part.box, moved_box(i), remeshed_slack)) return false;
    return true;
}

// The box of the stored part where it went.
Aabb FaceMatcher::moved_box(std::size_t part) const {
    const Aabb& old = parts_.parts[part].box;
    if (part >= motions_.size()) return old;
    Aabb box;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 at = old.min;
        for (int axis = 0; axis < 3; ++axis)
            if ((corner >> axis & 1) != 0) at[axis] = old.max[axis];
        box.add(motions_[part](at));
    }
    return box;
}

}  // namespace slipface
