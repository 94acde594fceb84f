// Source: the public Quake III source, qcommon/qfiles.h (lumps and records of a BSP of version 46).
#include "import_bsp.h"

#include <bit>
#include <cmath>

#include "obj_text.h"

namespace slipface {
namespace {

constexpr std::size_t header_size = 144;
constexpr float largest_map_coordinate = 1e7F;
constexpr int patch_steps = 4;  // quads along each side of a 3 x 3 patch of control points
constexpr std::size_t most_corners = std::size_t{1} << 27;

std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

float f32_at(std::string_view bytes, std::size_t at) {
    return std::bit_cast<float>(u32_at(bytes, at));
}

// Records of one kind.
struct Lump {
    std::string_view bytes;
    std::size_t record = 1;
    std::size_t count() const { return bytes.size() / record; }
    std::string_view at(std::size_t i) const { return bytes.substr(i * record, record); }
};

struct Point {
    Vec3f position = Vec3f::Zero();
    Vec2f uv = Vec2f::Zero();
};

Point mix(const Point& a, const Point& b, const Point& c, float t) {
    const float wa = (1 - t) * (1 - t), wb = 2 * t * (1 - t), wc = t * t;
    return {wa * a.position + wb * b.position + wc * c.position, wa * a.uv + wb * b.uv + wc * c.uv};
}

class BspReader {
  public:
    BspReader(std::string_view bytes, const std::string& place, WarningList& warnings)
        : bytes_(bytes), place_(place), warnings_(warnings) {}

    Result<PolygonSoup> run() {
        if (bytes_.size() < header_size || !bytes_.starts_with("IBSP") || u32_at(bytes_, 4) != 46)
            return Error{place_, "is no Quake 3 map; expected IBSP of version 46"};
        Lump faces;
        for (auto [lump, number, record] : {std::tuple(&textures_, 1, 72), std::tuple(&vertices_, 10, 44),
                                            std::tuple(&indices_, 11, 4), std::tuple(&faces, 13, 104)}) {
            if (auto status = find(*lump, static_cast<std::size_t>(number), static_cast<std::size_t>(record));
                !status)
                return status.error();
        }
        add_materials();
        soup_.face_first_corner.push_back(0);
        for (std::size_t i = 0; i < faces.count(); ++i)
            if (auto status = add_face(i, faces.at(i)); !status) return status.error();
        if (dropped_ > 0)
            warnings_.add(place_,
                          fmt::format("{} flares and faces without area are no surface: dropped", dropped_));
        if (soup_.face_material.empty()) return Error{place_, "has no faces"};
        return std::move(soup_);
    }

  private:
    Status find(Lump& lump, std::size_t number, std::size_t record) {
        const std::size_t begin = u32_at(bytes_, 8 + 8 * number);
        const std::size_t size = u32_at(bytes_, 12 + 8 * number);
        if (begin > bytes_.size() || size > bytes_.size() - begin || size % record != 0)
            return Error{place_, fmt::format("lump {} of {} bytes at {} does not fit into the file of {}",
                                             number, size, begin, bytes_.size())};
        lump = {bytes_.substr(begin, size), record};
        return {};
    }

    void add_materials() {
        for (std::size_t i = 0; i < textures_.count(); ++i) {
            const std::string_view name = textures_.at(i).substr(0, 64);
            bool converted = false;
            Material material;
            material.name = utf8_name(name.substr(0, name.find('\0')), converted);
            soup_.materials.push_back(std::move(material));
        }
    }

    Status add_face(std::size_t number, std::string_view face) {
        const std::uint32_t texture = u32_at(face, 0);
        const std::uint32_t kind = u32_at(face, 8);
        const Range points{u32_at(face, 12), u32_at(face, 16)};
        const Range corners{u32_at(face, 20), u32_at(face, 24)};
        if (texture >= textures_.count() || !points.within(vertices_.count()) ||
            !corners.within(indices_.count()))
            return Error{
                place_, fmt::format("face {} has a texture, vertices or indices that are not there", number)};
        material_ = texture;
        if (kind == 1 && points.count >= 3) return add_polygon(points);
        if (kind == 3) return add_triangles(number, points, corners);
        if (kind == 2) return add_patch(number, points, u32_at(face, 96), u32_at(face, 100));
        ++dropped_;
        return {};
    }

    struct Range {
        std::size_t first, count;
        bool within(std::size_t size) const { return first <= size && count <= size - first; }
    };

    // Quake winds the other way round.
    Status add_polygon(const Range& points) {
        for (std::size_t i = points.count; i-- > 0;)
            if (auto status = add_corner(point(points.first + i)); !status) return status;
        return end_face();
    }

    Status add_triangles(std::size_t number, const Range& points, const Range& corners) {
        for (std::size_t i = 0; i + 2 < corners.count; i += 3) {
            for (std::size_t k = 3; k-- > 0;) {
                const std::size_t index = u32_at(indices_.at(corners.first + i + k), 0);
                if (index >= points.count)
                    return Error{place_, fmt::format("face {} has index {} of {} vertices", number, index,
                                                     points.count)};
                if (auto status = add_corner(point(points.first + index)); !status) return status;
            }
            if (auto status = end_face(); !status) return status;
        }
        return {};
    }

    // Biquadratic Bezier patches of 3 x 3 control points that share their borders.
    Status add_patch(std::size_t number, const Range& points, std::size_t width, std::size_t height) {
        if (width < 3 || height < 3 || width % 2 == 0 || height % 2 == 0 || width > points.count ||
            height > points.count || width * height > points.count)
            return Error{place_, fmt::format("face {} is a patch of {} x {} for {} vertices", number, width,
                                             height, points.count)};
        for (std::size_t y = 0; y + 2 < height; y += 2)
            for (std::size_t x = 0; x + 2 < width; x += 2)
                if (auto status = add_square(points.first + y * width + x, width); !status) return status;
        return {};
    }

    Status add_square(std::size_t first, std::size_t width) {
        Point grid[patch_steps + 1][patch_steps + 1];
        for (int v = 0; v <= patch_steps; ++v) {
            Point column[3];
            for (std::size_t x = 0; x < 3; ++x)
                column[x] = mix(point(first + x), point(first + width + x), point(first + 2 * width + x),
                                static_cast<float>(v) / patch_steps);
            for (int u = 0; u <= patch_steps; ++u)
                grid[v][u] = mix(column[0], column[1], column[2], static_cast<float>(u) / patch_steps);
        }
        for (int v = 0; v < patch_steps; ++v) {
            for (int u = 0; u < patch_steps; ++u) {
                for (const Point& corner : {grid[v][u], grid[v][u + 1], grid[v + 1][u + 1], grid[v + 1][u]})
                    if (auto status = add_corner(corner); !status) return status;
                if (auto status = end_face(); !status) return status;
            }
        }
        return {};
    }

    Point point(std::size_t i) const {
        const std::string_view record = vertices_.at(i);
        Point result;
        result.position = Vec3f(f32_at(record, 0), f32_at(record, 4), f32_at(record, 8));
        result.uv = Vec2f(f32_at(record, 12), 1 - f32_at(record, 16));
        if (!result.uv.allFinite()) result.uv.setZero();
        return result;
    }

    Status add_corner(const Point& corner) {
        if (!(corner.position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_map_coordinate))
            return Error{
                place_, fmt::format("a vertex is not within {} units of the origin", largest_map_coordinate)};
        if (soup_.corner_position.size() >= most_corners) return Error{place_, "has too many faces"};
        soup_.corner_position.push_back(corner.position);
        soup_.corner_uv.push_back(corner.uv);
        return {};
    }

    // What has no three different corners is taken back.
    Status end_face() {
        const std::size_t first = soup_.face_first_corner.back();
        const Vec3f& a = soup_.corner_position[first];
        std::size_t second = first;
        bool surface = false;
        for (std::size_t i = first; i < soup_.corner_position.size() && !surface; ++i) {
            const Vec3f& p = soup_.corner_position[i];
            if (p == a || p == soup_.corner_position[second]) continue;
            surface = second != first;
            second = i;
        }
        if (!surface) {
            ++dropped_;
            soup_.corner_position.resize(first);
            soup_.corner_uv.resize(first);
            return {};
        }
        soup_.face_first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_position.size()));
        soup_.face_material.push_back(static_cast<std::uint32_t>(material_));
        return {};
    }

    const std::string_view bytes_;
    const std::string& place_;
    WarningList& warnings_;
    Lump textures_, vertices_, indices_;
    PolygonSoup soup_;
    std::size_t material_ = 0;
    std::size_t dropped_ = 0;
};

}  // namespace

Result<PolygonSoup> import_bsp(std::string_view bytes, const std::string& place, WarningList& warnings) {
    return BspReader(bytes, place, warnings).run();
}

}  // namespace slipface
