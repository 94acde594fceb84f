// Finding faces: connected regions and neighbourhoods.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "document/document.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

FaceFacts face_facts(const Mesh& mesh);

// Whether two directions differ by at most an angle (radians), without a trigonometric function for each
// pair. Unit vectors or zero.
class AngleLimit {
  public:
    explicit AngleLimit(double max_angle);
    bool operator()(const Vec3f& a, const Vec3f& b) const { return surely(a, b) || exactly(a, b); }
    // Only for some pairs of vectors with a length, but at little cost.
    bool surely(const Vec3f& a, const Vec3f& b) const { return a.dot(b) > certain_; }

  private:
    bool exactly(const Vec3f& a, const Vec3f& b) const {
        const Vec3 u = a.cast<double>(), v = b.cast<double>();
        // |u x v|^2 against sin^2 |u|^2 |v|^2 stays precise for small angles, where the cosine is flat.
        const double along = u.dot(v), across2 = u.cross(v).squaredNorm();
        const double limit2 = sine2_ * (across2 + along * along);
        if (none_) return false;
        return acute_ ? along > 0.0 && across2 <= limit2 : along >= 0.0 || across2 >= limit2;
    }

    bool acute_, none_;
    double sine2_;
    float certain_;  // a cosine from which on rounding cannot matter
};

// The faces whose mark is not 0, ascending.
std::vector<FaceId> marked_faces(std::span<const std::uint8_t> marks);

// The faces that are reachable from `start` across shared edges, ascending, `start` included. A path carries
// a face along, at its begin the first one: beyond(carried, from, next) gives the face that it carries at
// `next`, or no_id if it does not go there. Nearer faces come first. `costly`: beyond() takes longer than the
// branch that spares it for faces which were reached before. Nothing if more than `most` faces are reached.
template <bool costly = false, class Beyond>
std::optional<std::vector<FaceId>> flood_up_to(std::size_t most, const FaceNeighbours& neighbours,
                                               std::size_t face_count, std::span<const FaceId> start,
                                               const Beyond& beyond) {
    struct Open {
        FaceId face, carried;
    };
    std::vector<std::uint8_t> reached(face_count, 0);
    std::vector<Open> border, next_border;
    for (const FaceId face : start) {
        if (face >= face_count || reached[face] != 0) continue;
        reached[face] = 1;
        border.push_back({face, face});
    }
    const std::uint32_t* first = neighbours.first.data();
    const FaceId* list = neighbours.list.data();
    std::size_t next_size = 0, total = 0;
    for (std::size_t size = border.size(); size > 0; size = std::exchange(next_size, 0)) {
        total += size;
        if (total > most) return std::nullopt;
        // A border's faces lie far from each other in memory, which is asked for in time.
        constexpr std::size_t ahead = 12;
        border.resize(std::max(border.size(), size + 2 * ahead));
        for (std::size_t i = 0; i < size; ++i) {
            __builtin_prefetch(first + border[i + 2 * ahead].face);
            __builtin_prefetch(list + first[border[i + ahead].face]);
            const Open from = border[i];
            const std::uint32_t begin = first[from.face], end = first[from.face + 1];
            if (next_border.size() < next_size + (end - begin))
                next_border.resize(2 * (next_size + (end - begin)));
            for (std::uint32_t link = begin; link < end; ++link) {
                const FaceId next = list[link];
                if (costly && reached[next] != 0) continue;
                // Without a branch: whether a face was reached before cannot be predicted.
                const FaceId carried = beyond(from.carried, from.face, next);
                const auto is_new = static_cast<std::uint8_t>((carried != no_id) & (reached[next] == 0));
                reached[next] |= is_new;
                next_border[next_size] = {next, carried};
                next_size += is_new;
            }
        }
        std::swap(border, next_border);
    }
    return marked_faces(reached);
}

template <bool costly = false, class Beyond>
std::vector<FaceId> flood(const FaceNeighbours& neighbours, std::size_t face_count,
                          std::span<const FaceId> start, const Beyond& beyond) {
    return *flood_up_to<costly>(face_count, neighbours, face_count, start, beyond);
}

// The same where joined(a, b) alone decides whether a path goes from a to b, and as well from b to a. A flood
// over much of the level waits for memory at its long border. So beyond a sixteenth of the faces all are
// grouped by what is joined, in the order of memory, which takes a third of the time.
template <class Joined>
std::vector<FaceId> flood_joined(const FaceNeighbours& neighbours, std::size_t face_count,
                                 std::span<const FaceId> start, const Joined& joined) {
    const auto beyond = [&](FaceId, FaceId from, FaceId next) { return joined(from, next) ? next : no_id; };
    if (auto near = flood_up_to(face_count / 16, neighbours, face_count, start, beyond))
        return *std::move(near);
    // Each face names one of its group that is not higher; a group's lowest names itself.
    std::vector<FaceId> lower(face_count);
    const auto lowest = [&](FaceId face) {
        while (lower[face] != face)
            face = lower[face] = lower[lower[face]];
        return face;
    };
    for (FaceId face = 0; face < face_count; ++face) {
        FaceId own = lower[face] = face;
        for (const FaceId next : neighbours.of(face)) {
            if (next >= face) break;
            if (!joined(face, next)) continue;
            const FaceId other = lowest(next);
            lower[std::max(own, other)] = std::min(own, other);
            own = std::min(own, other);
        }
    }
    std::vector<std::uint8_t> reached(face_count, 0);
    for (const FaceId face : start)
        if (face < face_count) reached[lowest(face)] = 1;
    // The result takes the place of what was read already.
    std::size_t done = 0;
    for (FaceId face = 0; face < face_count; ++face) {
        reached[face] = reached[lower[face]];
        lower[done] = face;
        done += reached[face];
    }
    lower.resize(done);
    return lower;
}

// The faces reachable from `start` across shared edges whose two normals differ by at most `max_angle`
// (radians). Ascending, `start` included. Faces without area are always crossed.
std::vector<FaceId> flood_by_angle(const FaceFacts& facts, const FaceNeighbours& neighbours,
                                   std::span<const FaceId> start, double max_angle);

// What a brush of that size paints: the faces connected with `start` that have a corner or an inner point
// within `radius` of `centre`; the faces between must have one, too. A radius of 0 gives `start` alone.
std::vector<FaceId> brush_faces(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                const Vec3& centre, double radius);

// The same in a level; each prop is a part of its own.
std::vector<FaceId> flood_by_angle(const Document& document, FaceId start, double max_angle);
std::vector<FaceId> brush_faces(const Document& document, FaceId start, const Vec3& centre, double radius);

// The bounding box of `faces`.
Aabb faces_bounds(const Document& document, std::span<const FaceId> faces);

// That of all faces that are not hidden, or of all if all are.
Aabb shown_bounds(const Document& document);

}  // namespace slipface
