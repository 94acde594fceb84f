#include "slipface/sim/level_fingerprint.h"

#include "slipface/base/hash.h"
#include "slipface/sim/simulate.h"

namespace slipface {
namespace {

// Each struct is taken apart whole, so that a new member does not compile until it is hashed.
class LevelHasher {
  public:
    void add(double number) { hasher_.f64(number); }
    void add(std::uint64_t number) { hasher_.u64(number); }
    void add(const std::string& text) { hasher_.text(text); }
    template <int Size>
    void add(const Eigen::Matrix<double, Size, 1>& vector) {
        for (const double number : vector)
            add(number);
    }
    void add(const Platform& platform) {
        const auto& [name, group, path, repeat, spin_axis, spin_pivot, spin_rate, phase_s] = platform;
        static_cast<void>(name);
        add(group);
        add(static_cast<std::uint64_t>(repeat));
        add(spin_axis);
        add(spin_pivot);
        add(spin_rate);
        add(phase_s);
        add(std::uint64_t{path.size()});
        for (const auto& [offset, speed, pause_s] : path) {
            add(offset);
            add(speed);
            add(pause_s);
        }
    }
    void add(const Heightfield& terrain) {
        const auto& [columns, rows, heights, origin, size] = terrain;
        add(static_cast<std::uint64_t>(columns));
        add(static_cast<std::uint64_t>(rows));
        for (const double height : heights)
            add(height);
        add(origin);
        add(size);
    }
    void add(const SectorLayout& sectors) {
        const auto& [size, placement] = sectors;
        add(size);
        add(placement);
    }
    void add(const MovingPart& part) {
        for (std::size_t i = 0; i < part.rest->triangle_count(); ++i)
            add(std::uint64_t{part.rest->face_surface(part.rest->triangle_face(static_cast<TriangleId>(i)))});
    }
    std::uint64_t value() const { return hasher_.value(); }

  private:
    Hasher hasher_;
};

}  // namespace

std::uint64_t level_fingerprint(const Level& level, const MovementScene& at_first) {
    LevelHasher hasher;
    hasher.add(scene_fingerprint(at_first));
    for (const MovingPart& part : at_first.platforms)
        hasher.add(part);
    for (const Platform& platform : level.platforms)
        hasher.add(platform);
    if (level.terrain) hasher.add(*level.terrain);
    hasher.add(level.sectors);
    hasher.add(level.fall_limit.value_or(-1e300));
    return hasher.value();
}

}  // namespace slipface
