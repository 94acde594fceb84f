// Source of the interpolations: glTF 2.0, appendix C.
#include "slipface/mesh/rig.h"

#include <algorithm>
#include <cmath>

#include "slipface/base/pose.h"

namespace slipface {
namespace {

using Quaternion = std::array<float, 4>;

std::size_t numbers_of(const Rig& rig, const RigTrack& track) {
    switch (track.moves) {
        case RigTrack::Moves::rotation: return 4;
        case RigTrack::Moves::weights: return rig.nodes[track.node].weights;
        default: return 3;
    }
}

// The angle whose cosine is `cosine` (0..1), by operations that are exact everywhere: Newton's method.
double angle_of_cosine(double cosine) {
    double angle = std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine));  // the chord
    for (int i = 0; i < 4; ++i) {
        const SinCos at = sin_cos(angle);
        if (at.sine < 1e-9) break;
        angle += (at.cosine - cosine) / at.sine;
    }
    return angle;
}

void normalise(float* quaternion) {
    double length = 0.0;
    for (int i = 0; i < 4; ++i)
        length += static_cast<double>(quaternion[i]) * static_cast<double>(quaternion[i]);
    if (!(length > 0.0)) {
        std::fill(quaternion, quaternion + 3, 0.0F);
        quaternion[3] = 1.0F;
        return;
    }
    const double by = 1.0 / std::sqrt(length);
    for (int i = 0; i < 4; ++i)
        quaternion[i] = static_cast<float>(by * static_cast<double>(quaternion[i]));
}

Affine affine_of(const Vec3f& translation, const Quaternion& q, const Vec3f& scale) {
    const float x = q[0], y = q[1], z = q[2], w = q[3];
    Affine affine;
    affine.col(0) = scale.x() * Vec3f(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y));
    affine.col(1) = scale.y() * Vec3f(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x));
    affine.col(2) = scale.z() * Vec3f(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
    affine.col(3) = translation;
    return affine;
}

Affine product(const Affine& a, const Affine& b) {
    Affine result;
    for (int column = 0; column < 4; ++column)
        result.col(column) = a.col(0) * b(0, column) + a.col(1) * b(1, column) + a.col(2) * b(2, column);
    result.col(3) += a.col(3);
    return result;
}

// The numbers of the track at `at` seconds, into `out`.
void sample(const RigTrack& track, std::size_t count, float at, float* out) {
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), at);
    const std::size_t next = static_cast<std::size_t>(after - track.times.begin());
    const std::size_t key = next == 0 ? 0 : next - 1, last = track.times.size() - 1;
    const bool cubic = track.between == RigTrack::Between::cubic;
    const std::size_t stride = cubic ? 3 * count : count;
    const float* const value = track.values.data() + key * stride + (cubic ? count : 0);
    if (next == 0 || key == last || track.between == RigTrack::Between::step) {
        std::copy(value, value + count, out);
        return;
    }
    const float* const other = value + stride;
    const float span = track.times[next] - track.times[key];
    const float t = (at - track.times[key]) / span;
    if (cubic) {
        const float t2 = t * t, t3 = t2 * t;
        const float* const leave = value + count;
        const float* const arrive = other - count;
        for (std::size_t i = 0; i < count; ++i)
            out[i] = (2 * t3 - 3 * t2 + 1) * value[i] + span * (t3 - 2 * t2 + t) * leave[i] +
                     (3 * t2 - 2 * t3) * other[i] + span * (t3 - t2) * arrive[i];
        if (track.moves == RigTrack::Moves::rotation) normalise(out);
        return;
    }
    float from = 1 - t, to = t;
    if (track.moves == RigTrack::Moves::rotation && track.arcs[key].angle > 1e-3) {
        const RigTrack::Arc& whole = track.arcs[key];
        const SinCos part = sin_cos(whole.angle * static_cast<double>(t));
        from = static_cast<float>((whole.sine * part.cosine - whole.cosine * part.sine) / whole.sine);
        to = static_cast<float>(part.sine / whole.sine);
    }
    for (std::size_t i = 0; i < count; ++i)
        out[i] = from * value[i] + to * other[i];
}

// A clip repeats; one without a length stays at its begin.
float time_in(const Clip& clip, double seconds) {
    const double length = static_cast<double>(clip.seconds);
    if (!(length > 0.0) || !std::isfinite(seconds)) return 0.0F;
    const double rest = seconds - length * std::floor(seconds / length);
    return static_cast<float>(std::clamp(rest, 0.0, length));
}

}  // namespace

void prepare_rig(Rig& rig) {
    for (Clip& clip : rig.clips) {
        for (RigTrack& track : clip.tracks) {
            if (track.moves != RigTrack::Moves::rotation || track.between == RigTrack::Between::cubic)
                continue;
            track.arcs.assign(track.times.size(), {});
            for (std::size_t i = 0; i < track.times.size(); ++i)
                normalise(&track.values[4 * i]);
            for (std::size_t i = 1; i < track.times.size(); ++i) {
                const float* const before = &track.values[4 * (i - 1)];
                float* const value = &track.values[4 * i];
                double cosine = 0.0;
                for (int k = 0; k < 4; ++k)
                    cosine += static_cast<double>(before[k]) * static_cast<double>(value[k]);
                // Both signs mean one rotation; the shorter way is taken.
                if (cosine < 0.0)
                    for (int k = 0; k < 4; ++k)
                        value[k] = -value[k];
                const double angle = angle_of_cosine(std::min(std::abs(cosine), 1.0));
                const SinCos whole = sin_cos(angle);
                track.arcs[i - 1] = {angle, whole.sine, whole.cosine};
            }
        }
    }
}

std::uint32_t find_clip(const Rig& rig, std::string_view name) {
    for (std::size_t i = 0; i < rig.clips.size(); ++i)
        if (name.empty() || rig.clips[i].name == name) return static_cast<std::uint32_t>(i);
    return no_id;
}

void pose_rig(const Rig& rig, std::size_t clip, double seconds, RigPose& pose) {
    pose.weights = rig.weights;
    pose.nodes.resize(rig.nodes.size());
    for (std::size_t i = 0; i < rig.nodes.size(); ++i)
        pose.nodes[i] = rig.nodes[i].local;
    if (clip < rig.clips.size()) {
        const float at = time_in(rig.clips[clip], seconds);
        const std::vector<RigTrack>& tracks = rig.clips[clip].tracks;
        // Those of one node follow each other.
        for (std::size_t i = 0; i < tracks.size();) {
            const RigNode& node = rig.nodes[tracks[i].node];
            Vec3f translation = node.translation, scale = node.scale;
            Quaternion rotation = node.rotation;
            bool moves = false;
            const std::uint32_t number = tracks[i].node;
            for (; i < tracks.size() && tracks[i].node == number; ++i) {
                const RigTrack& track = tracks[i];
                float* const out = track.moves == RigTrack::Moves::translation ? translation.data()
                                   : track.moves == RigTrack::Moves::rotation  ? rotation.data()
                                   : track.moves == RigTrack::Moves::scale
                                       ? scale.data()
                                       : pose.weights.data() + node.first_weight;
                sample(track, numbers_of(rig, track), at, out);
                moves = moves || track.moves != RigTrack::Moves::weights;
            }
            if (moves) pose.nodes[number] = affine_of(translation, rotation, scale);
        }
    }
    for (std::size_t i = 0; i < rig.nodes.size(); ++i)
        if (rig.nodes[i].parent != no_id)
            pose.nodes[i] = product(pose.nodes[rig.nodes[i].parent], pose.nodes[i]);
    pose.bones.resize(rig.bones.size());
    for (std::size_t i = 0; i < rig.bones.size(); ++i)
        pose.bones[i] =
            product(rig.level_from_file, product(pose.nodes[rig.bones[i].node], rig.bones[i].bind));
}

Vec3f posed_position(const Rig& rig, const RigPose& pose, std::uint32_t corner) {
    Vec3f own = rig.corner_position[corner];
    if (!rig.corner_first_delta.empty())
        for (std::uint32_t i = rig.corner_first_delta[corner]; i < rig.corner_first_delta[corner + 1]; ++i)
            own += pose.weights[rig.deltas[i].weight] * rig.deltas[i].delta;
    Vec3f position = Vec3f::Zero();
    for (std::size_t i = 0; i < Rig::bones_per_corner; ++i) {
        const float weight = rig.corner_weights[corner][i];
        if (weight > 0.0F) position += weight * apply(pose.bones[rig.corner_bones[corner][i]], own);
    }
    return position;
}

}  // namespace slipface
