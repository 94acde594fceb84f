// Parts of a mesh with painted faces, and how each of them moved when another program changed the mesh.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "face_outline.h"
#include "face_tokens.h"
#include "slipface/level/level.h"

namespace slipface {

struct FaceLookup;
struct StoredOverride;

// A face at a part's rim; it shows where the part is.
using AnchorFace = std::vector<Vec3f>;  // corners

// A connected piece of a group, or all small pieces of a group together.
struct PaintPart {
    std::uint32_t faces = 0;   // painted or not
    std::uint32_t object = 0;  // object_name() of its group; 0: not known
    Aabb box;
    std::vector<AnchorFace> anchors;  // none if no face is painted
    // [corner of the anchors] the number of its vertex in the geometry's file, from that of the object's
    // first one; none: not known
    std::vector<std::uint32_t> numbers;
};

inline constexpr std::size_t max_paint_parts = 4096;  // of a level

// 1 to 2^24 - 1, of a hash of the name.
std::uint32_t object_name(std::string_view name);

// Unpainted faces that lie on painted ones (unpainted_faces_on()).
struct UnpaintedFaces {
    std::vector<FaceKey> keys;
    std::vector<std::uint16_t> of;  // [key] as PaintParts::of; if its part is not painted, that of the paint
    FaceOutlines outlines;          // [key]
    std::vector<std::uint32_t> token;  // [key] index into PaintParts::tokens; or empty
};

struct PaintParts {
    Aabb bounds;  // of the whole mesh
    std::vector<PaintPart> parts;
    std::vector<std::uint16_t> of;     // [painted face] 1 + its part; 0: none
    FaceOutlines outlines;             // [painted face]; none in an older level file
    std::vector<bool> guessed;         // [painted face] its type was a guess before; or empty
    UnpaintedFaces unpainted;          // none in an older level file
    MeshTokens tokens;                 // of the whole mesh; none in an older level file
    std::vector<std::uint32_t> token;  // [painted face] its token; or empty
};

// All parts, the ones with most faces of `faces` first. `keys`: of these faces.
PaintParts paint_parts(const Mesh& mesh, SurfaceTable surfaces, const std::vector<FaceId>& faces,
                       const std::vector<FaceKey>& keys);

// A part in base64, and back; false if `text` is none.
std::string pack_part(const PaintPart& part);
bool unpack_part(std::string_view text, PaintPart& part);

// The numbers of a part's vertices, and back. `list`: the text of pack_part(); numbers that were packed for
// another one are left out. False if `text` is none.
std::string pack_numbers(const PaintPart& part, std::string_view list);
bool unpack_numbers(std::string_view text, std::string_view list, PaintPart& part);

// Where a part went: position p became linear * p + offset.
struct PartMotion {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Vec3 offset = Vec3::Zero();
    bool flipped = false;  // the faces look the other way
    // `lost`: nothing of the part is where it was, and no motion explains the new mesh. A face that looks
    // like one of its faces is another one.
    bool lost = false;
    // Another motion, or staying, explains the mesh nearly as well and gives faces other types, or this one
    // explains little of it. What it finds is a question to the user, even if it looks exact.
    bool guessed = false;
    // How far at most its anchors' corners are from vertices of the mesh: what the rounding of the mesh's
    // file left. Infinite if that is not known.
    double rest = std::numeric_limits<double>::infinity();

    bool is_identity() const { return linear.isIdentity(0.0) && offset.isZero(0.0) && !flipped; }
    Vec3 operator()(const Vec3& position) const { return linear * position + offset; }
};

struct PartMotions {
    std::vector<PartMotion> first;   // [part]
    std::vector<PartMotion> second;  // of another reading that explains the mesh as well; none: there is none
    // object_name() of those in which a part seems to have stayed, in its order, though a motion that another
    // part must have made puts it onto itself: its order proves nothing.
    std::set<std::uint32_t> unclear_objects;
};

// [part] the motion that the vertices prove: those that its anchors had are all elsewhere, or in their
// places, as after one motion. Nothing where they say nothing, or no more than the order of the faces says.
using VertexMotions = std::vector<std::optional<PartMotion>>;
VertexMotions motions_of_vertices(const Mesh& mesh, const PaintParts& parts);

// [part] the motion that puts the most anchors and painted faces (`stored`) onto the mesh's. A part stays
// where it is unless another motion explains clearly more. The work is bounded.
PartMotions find_motions(FaceLookup& lookup, SurfaceTable surfaces, const PaintParts& parts,
                         const std::vector<StoredOverride>& stored, const VertexMotions& of_vertices);

// `key` after the motion. The loop hash, which cannot be moved, becomes 0.
FaceKey moved_key(const FaceKey& key, const PartMotion& motion);

}  // namespace slipface
