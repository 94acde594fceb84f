// The best open floor near the middle of a level, for players of levels without a spawn.
#include <cmath>
#include <numeric>

#include "slipface/level/find_start.h"
#include "start_room.h"

namespace slipface {

namespace {

constexpr int max_columns = 64;   // along each of x and z
constexpr int least_columns = 8;  // also in a level smaller than the player
constexpr int max_layers = 32;    // floors above each other in a column
constexpr double height_weight = 2.0;

struct Sample {
    int column = 0, row = 0;
    Vec3 centre = Vec3::Zero();  // of a player who stands there
    int links = 0;               // to neighbours
};

class OpenFloor {
  public:
    OpenFloor(const MovementScene& scene, const MovementSettings& settings, bool backs)
        : scene_(scene), settings_(settings), backs_(backs), bounds_(scene.collision.bounds()) {
        if (const Heightfield* field = terrain(); field != nullptr && !field->heights.empty()) {
            const auto [low, high] = std::minmax_element(field->heights.begin(), field->heights.end());
            bounds_.add(Vec3(field->origin.x(), *low, field->origin.z()));
            bounds_.add(
                Vec3(field->origin.x() + field->size.x(), *high, field->origin.z() + field->size.y()));
        }
    }

    std::optional<Vec3> find() {
        if (bounds_.empty() || !bounds_.min.allFinite() || !bounds_.max.allFinite()) return std::nullopt;
        const Vec3 size = bounds_.max - bounds_.min;
        columns_ = count_along(size.x(), settings_.radii.x());
        rows_ = count_along(size.z(), settings_.radii.z());
        cell_ = Vec2(size.x() / columns_, size.z() / rows_);
        crowd_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
        for (const auto& [column, row] : from_the_middle())
            sample_column(column, row);
        const auto cell_of = [&](const Sample& sample) { return cell_index(sample.column, sample.row); };
        std::stable_sort(samples_.begin(), samples_.end(),
                         [&](const Sample& a, const Sample& b) { return cell_of(a) < cell_of(b); });
        first_.assign(crowd_.size() + 1, samples_.size());
        for (std::size_t i = samples_.size(); i-- > 0;)
            first_[cell_of(samples_[i])] = i;
        for (std::size_t cell = crowd_.size(); cell-- > 0;)
            first_[cell] = std::min(first_[cell], first_[cell + 1]);
        effort_ = SearchEffort();
        link_all();
        return choose();
    }
    bool all_tried() const { return all_tried_; }

  private:
    const Heightfield* terrain() const { return settings_.heightfield ? scene_.heightfield : nullptr; }
    // One sample per radius, within the limits.
    static int count_along(double size, double radius) {
        return static_cast<int>(
            std::clamp(std::ceil(size / radius), double{least_columns}, double{max_columns}));
    }
    std::size_t cell_index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    // The columns and rows of the grid, the nearest to its middle first.
    std::vector<std::pair<int, int>> from_the_middle() const {
        std::vector<std::pair<int, int>> cells;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column)
                cells.emplace_back(column, row);
        const auto distance2 = [&](const std::pair<int, int>& cell) {
            const int x = 2 * cell.first + 1 - columns_, z = 2 * cell.second + 1 - rows_;
            return x * x + z * z;
        };
        std::stable_sort(cells.begin(), cells.end(),
                         [&](const auto& a, const auto& b) { return distance2(a) < distance2(b); });
        return cells;
    }
    // Before queries in the column of a cell.
    bool spend(std::size_t cell) {
        const bool go_on = effort_.spend(crowd_[cell]);
        all_tried_ = all_tried_ && go_on;
        return go_on;
    }

    void sample_column(int column, int row) {
        const double x = bounds_.min.x() + (column + 0.5) * cell_.x();
        const double z = bounds_.min.z() + (row + 0.5) * cell_.y();
        const double step =
            1e-9 * (1.0 + bounds_.max.cwiseAbs().maxCoeff() + bounds_.min.cwiseAbs().maxCoeff());
        double y = bounds_.max.y() + 1.0;
        const Vec3 body = settings_.radii + Vec3(0.0, y - bounds_.min.y(), 0.0);
        const std::size_t cell = cell_index(column, row);
        crowd_[cell] = crowd_in(scene_, {Vec3(x, y, z) - body, Vec3(x, y, z) + body});
        for (int layer = 0; layer < max_layers && spend(cell); ++layer) {
            const auto hit = cast_ray(scene_.collision, {x, y, z}, {0.0, -1.0, 0.0});
            if (!hit) break;
            if (hit->back_face == backs_ && !is_hazard(hit->face))
                add_sample(column, row, hit->point, hit->normal);
            // The next ray starts a little below the hit, so that coincident faces are hit once.
            y = std::min(hit->point.y(), y) - std::max(step, 1e-4);
        }
        if (terrain() == nullptr) return;
        if (const auto point = terrain_at(*terrain(), x, z))
            add_sample(column, row, Vec3(x, point->height, z), point->normal);
    }

    bool is_hazard(FaceId face) const {
        const SurfaceId surface = scene_.collision.face_surface(face);
        return settings_.surface_types && surface < scene_.surfaces.size() &&
               scene_.surfaces[surface].hazardous;
    }

    void add_sample(int column, int row, const Vec3& point, const Vec3& normal) {
        if (normal.y() < std::cos(settings_.max_slope)) return;
        // Start above small bumps of the floor around the point.
        const double lift = 0.25 * settings_.radii.y();
        const double standing = centre_on(Vec3::Zero(), normal, settings_).dot(normal) / normal.y();
        const Vec3 above = point + Vec3(0.0, standing + lift, 0.0);
        if (!has_room(scene_, settings_, settings_.radii, above)) return;
        const auto landed = drop(scene_, settings_, above, 2.0 * lift + settings_.skin);
        if (landed && fits(scene_, settings_, *landed)) samples_.push_back({column, row, *landed});
    }

    std::size_t root(std::size_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    bool connected(const Vec3& from, const Vec3& to, std::size_t cell) {
        const double raise = settings_.step_up ? settings_.step_height : settings_.skin;
        const Vec3 path = to - from;
        if (std::abs(path.y()) > raise + Vec2(path.x(), path.z()).norm() * std::tan(settings_.max_slope))
            return false;
        const Vec3 up(0.0, raise, 0.0);
        return spend(cell) && !first_contact(scene_, settings_.radii, from + up, path);
    }

    void link_all() {
        parent_.resize(samples_.size());
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (samples_[i].column + 1 < columns_) link(i, samples_[i].column + 1, samples_[i].row);
            if (samples_[i].row + 1 < rows_) link(i, samples_[i].column, samples_[i].row + 1);
        }
    }

    void link(std::size_t i, int column, int row) {
        const std::size_t cell = cell_index(column, row);
        for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) {
            if (!connected(samples_[i].centre, samples_[k].centre, cell)) continue;
            ++samples_[i].links;
            ++samples_[k].links;
            const std::size_t a = root(i), b = root(k);
            parent_[std::max(a, b)] = std::min(a, b);
        }
    }

    std::optional<Vec3> choose() {
        std::vector<std::size_t> count(samples_.size(), 0);
        for (std::size_t i = 0; i < samples_.size(); ++i)
            ++count[root(i)];
        const std::size_t largest = count.empty() ? 0 : *std::max_element(count.begin(), count.end());
        const double smallest_area = settings_.radii.x() * settings_.radii.z();
        if (static_cast<double>(largest) * cell_.x() * cell_.y() < smallest_area) return std::nullopt;
        double lowest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (2 * count[root(i)] >= largest) lowest = std::min(lowest, samples_[i].centre.y());
        const Vec3 middle = 0.5 * (bounds_.min + bounds_.max);
        const Sample* best = nullptr;
        double best_cost = 0.0;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (2 * count[root(i)] < largest) continue;
            const Sample& sample = samples_[i];
            const double x = sample.centre.x() - middle.x(), z = sample.centre.z() - middle.z();
            const double up = height_weight * (sample.centre.y() - lowest);
            const double cost = x * x + z * z + up * up;
            // Samples that are open on all four sides come first.
            const bool open = sample.links >= 4, best_open = best != nullptr && best->links >= 4;
            if (best == nullptr || (open && !best_open) || (open == best_open && cost < best_cost)) {
                best = &sample;
                best_cost = cost;
            }
        }
        return best->centre;
    }

    const MovementScene& scene_;
    const MovementSettings& settings_;
    const bool backs_;  // stand on faces that look down, and on no others
    Aabb bounds_;
    int columns_ = 0, rows_ = 0;
    Vec2 cell_ = Vec2::Zero();
    std::vector<std::size_t> crowd_;  // [cell] about how many triangles a query there looks at
    SearchEffort effort_;
    bool all_tried_ = true;
    std::vector<Sample> samples_;     // sorted by cell
    std::vector<std::size_t> first_;  // [cell] its first sample; one more at the end
    std::vector<std::size_t> parent_;
};

}  // namespace

std::optional<Vec3> find_open_floor(const MovementScene& scene, const MovementSettings& settings,
                                    bool* all_tried) {
    // A level whose faces are wound the other way round throughout still holds the player.
    for (const bool backs : {false, true}) {
        OpenFloor search(scene, settings, backs);
        const auto floor = search.find();
        if (all_tried != nullptr) *all_tried = *all_tried && search.all_tried();
        if (floor) return floor;
    }
    return std::nullopt;
}

}  // namespace slipface
