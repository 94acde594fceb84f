// Source: the public Quake III source, qcommon/qfiles.h (kinds of faces), renderer/tr_curve.c (patches).
#include "bsp/bsp_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "obj/obj_text.h"

namespace slipface {
namespace {

constexpr int patch_steps = 4;  // quads along each side of 3 x 3 control points
constexpr std::size_t max_corners = std::size_t{1} << 27;
constexpr std::uint32_t polygon_face = 1, patch_face = 2, mesh_face = 3;
constexpr double flatness = 0.25;  // units; map compilers snap vertices by up to this

struct Point {
    Vec3f position = Vec3f::Zero();
    Vec2f uv = Vec2f::Zero();
};

Point mix(const Point& a, const Point& b, const Point& c, float t) {
    const float wa = (1 - t) * (1 - t), wb = 2 * t * (1 - t), wc = t * t;
    return {wa * a.position + wb * b.position + wc * c.position, wa * a.uv + wb * b.uv + wc * c.uv};
}

class FaceReader {
  public:
    FaceReader(const BspFile& file, const std::vector<Vec3>& origins, const std::string& location)
        : file_(file), origins_(origins), location_(location) {}

    Result<BspFaces> run(WarningList& warnings) {
        add_materials();
        out_.soup.face_first_corner.push_back(0);
        for (std::size_t i = 0; i < file_.faces.count(); ++i)
            if (auto status = add_face(i, file_.faces.at(i)); !status) return status.error();
        if (dropped_ > 0)
            warnings.add(location_, fmt::format("dropped {} flares and faces without area", dropped_));
        return std::move(out_);
    }

  private:
    void add_materials() {
        for (std::size_t i = 0; i < file_.textures.count(); ++i) {
            bool converted = false;
            Material material;
            material.name = utf8_name(file_.texture_name(i), converted);
            out_.soup.materials.push_back(std::move(material));
        }
    }

    Status add_face(std::size_t number, std::string_view face) {
        const std::uint32_t texture = u32_at(face, 0);
        const std::uint32_t kind = u32_at(face, 8);
        const BspRange points = bsp_range_at(face, 12), corners = bsp_range_at(face, 20);
        if (texture >= file_.textures.count() || !points.within(file_.vertices.count()) ||
            !corners.within(file_.indices.count()))
            return Error{location_,
                         fmt::format("face {} refers to a missing texture, vertices or indices", number)};
        material_ = texture;
        origin_ = number < origins_.size() ? origins_[number].cast<float>() : Vec3f(Vec3f::Zero());
        if (kind == patch_face) return add_patch(number, points, u32_at(face, 96), u32_at(face, 100));
        if (kind == polygon_face || kind == mesh_face)
            return add_triangles(number, points, corners, kind == polygon_face);
        ++dropped_;
        return {};
    }

    // Faces may share vertices and indices. A map whose faces do so again and again is small only as a file.
    Status count_corners(std::size_t more) {
        corners_ += more;
        const std::size_t bytes =
            file_.faces.bytes.size() + file_.vertices.bytes.size() + file_.indices.bytes.size();
        const std::size_t most = std::min(max_corners, 4 * bytes);
        if (corners_ <= most) return {};
        return Error{location_, fmt::format("has too many faces: more than {} corners in {} bytes of faces, "
                                            "vertices and indices",
                                            most, bytes)};
    }

    Status add_triangles(std::size_t number, const BspRange& points, const BspRange& corners, bool flat) {
        if (auto status = count_corners(corners.count); !status) return status;
        std::vector<std::uint32_t> triangles;
        for (std::size_t i = 0; i + 2 < corners.count; i += 3) {
            for (std::size_t k = 3; k-- > 0;) {  // Quake has the opposite winding
                const std::uint32_t index = u32_at(file_.indices.at(corners.first + i + k), 0);
                if (index >= points.count)
                    return Error{location_, fmt::format("face {} has index {} of {} vertices", number, index,
                                                        points.count)};
                triangles.push_back(index);
            }
        }
        std::vector<Point> used;
        for (const std::uint32_t index : triangles) {
            used.push_back(point(points.first + index));
            if (auto status = check(used.back().position); !status) return status;
        }
        if (flat) store_walls(used);
        const std::vector<std::uint32_t> outline =
            flat ? outline_of(triangles) : std::vector<std::uint32_t>();
        if (!outline.empty()) {
            std::vector<Point> around;
            for (const std::uint32_t index : outline)
                around.push_back(point(points.first + index));
            if (same_area(around, used)) {
                add(around);
                return {};
            }
        }
        for (std::size_t i = 0; i < used.size(); i += 3)
            add(std::span(used).subspan(i, 3));
        return {};
    }

    // The outline may replace the triangles only if it is flat and does not cross itself.
    static bool same_area(const std::vector<Point>& outline, const std::vector<Point>& triangles) {
        Vec3 sum = Vec3::Zero();
        const Vec3 first = outline[0].position.cast<double>();
        for (std::size_t i = 2; i < outline.size(); ++i)
            sum += (outline[i - 1].position.cast<double>() - first)
                       .cross(outline[i].position.cast<double>() - first);
        double area = 0;
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            const Vec3 a = triangles[i].position.cast<double>();
            area += (triangles[i + 1].position.cast<double>() - a)
                        .cross(triangles[i + 2].position.cast<double>() - a)
                        .norm();
        }
        if (!(std::abs(sum.norm() - area) <= 1e-5 * area) || !(area > 0)) return false;
        const Vec3 normal = sum.normalized();
        return std::all_of(outline.begin(), outline.end(), [&](const Point& corner) {
            return std::abs(normal.dot(corner.position.cast<double>() - first)) < flatness;
        });
    }

    // A face that does not stop a player does not cover a wall that does.
    void store_walls(const std::vector<Point>& triangles) {
        if ((file_.contents(material_) & bsp::contents_wall) == 0) return;
        for (std::size_t i = 0; i < triangles.size(); i += 3)
            out_.walls.push_back({triangles[i].position.cast<double>(),
                                  triangles[i + 1].position.cast<double>(),
                                  triangles[i + 2].position.cast<double>()});
    }

    // Biquadratic Bezier patches of 3 x 3 control points; neighbours share their borders.
    Status add_patch(std::size_t number, const BspRange& points, std::size_t width, std::size_t height) {
        if (width < 3 || height < 3 || width % 2 == 0 || height % 2 == 0 || width > points.count ||
            height > points.count || width * height > points.count)
            return Error{location_, fmt::format("face {} is a patch of {} x {} for {} vertices", number,
                                                width, height, points.count)};
        for (std::size_t y = 0; y + 2 < height; y += 2)
            for (std::size_t x = 0; x + 2 < width; x += 2)
                if (auto status = add_square(points.first + y * width + x, width); !status) return status;
        return {};
    }

    Status add_square(std::size_t first, std::size_t width) {
        if (auto status = count_corners(4 * patch_steps * patch_steps); !status) return status;
        Point grid[patch_steps + 1][patch_steps + 1];
        for (int v = 0; v <= patch_steps; ++v) {
            Point column[3];
            for (std::size_t x = 0; x < 3; ++x)
                column[x] = mix(point(first + x), point(first + width + x), point(first + 2 * width + x),
                                static_cast<float>(v) / patch_steps);
            for (int u = 0; u <= patch_steps; ++u) {
                grid[v][u] = mix(column[0], column[1], column[2], static_cast<float>(u) / patch_steps);
                if (auto status = check(grid[v][u].position); !status) return status;
            }
        }
        for (int v = 0; v < patch_steps; ++v)
            for (int u = 0; u < patch_steps; ++u)
                add(std::array{grid[v][u], grid[v][u + 1], grid[v + 1][u + 1], grid[v + 1][u]});
        return {};
    }

    Point point(std::size_t i) const {
        const std::string_view record = file_.vertices.at(i);
        Point result;
        result.position = vec3_at(record, 0) + origin_;
        result.uv = Vec2f(f32_at(record, 12), 1 - f32_at(record, 16));
        if (!result.uv.allFinite()) result.uv.setZero();
        return result;
    }

    Status check(const Vec3f& position) const {
        if (position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= bsp::largest_coordinate) return {};
        return Error{location_,
                     fmt::format("a vertex is not within {} units of the origin", bsp::largest_coordinate)};
    }

    void add(std::span<const Point> points) {
        std::vector<Vec3f> positions;
        std::vector<Vec2f> uv;
        for (const Point& one : points) {
            positions.push_back(one.position);
            uv.push_back(one.uv);
        }
        if (!append_face(out_.soup, positions, uv, material_)) ++dropped_;
    }

    const BspFile& file_;
    const std::vector<Vec3>& origins_;
    const std::string& location_;
    BspFaces out_;
    std::size_t material_ = 0;
    Vec3f origin_ = Vec3f::Zero();
    std::size_t dropped_ = 0;
    std::size_t corners_ = 0;  // of all faces so far
};

}  // namespace

Result<BspFaces> read_bsp_faces(const BspFile& file, const std::vector<Vec3>& origins,
                                const std::string& location, WarningList& warnings) {
    return FaceReader(file, origins, location).run(warnings);
}

bool append_face(PolygonSoup& soup, std::span<const Vec3f> corners, std::span<const Vec2f> uv,
                 std::size_t material) {
    std::size_t second = 0;
    bool surface = false;
    for (std::size_t i = 1; i < corners.size() && !surface; ++i) {
        if (corners[i] == corners[0] || corners[i] == corners[second]) continue;
        surface = second != 0;
        second = i;
    }
    if (!surface) return false;
    soup.corner_position.insert(soup.corner_position.end(), corners.begin(), corners.end());
    soup.corner_uv.insert(soup.corner_uv.end(), uv.begin(), uv.end());
    soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    soup.face_material.push_back(static_cast<std::uint32_t>(material));
    return true;
}

std::vector<std::uint32_t> outline_of(std::span<const std::uint32_t> triangles) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[i + k], to = triangles[i + (k + 1) % 3];
            if (from == to) return {};
            if (edges.erase({to, from}) == 0 && !edges.emplace(from, to).second) return {};
        }
    }
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : edges)
        if (!next.emplace(from, to).second) return {};
    if (next.size() < 3) return {};
    std::vector<std::uint32_t> outline;
    // It begins where the first triangle does, if that corner lies on the outline.
    const auto on_outline = std::find_if(triangles.begin(), triangles.end(),
                                         [&](std::uint32_t vertex) { return next.count(vertex) > 0; });
    for (std::uint32_t at = *on_outline; outline.size() < next.size(); at = next.at(at)) {
        if (!outline.empty() && at == outline.front()) return {};  // several outlines
        if (next.count(at) == 0) return {};
        outline.push_back(at);
    }
    return outline;
}

}  // namespace slipface
