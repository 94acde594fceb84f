#include "floor_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace slipface {

namespace {

constexpr double max_cells = 1 << 18, max_visits = 1 << 21;
constexpr double cell_in_radii = 1.25;  // a door a little wider than the player leaves a cell free
constexpr int least_columns = 8;        // also in a level smaller than the player

enum Kind : std::uint8_t { obstacle, floor_front, floor_back };

// What a triangle fills of a cell.
struct Piece {
    std::uint32_t cell = 0;
    float low = 0.0f, high = 0.0f;  // above the lowest point of the level, metres
    Kind kind = obstacle;
};
// Where a triangle crosses the line through the middle of a cell.
struct Crossing {
    std::uint32_t cell = 0;
    float y = 0.0f;
    std::int8_t up = 0;  // 1: its front looks up, -1: down
    Kind kind = obstacle;
};

class Polygon {
  public:
    explicit Polygon(const std::array<Vec3, 3>& corners) : count_(3) {
        std::copy(corners.begin(), corners.end(), points_.begin());
    }
    // What lies at or beyond `value` along the axis, in the direction of `sign`.
    Polygon beyond(int axis, double value, double sign) const {
        Polygon out;
        for (std::size_t i = 0; i < count_; ++i) {
            const Vec3 &a = points_[i], &b = points_[i + 1 < count_ ? i + 1 : 0];
            const double da = sign * (a[axis] - value), db = sign * (b[axis] - value);
            if (da >= 0) out.add(a);
            if ((da > 0 && db < 0) || (da < 0 && db > 0)) out.add(a + (b - a) * (da / (da - db)));
        }
        return out;
    }
    Polygon between(int axis, double low, double high) const {
        return beyond(axis, low, 1.0).beyond(axis, high, -1.0);
    }
    bool empty() const { return count_ == 0; }
    std::pair<double, double> extent(int axis) const {
        double low = points_[0][axis], high = low;
        for (std::size_t i = 1; i < count_; ++i) {
            low = std::min(low, points_[i][axis]);
            high = std::max(high, points_[i][axis]);
        }
        return {low, high};
    }

  private:
    Polygon() = default;
    void add(const Vec3& point) {
        if (count_ < points_.size()) points_[count_++] = point;
    }
    std::array<Vec3, 9> points_;
    std::size_t count_ = 0;
};

// Orders by cell; the order within a cell is the one before.
template <class Item>
std::vector<std::size_t> sort_by_cell(std::vector<Item>& items, std::size_t cells) {
    std::vector<std::size_t> first(cells + 1, 0);
    for (const Item& item : items)
        ++first[item.cell + 1];
    for (std::size_t i = 0; i < cells; ++i)
        first[i + 1] += first[i];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    std::vector<Item> sorted(items.size());
    for (const Item& item : items)
        sorted[next[item.cell]++] = item;
    items = std::move(sorted);
    return first;
}

class Columns {
  public:
    Columns(const MovementScene& scene, const MovementSettings& settings)
        : scene_(scene), settings_(settings), least_up_(std::cos(settings.max_slope)) {}

    FloorColumns make() {
        out_.bounds = scene_.collision.bounds();
        if (const Heightfield* field = terrain()) {
            const auto [low, high] = std::minmax_element(field->heights.begin(), field->heights.end());
            out_.bounds.add(Vec3(field->origin.x(), *low, field->origin.z()));
            out_.bounds.add(
                Vec3(field->origin.x() + field->size.x(), *high, field->origin.z() + field->size.y()));
        }
        if (out_.bounds.empty() || !out_.bounds.min.allFinite() || !out_.bounds.max.allFinite()) return {};
        lowest_ = out_.bounds.min.y();
        out_.body = 2.0 * settings_.radii.y();
        choose_cells();
        for (TriangleId triangle = 0; triangle < scene_.collision.triangle_count(); ++triangle)
            add(triangle);
        add_terrain();
        make_places();
        make_standings();
        return std::move(out_);
    }

  private:
    const Heightfield* terrain() const {
        const Heightfield* field = settings_.heightfield ? scene_.heightfield : nullptr;
        return field != nullptr && !field->heights.empty() ? field : nullptr;
    }

    void choose_cells() {
        const Vec3 size = out_.bounds.max - out_.bounds.min;
        const double wide = std::max(size.x(), size.z());
        const double radius = std::max({settings_.radii.x(), settings_.radii.z(), 1e-3});
        double cell = std::clamp(wide / least_columns, radius / 8.0, cell_in_radii * radius);
        const auto too_many = [&] {
            if ((size.x() / cell + 2.0) * (size.z() / cell + 2.0) > max_cells) return true;
            double visits = 0.0;
            for (TriangleId triangle = 0; triangle < scene_.collision.triangle_count(); ++triangle) {
                const auto [a, b, c] = scene_.collision.triangle(triangle);
                const Vec3 extent = a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c);
                visits += (1.0 + extent.x() / cell) * (1.0 + extent.z() / cell);
                if (visits > max_visits + static_cast<double>(scene_.collision.triangle_count())) return true;
            }
            return false;
        };
        while (too_many())
            cell *= 1.5;
        out_.cell = cell;
        // Faces on round coordinates do not lie on the borders of cells.
        out_.origin = Vec2(out_.bounds.min.x() - 0.37 * cell, out_.bounds.min.z() - 0.41 * cell);
        out_.columns = static_cast<int>(size.x() / cell + 2.0);
        out_.rows = static_cast<int>(size.z() / cell + 2.0);
    }
    std::size_t cells() const {
        return static_cast<std::size_t>(out_.columns) * static_cast<std::size_t>(out_.rows);
    }

    // The first and the last cell that an extent touches.
    std::pair<int, int> range(double low, double high, double origin, int count) const {
        const auto first = static_cast<int>(std::floor((low - origin) / out_.cell));
        const auto last = static_cast<int>(std::ceil((high - origin) / out_.cell)) - 1;
        return {std::clamp(first, 0, count - 1), std::clamp(std::max(first, last), 0, count - 1)};
    }

    void add(TriangleId triangle) {
        const SurfaceId surface = scene_.collision.face_surface(scene_.collision.triangle_face(triangle));
        const SurfaceRule rule = scene_.collision.surface_rule(surface);
        if (!rule.solid) return;
        const std::array<Vec3, 3> corners = scene_.collision.triangle(triangle);
        const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        const bool typed = settings_.surface_types && surface < scene_.surfaces.size();
        const bool hazard = typed && scene_.surfaces[surface].hazardous;
        const double least = typed && scene_.surfaces[surface].max_slope
                                 ? std::cos(*scene_.surfaces[surface].max_slope)
                                 : least_up_;
        Kind kind = obstacle;
        if (!hazard && std::abs(normal.y()) >= least * normal.norm() && normal.y() != 0.0)
            kind = normal.y() > 0.0 ? floor_front : rule.one_sided ? obstacle : floor_back;
        fill(corners, kind);
        if (normal.y() != 0.0) cross(corners, normal.y() > 0.0 ? 1 : -1, kind);
    }

    void fill(const std::array<Vec3, 3>& corners, Kind kind) {
        const Polygon whole(corners);
        const auto [low_z, high_z] = whole.extent(2);
        const auto [row0, row1] = range(low_z, high_z, out_.origin.y(), out_.rows);
        for (int row = row0; row <= row1; ++row) {
            const double z = out_.origin.y() + row * out_.cell;
            const Polygon strip = row0 == row1 ? whole : whole.between(2, z, z + out_.cell);
            if (strip.empty()) continue;
            const auto [low_x, high_x] = strip.extent(0);
            const auto [low_y, high_y] = strip.extent(1);
            const auto [column0, column1] = range(low_x, high_x, out_.origin.x(), out_.columns);
            for (int column = column0; column <= column1; ++column) {
                auto [low, high] = std::pair(low_y, high_y);
                if (low != high && column0 != column1) {
                    const double x = out_.origin.x() + column * out_.cell;
                    const Polygon piece = strip.between(0, x, x + out_.cell);
                    if (piece.empty()) continue;
                    std::tie(low, high) = piece.extent(1);
                }
                pieces_.push_back({static_cast<std::uint32_t>(out_.cell_at(column, row)),
                                   static_cast<float>(low - lowest_), static_cast<float>(high - lowest_),
                                   kind});
            }
        }
    }

    // Faces that share an edge cut it at the same bits, so that no line slips between them or meets both.
    void cross(const std::array<Vec3, 3>& corners, std::int8_t up, Kind kind) {
        const auto [low_z, high_z] = std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
        const auto [row0, row1] = range(low_z, high_z, out_.origin.y(), out_.rows);
        for (int row = row0; row <= row1; ++row) {
            const double z = out_.origin.y() + (row + 0.5) * out_.cell;
            std::array<Vec2, 2> cut;  // x and y
            std::size_t cuts = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 *p = &corners[i], *q = &corners[(i + 1) % 3];
                if (q->z() < p->z()) std::swap(p, q);
                if (!(p->z() <= z && z < q->z()) || cuts == 2) continue;
                const double t = (z - p->z()) / (q->z() - p->z());
                cut[cuts++] = Vec2(p->x() + t * (q->x() - p->x()), p->y() + t * (q->y() - p->y()));
            }
            if (cuts < 2) continue;
            if (cut[1].x() < cut[0].x()) std::swap(cut[0], cut[1]);
            const double width = cut[1].x() - cut[0].x();
            const double from = (cut[0].x() - out_.origin.x()) / out_.cell - 0.5;
            for (int column = std::max(0, static_cast<int>(std::floor(from))); column < out_.columns;
                 ++column) {
                const double x = out_.origin.x() + (column + 0.5) * out_.cell;
                if (x < cut[0].x()) continue;
                if (x >= cut[1].x()) break;
                const double y = cut[0].y() + (x - cut[0].x()) / width * (cut[1].y() - cut[0].y());
                crossings_.push_back({static_cast<std::uint32_t>(out_.cell_at(column, row)),
                                      static_cast<float>(y - lowest_), up, kind});
            }
        }
    }

    // Ground below which nobody is.
    void add_terrain() {
        const Heightfield* field = terrain();
        if (field == nullptr) return;
        terrain_.assign(cells(), -std::numeric_limits<float>::infinity());
        for (int row = 0; row < out_.rows; ++row) {
            for (int column = 0; column < out_.columns; ++column) {
                const Vec2 middle = out_.origin + out_.cell * Vec2(column + 0.5, row + 0.5);
                const auto point = terrain_at(*field, middle.x(), middle.y());
                if (!point) continue;
                const std::size_t at = out_.cell_at(column, row);
                const Kind kind = point->normal.y() >= least_up_ ? floor_front : obstacle;
                terrain_[at] = static_cast<float>(point->height - lowest_);
                pieces_.push_back({static_cast<std::uint32_t>(at), 0.0f, terrain_[at], kind});
                crossings_.push_back({static_cast<std::uint32_t>(at), terrain_[at], 0, kind});
            }
        }
    }

    void make_places() {
        const std::vector<std::size_t> first = sort_by_cell(pieces_, cells());
        const double step = settings_.step_up ? settings_.step_height : settings_.skin;
        out_.first.assign(cells() + 1, 0);
        for (std::size_t at = 0; at < cells(); ++at) {
            out_.first[at] = out_.places.size();
            const auto begin = pieces_.begin() + static_cast<std::ptrdiff_t>(first[at]);
            const auto end = pieces_.begin() + static_cast<std::ptrdiff_t>(first[at + 1]);
            std::sort(begin, end, [](const Piece& a, const Piece& b) {
                return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.kind < b.kind;
            });
            for (auto i = begin; i != end;) {
                double top = i->high, floor = -std::numeric_limits<double>::infinity(), rise = 0.0;
                for (; i != end && i->low < top + out_.body; ++i) {
                    top = std::max(top, double{i->high});
                    if (i->kind == obstacle || i->high < floor) continue;
                    floor = i->high;
                    rise = double{i->high} - double{i->low};
                }
                if (!terrain_.empty() && top < terrain_[at]) continue;
                const double ceiling = i == end ? std::numeric_limits<double>::infinity() : double{i->low};
                out_.places.push_back({top + lowest_, ceiling + lowest_, rise, floor >= top - step});
            }
        }
        out_.first[cells()] = out_.places.size();
    }

    void make_standings() {
        const std::vector<std::size_t> first = sort_by_cell(crossings_, cells());
        for (std::size_t at = 0; at < cells(); ++at) {
            const auto begin = crossings_.begin() + static_cast<std::ptrdiff_t>(first[at]);
            const auto end = crossings_.begin() + static_cast<std::ptrdiff_t>(first[at + 1]);
            std::sort(begin, end, [](const Crossing& a, const Crossing& b) {
                return a.y != b.y ? a.y < b.y : a.up != b.up ? a.up < b.up : a.kind < b.kind;
            });
            int above = 0, below = 0;
            for (auto i = begin; i != end; ++i)
                above += i->up;
            for (auto i = begin; i != end; ++i) {
                above -= i->up;
                below -= i->up;
                if (i->kind == obstacle || (!terrain_.empty() && i->y < terrain_[at])) continue;
                if (i + 1 != end && (i + 1)->y < i->y + out_.body) continue;
                const bool ground = i->up == 0;  // terrain
                out_.standings.push_back({static_cast<std::uint32_t>(at), double{i->y} + lowest_,
                                          i->kind == floor_front, ground ? 0 : above, ground ? 0 : below});
            }
        }
    }

    const MovementScene& scene_;
    const MovementSettings& settings_;
    const double least_up_;
    double lowest_ = 0.0;
    FloorColumns out_;
    std::vector<Piece> pieces_;
    std::vector<Crossing> crossings_;
    std::vector<float> terrain_;  // [cell]; empty: there is none
};

}  // namespace

FloorColumns floor_columns(const MovementScene& scene, const MovementSettings& settings) {
    return Columns(scene, settings).make();
}

}  // namespace slipface
