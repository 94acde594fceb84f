// A side polygon is a large square, cut by the planes of the brush's other sides. Then all parts that no
// player can touch are cut away.
#include "bsp/bsp_walls.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/BVH>
#include <utility>

namespace slipface {
namespace {

constexpr double tolerance = 0.02;      // units; planes that should be equal differ by less
constexpr double narrowest = 0.25;      // units; map compilers snap drawn vertices by up to this
constexpr double reach = 1 << 18;       // units; larger than any map
constexpr std::size_t max_sides = 256;  // per brush
constexpr std::size_t deepest = 2048;   // of the tree

struct Brush {
    std::size_t texture = 0;
    std::size_t first_side = 0;           // index in the file
    bool world = false;                   // false: a moving part, which is not in the tree
    std::vector<Plane> planes;            // [side]
    std::vector<ConvexPolygon> polygons;  // [side]; empty: a bevel, which bounds nothing
    Aabb bounds;
};

using Box = Eigen::AlignedBox3d;

// Grown, so that boxes touch if they are no farther apart than the tolerance.
Box box_of(const Aabb& bounds) {
    return {bounds.min - Vec3::Constant(tolerance / 2), bounds.max + Vec3::Constant(tolerance / 2)};
}

// A tree of boxes, to find those that touch another box.
class Boxes {
  public:
    explicit Boxes(const std::vector<Box>& boxes) {
        std::vector<Numbered> numbered;
        for (const Box& box : boxes)
            numbered.emplace_back(box, numbered.size());
        any_ = !numbered.empty();
        tree_.init(numbered.begin(), numbered.end(), boxes.begin(), boxes.end());
    }

    // The boxes that touch `box`, ascending. Adds the number of boxes examined to `work`.
    std::vector<std::size_t> touching(const Box& box, std::size_t& work) const {
        Visitor visitor{box, work, {}};
        if (any_) Eigen::BVIntersect(tree_, visitor);
        std::sort(visitor.found.begin(), visitor.found.end());
        return std::move(visitor.found);
    }

  private:
    using Numbered = std::pair<Box, std::size_t>;
    struct Visitor {
        const Box& box;
        std::size_t& work;
        std::vector<std::size_t> found;

        bool intersectVolume(const Box& volume) {
            ++work;
            return volume.intersects(box);
        }
        bool intersectObject(const Numbered& one) {
            ++work;
            if (one.first.intersects(box)) found.push_back(one.second);
            return false;  // go on
        }
    };
    bool any_ = false;
    Eigen::KdBVH<double, 3, Numbered> tree_;
};

class WallFinder {
  public:
    WallFinder(const BspFile& file, std::span<const BspTriangle> drawn, const std::string& location)
        : file_(file), drawn_(drawn), location_(location) {}

    Status add_brushes(const BspRange& range, const Vec3& origin, bool world) {
        if (!range.within(file_.brushes.count()))
            return Error{location_, "a model refers to missing brushes"};
        for (std::size_t i = range.first; i < range.first + range.count; ++i)
            if (auto status = add_brush(i, origin, world); !status) return status;
        return {};
    }

    Result<std::vector<BspWall>> run(Progress* progress) {
        std::vector<Box> brush_boxes, drawn_boxes;
        for (const Brush& brush : brushes_)
            brush_boxes.push_back(box_of(brush.bounds));
        for (const BspTriangle& triangle : drawn_)
            drawn_boxes.push_back(box_of(bounds_of({triangle.begin(), triangle.end()})));
        const Boxes brushes(brush_boxes), drawn(drawn_boxes);
        for (std::size_t i = 0; i < brushes_.size(); ++i) {
            if (cancelled(progress)) return cancelled_error(location_);
            advance(progress, static_cast<double>(i) / static_cast<double>(brushes_.size()));
            for (std::size_t side = 0; side < brushes_[i].planes.size(); ++side) {
                if (brushes_[i].polygons[side].empty()) continue;
                if (auto status = add_side(i, side, brushes, drawn); !status) return status.error();
            }
        }
        return std::move(walls_);
    }

  private:
    // Far more than the largest map needs, but reached within seconds.
    Status within_bounds() const {
        if (work_ < std::size_t{500'000'000}) return {};
        return Error{location_, "has too many overlapping brushes to find the faces towards open space"};
    }

    Status add_brush(std::size_t number, const Vec3& origin, bool world) {
        const std::string_view record = file_.brushes.at(number);
        const BspRange sides = bsp_range_at(record, 0);
        const std::size_t texture = u32_at(record, 8);
        if (!sides.within(file_.sides.count()) || texture >= file_.textures.count())
            return Error{location_,
                         fmt::format("brush {} refers to missing sides or a missing texture", number)};
        if ((file_.contents(texture) & bsp::contents_wall) == 0 || sides.count > max_sides) return {};
        Brush brush{texture, sides.first, world, {}, {}, {}};
        for (std::size_t i = 0; i < sides.count; ++i) {
            const std::size_t plane = u32_at(file_.sides.at(sides.first + i), 0);
            if (plane >= file_.planes.count() ||
                u32_at(file_.sides.at(sides.first + i), 4) >= file_.textures.count())
                return Error{
                    location_,
                    fmt::format("side {} of brush {} refers to a missing plane or texture", i, number)};
            brush.planes.push_back(plane_at(plane));
            if (!(brush.planes.back().normal.norm() > 0.5)) return {};
            brush.planes.back().distance += brush.planes.back().normal.dot(origin);
        }
        for (std::size_t i = 0; i < brush.planes.size(); ++i) {
            brush.polygons.push_back(side_polygon(brush.planes, i));
            for (const Vec3& corner : brush.polygons.back())
                brush.bounds.add(corner);
            if (auto status = within_bounds(); !status) return status;
        }
        if (!brush.bounds.empty()) brushes_.push_back(std::move(brush));
        return {};
    }

    // The normal is zero if the numbers in the file are not valid.
    Plane plane_at(std::size_t number) const {
        const std::string_view record = file_.planes.at(number);
        const Vec3 normal = vec3_at(record, 0).cast<double>();
        const double length = normal.norm(), distance = f32_at(record, 12);
        if (!(std::abs(length - 1.0) < 0.01) || !(std::abs(distance) < reach)) return {Vec3::Zero(), 0.0};
        return {normal / length, distance / length};
    }

    ConvexPolygon side_polygon(const std::vector<Plane>& planes, std::size_t side) {
        ConvexPolygon polygon = square_on(planes[side], 4 * reach);
        for (std::size_t i = 0; i < planes.size() && !polygon.empty(); ++i) {
            work_ += polygon.size();
            if (i != side) polygon = cut(polygon, planes[i], 1e-4).back;
            // Of two sides in one plane, only the first has a polygon.
            if (i < side && planes[i].normal.dot(planes[side].normal) > 0.99999 &&
                std::abs(planes[i].distance - planes[side].distance) < tolerance)
                polygon.clear();
        }
        if (width_of(polygon) < tolerance) polygon.clear();
        return polygon;
    }

    Status add_side(std::size_t brush, std::size_t side, const Boxes& brushes, const Boxes& drawn) {
        const ConvexPolygon& whole = brushes_[brush].polygons[side];
        const Plane& plane = brushes_[brush].planes[side];
        std::vector<ConvexPolygon> parts{whole};
        if (brushes_[brush].world && file_.nodes.count() > 0) {
            parts.clear();
            if (auto status = open_parts(0, 0, whole, plane, parts).status; !status) return status;
        }
        const Box box = box_of(bounds_of(whole));
        for (const std::size_t other : brushes.touching(box, work_)) {
            if (parts.empty()) return {};
            if (other != brush && hides(brushes_[other], plane, other < brush))
                subtract_solid(brushes_[other].planes, parts);
            if (auto status = within_bounds(); !status) return status;
        }
        for (const std::size_t triangle : drawn.touching(box, work_)) {
            if (parts.empty()) return {};
            if (lies_in(drawn_[triangle], plane)) subtract_solid(edge_planes(drawn_[triangle], plane), parts);
            if (auto status = within_bounds(); !status) return status;
        }
        std::erase_if(parts, [](const ConvexPolygon& part) { return width_of(part) < narrowest; });
        double area = 0;
        for (const ConvexPolygon& part : parts)
            area += area_of(part);
        if (area > 0.9999 * area_of(whole)) parts = {whole};
        // The contents of the brush decide whether it is solid; a side may have a texture that is not.
        std::size_t texture = u32_at(file_.sides.at(brushes_[brush].first_side + side), 4);
        if ((file_.contents(texture) & bsp::contents_wall) == 0) texture = brushes_[brush].texture;
        for (ConvexPolygon& part : parts)
            walls_.push_back({std::move(part), texture});
        return {};
    }

    // True if a side in `plane` can lie inside `other`. If two brushes have a side in the same plane, the
    // earlier brush has it.
    static bool hides(const Brush& other, const Plane& plane, bool earlier) {
        if (earlier) return true;
        return std::none_of(other.planes.begin(), other.planes.end(), [&](const Plane& one) {
            return one.normal.dot(plane.normal) > 0.99999 &&
                   std::abs(one.distance - plane.distance) < 2 * tolerance;
        });
    }

    void subtract_solid(const std::vector<Plane>& solid, std::vector<ConvexPolygon>& parts) {
        std::vector<ConvexPolygon> left;
        for (const ConvexPolygon& part : parts) {
            work_ += solid.size() * part.size();
            subtract(part, solid, tolerance, left);
        }
        std::erase_if(left, [](const ConvexPolygon& part) { return width_of(part) < tolerance; });
        parts = std::move(left);
    }

    // True if a drawn face lies in the same plane and faces the same way.
    static bool lies_in(const BspTriangle& triangle, const Plane& plane) {
        for (const Vec3& corner : triangle)
            if (std::abs(plane.above(corner)) > narrowest) return false;
        return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).dot(plane.normal) > 0;
    }

    static std::vector<Plane> edge_planes(const BspTriangle& triangle, const Plane& plane) {
        std::vector<Plane> planes;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 outward = (triangle[(i + 1) % 3] - triangle[i]).cross(plane.normal);
            if (!(outward.norm() > 1e-6)) continue;
            planes.push_back({outward.normalized(), outward.normalized().dot(triangle[i])});
        }
        return planes;
    }

    struct Open {
        Status status;
        bool all = false;
    };
    // Appends the parts of `polygon` with a leaf of open space in front; one piece if that is the whole
    // polygon.
    Open open_parts(std::size_t node, std::size_t depth, const ConvexPolygon& polygon, const Plane& plane,
                    std::vector<ConvexPolygon>& out) {
        work_ += polygon.size();
        if (auto status = within_bounds(); !status) return {status, false};
        const std::string_view record = file_.nodes.at(node);
        const std::size_t number = u32_at(record, 0);
        if (number >= file_.planes.count() || depth == deepest)
            return {Error{location_, fmt::format("node {} of the tree has no plane, or lies too deep", node)},
                    false};
        const Plane divider = plane_at(number);
        PolygonParts parts = cut(polygon, divider, tolerance);
        const bool in_divider = std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& corner) {
            return std::abs(divider.above(corner)) <= tolerance;
        });
        if (in_divider && divider.normal.dot(plane.normal) > 0) std::swap(parts.front, parts.back);
        const std::size_t before = out.size();
        bool all = true;
        for (const auto& [part, child] : {std::pair(&parts.front, 4), std::pair(&parts.back, 8)}) {
            if (part->empty()) continue;
            const std::int32_t next = i32_at(record, static_cast<std::size_t>(child));
            if (next >= 0) {
                if (static_cast<std::size_t>(next) >= file_.nodes.count())
                    return {Error{location_, fmt::format("node {} refers to a missing child", node)}, false};
                const Open open = open_parts(static_cast<std::size_t>(next), depth + 1, *part, plane, out);
                if (!open.status) return open;
                all = all && open.all;
                continue;
            }
            const auto leaf = static_cast<std::size_t>(-(static_cast<std::int64_t>(next) + 1));
            if (leaf >= file_.leaves.count())
                return {Error{location_, fmt::format("node {} refers to a missing leaf", node)}, false};
            const bool open = i32_at(file_.leaves.at(leaf), 0) >= 0;
            if (open) out.push_back(*part);
            all = all && open;
        }
        if (all && out.size() > before + 1) {
            out.resize(before);
            out.push_back(polygon);
        }
        return {{}, all};
    }

    const BspFile& file_;
    const std::span<const BspTriangle> drawn_;
    const std::string& location_;
    std::vector<Brush> brushes_;
    std::vector<BspWall> walls_;
    std::size_t work_ = 0;
};

}  // namespace

Result<std::vector<BspWall>> undrawn_walls(const BspFile& file, std::span<const BspModel> models,
                                           std::span<const BspTriangle> drawn, const std::string& location,
                                           Progress* progress) {
    WallFinder finder(file, drawn, location);
    for (const BspModel& model : models) {
        const BspRange brushes = bsp_range_at(file.models.at(model.number), 32);
        if (auto status = finder.add_brushes(brushes, model.origin, model.number == 0); !status)
            return status.error();
    }
    return finder.run(progress);
}

}  // namespace slipface
