// The motion of parts of which an edit left some faces as they were: faces of as large an area as no others,
// three of which are as far from each other as before.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "motion_finder.h"
#include "motion_fit.h"
#include "slipface/level/material_name.h"

namespace slipface {
namespace {

constexpr std::size_t max_painted = 4000, max_rare = 200;  // faces
constexpr std::size_t max_alike = 8;                       // faces that a rare one may be
constexpr std::size_t max_checked = 400;                   // faces that tell how good a motion is
constexpr std::size_t max_rated = 16;
constexpr std::size_t max_threes = 3000;  // threes of faces
constexpr std::size_t max_twos = 40'000;  // for which a third is looked for
constexpr double same_area = 2e-3;        // a level file rounds it
constexpr double same_normal = 0.999;
constexpr double enough_kept = 8.0;  // faces
constexpr double much_less = 0.6;    // of what the best motion keeps

// A painted face and those of the mesh that may be it.
struct Rare {
    const FaceKey* key;
    std::vector<FaceId> alike;
};

// Of the painted faces those with the fewest faces in the mesh of their material and area.
std::vector<Rare> rare_faces(const FaceIndex& index, std::size_t face_count, SurfaceTable surfaces,
                             std::span<const FaceKey* const> painted) {
    std::map<std::string, std::uint32_t> bases;
    using Sized = std::tuple<std::uint32_t, double, FaceId>;
    std::vector<Sized> sized;
    for (FaceId face = 0; face < face_count; ++face) {
        const auto base = static_cast<std::uint32_t>(bases.size());
        sized.emplace_back(bases.emplace(index.base(face), base).first->second, index.key(face).area, face);
    }
    std::sort(sized.begin(), sized.end());
    std::vector<Rare> rare;
    const std::size_t step = painted.size() / max_painted + 1;
    for (std::size_t i = 0; i < painted.size(); i += step) {
        const FaceKey& key = *painted[i];
        const auto base = bases.find(base_material(key.material, surfaces));
        if (base == bases.end()) continue;
        const double slack = same_area * key.area;
        Rare one{&key, {}};
        for (auto at = std::lower_bound(sized.begin(), sized.end(), Sized{base->second, key.area - slack, 0});
             at != sized.end() && std::get<0>(*at) == base->second && std::get<1>(*at) <= key.area + slack &&
             one.alike.size() <= max_alike;
             ++at)
            one.alike.push_back(std::get<2>(*at));
        if (!one.alike.empty() && one.alike.size() <= max_alike) rare.push_back(std::move(one));
    }
    std::stable_sort(rare.begin(), rare.end(),
                     [](const Rare& a, const Rare& b) { return a.alike.size() < b.alike.size(); });
    if (rare.size() > max_rare) rare.resize(max_rare);
    return rare;
}

// The motions that put three rare faces onto three of the mesh as far from each other.
class ThreesSearch {
  public:
    ThreesSearch(const FaceIndex& index, std::vector<Rare> rare) : index_(index), rare_(std::move(rare)) {}

    // Those that explain most rare faces, first.
    std::vector<PartMotion> run() {
        for (std::size_t i = 0; i < rare_.size() && tried_ < max_threes; ++i)
            for (std::size_t k = 0; k < i && tried_ < max_threes; ++k)
                for (const FaceId x : rare_[i].alike)
                    for (const FaceId y : rare_[k].alike)
                        try_two({&rare_[i], x}, {&rare_[k], y});
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Found& a, const Found& b) { return a.faces > b.faces; });
        if (found_.size() > max_rated) found_.resize(max_rated);
        std::vector<PartMotion> motions;
        for (const Found& one : found_)
            motions.push_back(one.motion);
        return motions;
    }

  private:
    // A painted face and the one of the mesh that it may be.
    struct Pair {
        const Rare* one;
        FaceId face;
        const Vec3& before() const { return one->key->centroid; }
    };
    struct Found {
        PartMotion motion;
        std::size_t faces;
    };

    const Vec3& now(const Pair& pair) const { return index_.key(pair.face).centroid; }

    bool are_as_far(const Pair& a, const Pair& b) const {
        const double slack = 4.0 * (position_tolerance(a.before()) + position_tolerance(now(a)));
        return std::abs((a.before() - b.before()).norm() - (now(a) - now(b)).norm()) <= slack;
    }

    bool explains(const PartMotion& motion, const Pair& pair) const {
        return (motion(pair.before()) - now(pair)).norm() <=
                   8.0 * (position_tolerance(pair.before()) + position_tolerance(now(pair))) &&
               index_.key(pair.face).normal.dot(motion.linear * pair.one->key->normal) > same_normal;
    }

    // The rigid motion of those faces that `rough` puts onto one of the mesh.
    std::optional<Found> fitted(const PartMotion& rough) const {
        std::vector<Vec3> from, to;
        for (const Rare& one : rare_) {
            const auto face = std::find_if(one.alike.begin(), one.alike.end(), [&](FaceId alike) {
                return explains(rough, Pair{&one, alike});
            });
            if (face == one.alike.end()) continue;
            from.push_back(one.key->centroid);
            to.push_back(index_.key(*face).centroid);
        }
        if (from.size() < 3) return std::nullopt;
        const std::optional<PartMotion> motion = fit_rigid(from, to);
        return motion ? std::optional(Found{*motion, from.size()}) : std::nullopt;
    }

    void try_two(const Pair& a, const Pair& b) {
        const auto is_known = [&](const Found& one) {
            return explains(one.motion, a) && explains(one.motion, b);
        };
        if (a.face == b.face || !are_as_far(a, b) || std::any_of(found_.begin(), found_.end(), is_known))
            return;
        if (++twos_ > max_twos) return;
        for (const Rare& third : rare_) {
            const Vec3 sides[] = {b.before() - a.before(), third.key->centroid - a.before()};
            if (!(sides[0].cross(sides[1]).norm() > 0.1 * sides[0].norm() * sides[1].norm())) continue;
            for (const FaceId face : third.alike) {
                const Pair c{&third, face};
                if (!are_as_far(a, c) || !are_as_far(b, c)) continue;
                if (++tried_ > max_threes) return;
                const std::optional<PartMotion> rough =
                    fit_rigid({a.before(), b.before(), c.before()}, {now(a), now(b), now(c)});
                if (!rough || !explains(*rough, a) || !explains(*rough, b) || !explains(*rough, c)) continue;
                if (const std::optional<Found> found = fitted(*rough)) {
                    found_.push_back(*found);
                    return;
                }
            }
        }
    }

    const FaceIndex& index_;
    const std::vector<Rare> rare_;
    std::vector<Found> found_;
    std::size_t twos_ = 0, tried_ = 0;
};

}  // namespace

std::optional<PartMotion> MotionFinder::motion_of_kept(std::span<const std::size_t> parts) {
    std::vector<bool> is_one(parts_.size() + 1, false);
    for (const std::size_t part : parts)
        is_one[part + 1] = true;
    std::vector<const FaceKey*> painted;
    for (std::size_t i = 0; i < overrides_.size() && i < stored_.of.size(); ++i)
        if (stored_.of[i] < is_one.size() && is_one[stored_.of[i]] && overrides_[i].key.area > 0.0)
            painted.push_back(&overrides_[i].key);
    std::vector<AreaMotion> motions;
    ThreesSearch search(index_, rare_faces(index_, mesh_.face_count(), surfaces_, painted));
    for (const PartMotion& motion : search.run())
        motions.push_back({motion, kept(painted, motion), 0.0});
    std::stable_sort(motions.begin(), motions.end(),
                     [](const AreaMotion& a, const AreaMotion& b) { return a.covered > b.covered; });
    if (motions.empty() || kept(painted, PartMotion{}) > much_less * motions[0].covered ||
        motions[0].covered * static_cast<double>(painted.size()) < enough_kept)
        return std::nullopt;
    return of_one_kind(parts, motions, much_less * motions[0].covered);
}

// What fraction of the painted faces, by some of them, the mesh has after the motion.
double MotionFinder::kept(std::span<const FaceKey* const> painted, const PartMotion& motion) const {
    const std::size_t step = painted.size() / max_checked + 1;
    double all = 0.0, found = 0.0;
    for (std::size_t i = 0; i < painted.size(); i += step) {
        const FaceKey moved = moved_key(*painted[i], motion);
        const std::vector<FaceId> faces = index_.near(moved.centroid, position_tolerance(moved.centroid));
        all += 1.0;
        found += std::any_of(faces.begin(), faces.end(),
                             [&](FaceId face) {
                                 const FaceKey& there = index_.key(face);
                                 return there.normal.dot(moved.normal) > same_normal &&
                                        std::abs(there.area - moved.area) <= same_area * moved.area &&
                                        index_.base(face) == base_material(moved.material, surfaces_);
                             })
                     ? 1.0
                     : 0.0;
    }
    return all > 0.0 ? found / all : 0.0;
}

}  // namespace slipface
