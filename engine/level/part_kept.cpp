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

}  // namespace

std::optional<PartMotion> MotionFinder::motion_of_kept(std::span<const std::size_t> parts) {
    std::map<std::string, std::uint32_t> bases;
    using Sized = std::tuple<std::uint32_t, double, FaceId>;
    std::vector<Sized> sized;
    for (FaceId face = 0; face < mesh_.face_count(); ++face) {
        const auto base = static_cast<std::uint32_t>(bases.size());
        sized.emplace_back(bases.emplace(index_.base(face), base).first->second, index_.key(face).area, face);
    }
    std::sort(sized.begin(), sized.end());
    std::vector<bool> is_one(parts_.size() + 1, false);
    for (const std::size_t part : parts)
        is_one[part + 1] = true;
    std::vector<const FaceKey*> painted;
    for (std::size_t i = 0; i < overrides_.size() && i < stored_.of.size(); ++i)
        if (stored_.of[i] < is_one.size() && is_one[stored_.of[i]] && overrides_[i].key.area > 0.0)
            painted.push_back(&overrides_[i].key);
    std::vector<Rare> rare;
    const std::size_t step = painted.size() / max_painted + 1;
    for (std::size_t i = 0; i < painted.size(); i += step) {
        const FaceKey& key = *painted[i];
        const auto base = bases.find(base_material(key.material, surfaces_));
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

    const auto there = [&](FaceId face) -> const Vec3& { return index_.key(face).centroid; };
    const auto as_far = [&](const Rare& a, FaceId x, const Rare& b, FaceId y) {
        const double slack = 4.0 * (position_tolerance(a.key->centroid) + position_tolerance(there(x)));
        return std::abs((a.key->centroid - b.key->centroid).norm() - (there(x) - there(y)).norm()) <= slack;
    };
    const auto hits = [&](const PartMotion& motion, const Rare& one, FaceId face) {
        return (motion(one.key->centroid) - there(face)).norm() <=
                   8.0 * (position_tolerance(one.key->centroid) + position_tolerance(there(face))) &&
               index_.key(face).normal.dot(motion.linear * one.key->normal) > same_normal;
    };
    // The rigid motion of those that `rough` puts onto one of their faces.
    const auto fitted = [&](const PartMotion& rough, std::size_t& found) {
        std::vector<Vec3> from, to;
        for (const Rare& one : rare)
            for (const FaceId face : one.alike)
                if (hits(rough, one, face)) {
                    from.push_back(one.key->centroid);
                    to.push_back(there(face));
                    break;
                }
        found = from.size();
        return from.size() < 3 ? std::nullopt : fit_rigid(from, to);
    };
    struct Found {
        PartMotion motion;
        std::size_t faces;
    };
    std::vector<Found> found;
    std::size_t pairs = 0, tried = 0;
    const auto known = [&](const Rare& a, FaceId x, const Rare& b, FaceId y) {
        return std::any_of(found.begin(), found.end(), [&](const Found& one) {
            return hits(one.motion, a, x) && hits(one.motion, b, y);
        });
    };
    const auto try_three = [&](const Rare& a, FaceId x, const Rare& b, FaceId y) {
        if (++pairs > max_twos) return;
        for (const Rare& c : rare) {
            const Vec3 sides[] = {b.key->centroid - a.key->centroid, c.key->centroid - a.key->centroid};
            if (!(sides[0].cross(sides[1]).norm() > 0.1 * sides[0].norm() * sides[1].norm())) continue;
            for (const FaceId z : c.alike) {
                if (!as_far(a, x, c, z) || !as_far(b, y, c, z)) continue;
                if (++tried > max_threes) return;
                std::optional<PartMotion> motion = fit_rigid(
                    {a.key->centroid, b.key->centroid, c.key->centroid}, {there(x), there(y), there(z)});
                if (!motion || !hits(*motion, a, x) || !hits(*motion, b, y) || !hits(*motion, c, z)) continue;
                std::size_t faces = 0;
                motion = fitted(*motion, faces);
                if (motion) found.push_back({*motion, faces});
                if (motion) return;
            }
        }
    };
    for (std::size_t i = 0; i < rare.size() && tried < max_threes; ++i)
        for (std::size_t k = 0; k < i && tried < max_threes; ++k)
            for (const FaceId x : rare[i].alike)
                for (const FaceId y : rare[k].alike)
                    if (x != y && as_far(rare[i], x, rare[k], y) && !known(rare[i], x, rare[k], y))
                        try_three(rare[i], x, rare[k], y);
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.faces > b.faces; });
    if (found.size() > max_rated) found.resize(max_rated);

    std::vector<AreaMotion> motions;
    for (const Found& one : found)
        motions.push_back({one.motion, kept(painted, one.motion), 0.0});
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
