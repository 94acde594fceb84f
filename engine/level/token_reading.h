// Ways to read how the faces of one object became those of another one.
#pragma once

#include <span>
#include <vector>

#include "face_tokens.h"

namespace slipface {

// The faces of an object before and after an edit.
struct ObjectEdit {
    std::span<const FaceToken> old, now;
    TokenObject box;  // of the old ones: where they were and how exactly that is known

    // From the place of the old face `a` to that of the new face `b`.
    Vec3 away(std::size_t a, std::size_t b) const;
    // Whether two such ways, of which one ends at the new face, are the same as far as that is known.
    bool same_place(const Vec3& a, const Vec3& b, std::size_t face) const;
    // Whether the face `b` of now has the old face `a`'s place.
    bool in_place(std::size_t a, std::size_t b) const;
    // Whether the faces are as far from the faces `last_a` and `last_b` as each other: all moved as one body.
    bool moved_together(std::size_t a, std::size_t b, std::size_t last_a, std::size_t last_b) const;
};

struct Reading {
    std::vector<std::uint32_t> before;  // [face of now] the old face that became it; no_id: none
    bool whole = false;                 // face k became face k, or its triangles, all through the object
    std::size_t matched = 0;            // faces of now that have one
    std::size_t in_place = 0;           // of these
    // Up to 3 per matched face: joined to others as before, shaped as before, and moved together with the
    // face before it.
    std::size_t score = 0;
    // Stretches of the order in which old faces went and others came that are not as many: they have to be
    // explained by more than one edit.
    std::size_t replaced = 0;
};

// What the order says: the same number of faces joined in the same way; their triangles; else what two texts
// have in common, line by line.
Reading read_by_order(const ObjectEdit& edit);

// What the places say: a face of the same shape at the same place is the same face, whatever the order.
Reading read_by_place(const ObjectEdit& edit);

// The faces that have their places and the old order, and what between them the order says.
Reading in_order(const ObjectEdit& edit, const Reading& place);

// [face of now] what it was if the faces that an edit added or removed, in a row of equal ones, were others
// of that row, and all beyond them closed up or made room; `before` where there are none such. `open`: set
// for those of which it is not known whether they are new.
std::vector<std::uint32_t> slid(const ObjectEdit& edit, const std::vector<std::uint32_t>& before,
                                std::vector<bool>& open);

}  // namespace slipface
