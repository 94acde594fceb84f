#include "document/selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "document/faces.h"

namespace slipface {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// Faces that were modelled flat deviate by up to about this angle in float coordinates, radians.
constexpr double flat_angle = 2e-4;
constexpr double like_angle = 2.0 * degree;
constexpr double like_area = 0.05;  // fraction

// Faces for which keep(face) holds.
template <class Keep>
std::vector<FaceId> faces_where(const Document& document, const Keep& keep) {
    std::vector<FaceId> faces;
    for (FaceId face = 0; face < document.face_count(); ++face)
        if (keep(face)) faces.push_back(face);
    return faces;
}

// One flag per face, set for `faces`.
std::vector<std::uint8_t> marks(const Document& document, std::span<const FaceId> faces) {
    std::vector<std::uint8_t> marked(document.face_count(), 0);
    for (const FaceId face : faces)
        if (face < marked.size()) marked[face] = 1;
    return marked;
}

// True if all corners of `face` lie in the plane through the first corner of `origin`, within float
// precision.
bool in_plane_of(const Document& document, FaceId face, FaceId origin) {
    const Mesh& mesh = document.mesh();
    const Vec3 normal = document.facts().normal[origin].cast<double>();
    if (normal.isZero(0.0)) return false;
    const Vec3 position = mesh.corner_position(mesh.face_first_corner[origin]).cast<double>();
    const double reach =
        std::max(mesh.bounds.min.cwiseAbs().maxCoeff(), mesh.bounds.max.cwiseAbs().maxCoeff());
    for (std::uint32_t corner = mesh.face_first_corner[face]; corner < mesh.face_first_corner[face + 1];
         ++corner) {
        const Vec3 offset = mesh.corner_position(corner).cast<double>() - position;
        if (std::abs(normal.dot(offset)) > 1e-6 * reach + flat_angle * offset.norm()) return false;
    }
    return true;
}

}  // namespace

std::vector<FaceId> connected_flat(const Document& document, std::span<const FaceId> start) {
    const std::vector<Vec3f>& normal = document.facts().normal;
    const AngleLimit parallel(5.0 * flat_angle);
    return flood<true>(document.neighbours(), normal.size(), start, [&](FaceId origin, FaceId, FaceId next) {
        const bool flat = (normal[next].isZero(0.0f) || parallel(normal[origin], normal[next])) &&
                          in_plane_of(document, next, origin);
        return flat ? origin : no_id;
    });
}

std::vector<FaceId> connected_by_angle(const Document& document, std::span<const FaceId> start,
                                       double max_angle) {
    return flood_by_angle(document.facts(), document.neighbours(), start, max_angle);
}

namespace {

// Connected faces with the same value[face].
template <class T>
std::vector<FaceId> connected_alike(const Document& document, std::span<const FaceId> start,
                                    const std::vector<T>& value) {
    return flood_joined(document.neighbours(), value.size(), start,
                        [&](FaceId a, FaceId b) { return value[a] == value[b]; });
}

}  // namespace

std::vector<FaceId> connected_within_material(const Document& document, std::span<const FaceId> start) {
    return connected_alike(document, start, document.mesh().face_material);
}

std::vector<FaceId> connected_within_type(const Document& document, std::span<const FaceId> start) {
    return connected_alike(document, start, document.resolved().surface);
}

std::vector<FaceId> grown(const Document& document, std::span<const FaceId> faces) {
    std::vector<std::uint8_t> kept = marks(document, faces);
    for (const FaceId face : faces)
        if (face < kept.size())
            for (const FaceId next : document.neighbours().of(face))
                kept[next] = 1;
    return marked_faces(kept);
}

std::vector<FaceId> shrunk(const Document& document, std::span<const FaceId> faces) {
    const std::vector<std::uint8_t> kept = marks(document, faces);
    return faces_where(document, [&](FaceId face) {
        if (kept[face] == 0) return false;
        const auto next = document.neighbours().of(face);
        return std::all_of(next.begin(), next.end(), [&](FaceId other) { return kept[other] != 0; });
    });
}

std::vector<FaceId> inverted(const Document& document, std::span<const FaceId> faces) {
    std::vector<std::uint8_t> kept = marks(document, faces);
    for (std::uint8_t& mark : kept)
        mark = mark == 0 ? 1 : 0;
    return marked_faces(kept);
}

std::vector<FaceId> every_face(const Document& document) {
    std::vector<FaceId> faces(document.face_count());
    std::iota(faces.begin(), faces.end(), FaceId{0});
    return faces;
}

double slope_limit_cosine(const Document& document, SurfaceId surface) {
    const std::vector<SurfaceType>& surfaces = document.level().surfaces;
    const std::optional<double> own = surface < surfaces.size() ? surfaces[surface].max_slope : std::nullopt;
    return std::cos(own.value_or(document.level().movement.max_slope));
}

SlopeClass slope_class(const Document& document, FaceId face) {
    const Vec3f& normal = document.facts().normal[face];
    if (normal.isZero(0.0f)) return SlopeClass::none;
    constexpr float flat = 1e-6f;  // of a float normal
    const double up = static_cast<double>(normal.y());
    if (up + static_cast<double>(flat) >= slope_limit_cosine(document, document.surface_of(face)))
        return SlopeClass::walkable;
    return normal.y() >= -flat ? SlopeClass::steep : SlopeClass::overhang;
}

const SlopeCounts& slope_counts(const Document& document) {
    static SlopeCounts counts;
    static std::uint64_t faces_seen = 0;
    static double limit = 0.0;
    const double limit_now = document.level().movement.max_slope;
    if (faces_seen == document.face_revision() && limit == limit_now) return counts;
    faces_seen = document.face_revision();
    limit = limit_now;
    counts = {};
    for (FaceId face = 0; face < document.face_count(); ++face) {
        const auto slope = static_cast<std::size_t>(slope_class(document, face));
        ++counts.faces[slope];
        counts.area[slope] += static_cast<double>(document.facts().area[face]);
    }
    return counts;
}

std::vector<FaceId> faces_with_slope(const Document& document, SlopeClass slope) {
    return faces_where(document, [&](FaceId face) { return slope_class(document, face) == slope; });
}

namespace {

template <class ValueOf>
std::vector<FaceId> with_values(const Document& document, std::span<const FaceId> samples,
                                const ValueOf& value) {
    std::vector<std::size_t> wanted;
    for (const FaceId face : samples)
        wanted.push_back(value(face));
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    return faces_where(
        document, [&](FaceId face) { return std::binary_search(wanted.begin(), wanted.end(), value(face)); });
}

// Directions sorted into cubes a little larger than the tolerance, so that a query looks at 27 cubes only.
class Directions {
  public:
    explicit Directions(double angle) : alike_(angle), side_(1.1f * static_cast<float>(angle)) {}
    void add(const Vec3f& direction) { entries_.push_back({cube(direction), direction}); }
    void finish() {
        std::sort(entries_.begin(), entries_.end(), before);
        const auto same = [](const Entry& a, const Entry& b) { return a.direction == b.direction; };
        entries_.erase(std::unique(entries_.begin(), entries_.end(), same), entries_.end());
    }
    bool near(const Vec3f& direction) const {
        const Cube middle = cube(direction);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                if (near_in({middle[0] + x, middle[1] + y, middle[2] - 1}, middle[2] + 1, direction))
                    return true;
        return false;
    }

  private:
    using Cube = std::array<int, 3>;
    struct Entry {
        Cube cube;
        Vec3f direction;
    };
    static bool before(const Entry& a, const Entry& b) {
        if (a.cube != b.cube) return a.cube < b.cube;
        return std::lexicographical_compare(a.direction.begin(), a.direction.end(), b.direction.begin(),
                                            b.direction.end());
    }
    Cube cube(const Vec3f& direction) const {
        Cube result;
        for (int i = 0; i < 3; ++i)
            result[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(direction[i] / side_));
        return result;
    }
    // In the cubes from `first` to the one with this last coordinate.
    bool near_in(const Cube& first, int last, const Vec3f& direction) const {
        auto entry = std::lower_bound(entries_.begin(), entries_.end(), first,
                                      [](const Entry& a, const Cube& b) { return a.cube < b; });
        for (; entry != entries_.end() && entry->cube[0] == first[0] && entry->cube[1] == first[1] &&
               entry->cube[2] <= last;
             ++entry)
            if (alike_(entry->direction, direction)) return true;
        return false;
    }

    AngleLimit alike_;
    float side_;
    std::vector<Entry> entries_;
};

std::vector<FaceId> with_normals(const Document& document, std::span<const FaceId> samples) {
    const std::vector<Vec3f>& normal = document.facts().normal;
    Directions wanted(like_angle);
    for (const FaceId face : samples)
        if (!normal[face].isZero(0.0f)) wanted.add(normal[face]);
    wanted.finish();
    return faces_where(document,
                       [&](FaceId face) { return !normal[face].isZero(0.0f) && wanted.near(normal[face]); });
}

std::vector<FaceId> with_areas(const Document& document, std::span<const FaceId> samples) {
    const std::vector<float>& area = document.facts().area;
    std::vector<double> wanted;
    for (const FaceId face : samples)
        wanted.push_back(static_cast<double>(area[face]));
    std::sort(wanted.begin(), wanted.end());
    return faces_where(document, [&](FaceId face) {
        const double own = static_cast<double>(area[face]);
        const auto near = std::lower_bound(wanted.begin(), wanted.end(), own / (1.0 + like_area));
        return near != wanted.end() && *near <= own * (1.0 + like_area);
    });
}

}  // namespace

std::vector<FaceId> similar_faces(const Document& document, std::span<const FaceId> samples,
                                  Likeness likeness) {
    const Mesh& mesh = document.mesh();
    std::vector<FaceId> known(samples.begin(), samples.end());
    std::erase_if(known, [&](FaceId face) { return face >= mesh.face_count(); });
    const auto by = [&](const auto& value) { return with_values(document, known, value); };
    switch (likeness) {
        case Likeness::material:
            return by([&](FaceId face) -> std::size_t { return mesh.face_material[face]; });
        case Likeness::group: return by([&](FaceId face) -> std::size_t { return mesh.face_group[face]; });
        case Likeness::type: return by([&](FaceId face) -> std::size_t { return document.surface_of(face); });
        case Likeness::slope:
            return by([&](FaceId face) { return static_cast<std::size_t>(slope_class(document, face)); });
        case Likeness::normal: return with_normals(document, known);
        case Likeness::area: return with_areas(document, known);
    }
    return {};
}

std::vector<FaceId> faces_of_type(const Document& document, SurfaceId surface) {
    return faces_where(document, [&](FaceId face) { return document.surface_of(face) == surface; });
}

std::vector<FaceId> painted_faces(const Document& document) {
    return faces_where(document, [&](FaceId face) { return document.paint_of(face).has_value(); });
}

std::vector<FaceId> unpainted_faces(const Document& document) {
    return faces_where(document, [&](FaceId face) { return !document.paint_of(face).has_value(); });
}

std::vector<FaceId> faces_steeper_than_limit(const Document& document) {
    return faces_where(document, [&](FaceId face) {
        const SlopeClass slope = slope_class(document, face);
        return slope == SlopeClass::steep || slope == SlopeClass::overhang;
    });
}

std::vector<FaceId> united(std::span<const FaceId> a, std::span<const FaceId> b) {
    std::vector<FaceId> faces;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(faces));
    return faces;
}

std::vector<FaceId> without(std::span<const FaceId> a, std::span<const FaceId> b) {
    std::vector<FaceId> faces;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(faces));
    return faces;
}

}  // namespace slipface
