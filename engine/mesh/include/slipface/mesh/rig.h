// How a mesh moves: the clips of its file, the nodes that they move, and what each corner of the mesh
// follows.
//
//   RigPose pose;
//   pose_rig(*mesh->rig, 0, seconds, pose);                       // the first clip
//   Vec3f where = posed_position(*mesh->rig, pose, corner);
//
// A mesh is read once and drawn many times, so a clip, its speed and its phase belong to what is drawn (a
// prop, an entity), never to the mesh. Collision knows the mesh at rest alone.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

using Affine = Eigen::Matrix<float, 3, 4>;  // moved = left three columns * point + last column

inline Vec3f apply(const Affine& affine, const Vec3f& point) {
    return affine.leftCols<3>() * point + affine.col(3);
}

// A node of the file, in its parent's space.
struct RigNode {
    std::uint32_t parent = no_id;                 // a node before this one
    std::uint32_t first_weight = 0, weights = 0;  // its morph targets, in Rig::weights
    Vec3f translation = Vec3f::Zero();            // at rest
    std::array<float, 4> rotation{0, 0, 0, 1};    // unit quaternion x, y, z, w
    Vec3f scale = Vec3f::Ones();
    Affine local = Affine::Identity();  // at rest: of these three, or of the file's matrix
};

// One property of a node over time.
struct RigTrack {
    enum class Moves : std::uint8_t { translation, rotation, scale, weights };
    enum class Between : std::uint8_t { step, linear, cubic };  // cubic: Hermite
    std::uint32_t node = 0;
    Moves moves = Moves::translation;
    Between between = Between::linear;
    std::vector<float> times;  // ascending, seconds; at least one
    // For each time 3 numbers, 4 (rotation) or one per weight; cubic: in-tangent, value, out-tangent.
    std::vector<float> values;
    struct Arc {
        double angle = 0.0, sine = 0.0, cosine = 1.0;
    };
    std::vector<Arc> arcs;  // [time] of a linear rotation: to the next one; by prepare_rig()
};

struct Clip {
    std::string name;
    float seconds = 0.0F;  // after which it begins again
    std::vector<RigTrack> tracks;
};

// Corners follow bones: a corner is moved into the space of the node, and then with the node.
struct RigBone {
    std::uint32_t node = 0;
    Affine bind = Affine::Identity();
};

struct MorphDelta {
    std::uint32_t weight = 0;  // in Rig::weights
    Vec3f delta = Vec3f::Zero();
};

struct Rig {
    static constexpr std::size_t bones_per_corner = 4;

    std::vector<RigNode> nodes;          // parents first
    std::vector<Clip> clips;             // at least one
    std::vector<RigBone> bones;          // at most 65536
    std::vector<float> weights;          // of morph targets, at rest
    std::vector<Vec3f> corner_position;  // [corner] before bones
    std::vector<std::array<std::uint16_t, bones_per_corner>> corner_bones;
    std::vector<std::array<float, bones_per_corner>> corner_weights;  // sum 1
    std::vector<std::uint32_t> corner_first_delta;  // [corner + 1] index into deltas; empty: none
    std::vector<MorphDelta> deltas;
    Affine level_from_file = Affine::Identity();  // metres and +Y up
};

// Completes what follows from the rest. Call it once, after a Rig is filled.
void prepare_rig(Rig& rig);

// The clip of that name, or no_id. An empty name: the first one.
std::uint32_t find_clip(const Rig& rig, std::string_view name);

// A rig at one moment. Reuse it: its memory is kept.
struct RigPose {
    std::vector<Affine> bones;   // from corner_position to the level
    std::vector<float> weights;  // of morph targets
    std::vector<Affine> nodes;   // of the file's space
};

// Fills `pose` with `clip` at `seconds` after its begin; the clip repeats. A clip that is not there, such as
// no_id: at rest. A pose of 20 nodes takes about a microsecond.
void pose_rig(const Rig& rig, std::size_t clip, double seconds, RigPose& pose);

Vec3f posed_position(const Rig& rig, const RigPose& pose, std::uint32_t corner);

}  // namespace slipface
