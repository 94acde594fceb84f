#include "slipface/sim/recorded_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "slipface/sim/story.h"

namespace slipface {
namespace {

constexpr double stopped_below = 0.4, snagged_by = 0.3;  // of the wanted speed
constexpr double stop_s = 0.25, grace_s = 0.25, bridged_s = 0.06, recovers_s = 0.3;
constexpr double hop_m = 0.005, trembles_m = 0.001, creep_m = 0.02;
constexpr std::size_t trembles = 6;  // turns in half a second

// The motion of a run, and what the stick asked for in each tick.
struct RunMotion {
    const RecordedRun& run;
    double walk_speed = 6.0;
    std::vector<Vec3> velocity{};  // [tick], m/s; of tick 0 zero
    std::vector<Vec2> wish{};      // [tick], recorded, or guessed from the motion
    std::vector<double> since{};   // [tick] seconds for which the stick has not turned
    bool guessed = false;

    double dt(std::size_t tick) const { return run.ticks[tick].time_s - run.ticks[tick - 1].time_s; }
    double speed(std::size_t tick) const { return std::hypot(velocity[tick].x(), velocity[tick].z()); }
    double wanted(std::size_t tick) const { return walk_speed * std::min(1.0, wish[tick].norm()); }
    Vec3 heading(std::size_t tick) const {
        const Vec2 way = wish[tick].normalized();
        return {way.x(), 0.0, way.y()};
    }
    std::size_t size() const { return run.ticks.size(); }
};

double high_speed(std::vector<double> speeds) {
    if (speeds.empty()) return 0.0;
    const std::size_t at = speeds.size() * 9 / 10;
    std::nth_element(speeds.begin(), speeds.begin() + static_cast<std::ptrdiff_t>(at), speeds.end());
    return speeds[at];
}

RunMotion motion_of(const RecordedRun& run) {
    RunMotion m{.run = run};
    const std::size_t count = run.ticks.size();
    m.velocity.assign(count, Vec3::Zero());
    for (std::size_t i = 1; i < count; ++i)
        m.velocity[i] = (run.ticks[i].feet - run.ticks[i - 1].feet) / m.dt(i);
    m.guessed = std::none_of(run.ticks.begin(), run.ticks.end(),
                             [](const RecordedTick& t) { return t.wish.has_value(); });
    std::vector<double> speeds;
    for (std::size_t i = 1; i < count; ++i) {
        const double push = m.guessed ? 1.0 : run.ticks[i].wish.value_or(Vec2::Zero()).norm();
        if (push > 0.1) speeds.push_back(m.speed(i) / std::min(1.0, push));
    }
    m.walk_speed = run.walk_speed.value_or(std::max(0.1, high_speed(speeds)));
    m.wish.assign(count, Vec2::Zero());
    Vec2 held = Vec2::Zero();  // of a guess: goes on for a while after the player lost its speed
    double held_s = 0.0;
    for (std::size_t i = 1; i < count; ++i) {
        if (!m.guessed) {
            m.wish[i] = run.ticks[i].wish.value_or(Vec2::Zero());
            continue;
        }
        held_s += m.dt(i);
        if (m.speed(i) > 0.5 * m.walk_speed) {
            held = Vec2(m.velocity[i].x(), m.velocity[i].z()) / m.walk_speed;
            held_s = 0.0;
        }
        // A player that brakes lets go of the stick; one that is stopped loses its speed at once.
        const bool braked = i > 1 && m.speed(i - 1) <= 0.8 * m.walk_speed && m.speed(i) < m.speed(i - 1) &&
                            m.speed(i) > 0.2 * m.walk_speed && held_s > 0.0;
        if (held_s > 0.6 || braked) held = Vec2::Zero();
        m.wish[i] = held;
    }
    m.since.assign(count, 0.0);
    for (std::size_t i = 2; i < count; ++i) {
        const bool same = m.wish[i].norm() > 0.0 && m.wish[i - 1].norm() > 0.0 &&
                          m.wish[i].normalized().dot(m.wish[i - 1].normalized()) > 0.9;
        const bool rest = m.wish[i].norm() == 0.0 && m.wish[i - 1].norm() == 0.0;
        m.since[i] = same || rest ? m.since[i - 1] + m.dt(i) : 0.0;
    }
    return m;
}

// The level around a body that is taken for a capsule, as spheres one above the other.
class LevelAround {
  public:
    LevelAround(LevelScene& scene, const RecordedRun& run) : scene_(scene), run_(run) {}

    MovementScene at(std::size_t tick) {
        const double dt = tick == 0 ? 0.0 : run_.ticks[tick].time_s - run_.ticks[tick - 1].time_s;
        return scene_.at(std::max(0.0, run_.ticks[tick].time_s - dt), dt);
    }
    // The first contact that stands in the way.
    std::optional<Contact> in_the_way(std::size_t tick, const Vec3& feet, const Vec3& way, double far) {
        const MovementScene now = at(tick);
        std::optional<Contact> first;
        for (const Vec3& centre : spheres(feet)) {
            const Vec3 radii = Vec3::Constant(run_.radius);
            const auto look = [&](const std::optional<Contact>& hit) {
                if (hit && hit->normal.dot(way) < -0.1 && (!first || hit->t < first->t)) first = hit;
            };
            look(sweep_ellipsoid(now.collision, radii, centre, far * way));
            for (const MovingPart& part : now.platforms)
                look(sweep_ellipsoid(part.at_end(), radii, centre, far * way));
        }
        return first;
    }
    std::optional<RayHit> ground(std::size_t tick, const Vec3& feet, double depth) {
        const MovementScene now = at(tick);
        const Vec3 from = scene_.to_scene(feet) + Vec3(0.0, 0.5 * run_.height, 0.0);
        return ray(now, from, Vec3(0.0, -1.0, 0.0), 0.5 * run_.height + depth);
    }
    std::optional<RayHit> between(std::size_t tick, const Vec3& a, const Vec3& b) {
        const Vec3 middle = scene_.to_scene(Vec3(0.0, 0.5 * run_.height, 0.0));
        const MovementScene now = at(tick);
        // What moves is asked where it ends; a platform that carries the player is not crossed.
        return cast_ray(now.collision, a + middle, b - a, 1.0, RayStops::as_movement);
    }
    // Faces that the body nearly touches, the steepest first.
    std::vector<FaceId> touched(std::size_t tick, const Vec3& feet) {
        const MovementScene now = at(tick);
        std::vector<std::pair<double, FaceId>> found;
        std::vector<Overlap> overlaps(64);
        for (const Vec3& centre : spheres(feet)) {
            const std::size_t count =
                std::min(overlaps.size(),
                         find_overlaps(now.collision, Vec3::Constant(run_.radius + 0.06), centre, overlaps));
            for (const Overlap& overlap : std::span(overlaps).first(count))
                found.emplace_back(std::abs(overlap.normal.y()), overlap.face);
        }
        std::ranges::sort(found);
        std::vector<FaceId> faces;
        for (const auto& [steep, face] : found)
            if (std::ranges::find(faces, face) == faces.end()) faces.push_back(face);
        return faces;
    }
    // The edge of ground triangles that is nearest to a point of the ground, with the faces on both sides.
    struct Seam {
        FaceId face = no_id, other = no_id;
        Vec3 point = Vec3::Zero();
    };
    Seam seam(std::size_t tick, const Vec3& feet) {
        const MovementScene now = at(tick);
        const Vec3 foot = scene_.to_scene(feet), reach = Vec3(0.5, 0.15, 0.5);
        std::vector<std::pair<double, FaceId>> near;
        Seam seam;
        double best = 1e9;
        for (const TriangleId id : now.collision.triangles_in({foot - reach, foot + reach})) {
            if (now.collision.triangle_normal(id).y() < 0.3) continue;
            const std::array<Vec3, 3> corners = now.collision.triangle(id);
            double nearest = 1e9;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 a = corners[k], along = corners[(k + 1) % 3] - a;
                const double length = along.squaredNorm();
                const double t = length > 0.0 ? std::clamp((foot - a).dot(along) / length, 0.0, 1.0) : 0.0;
                const double distance = (a + t * along - foot).norm();
                if (distance >= nearest) continue;
                nearest = distance;
                if (distance < best) seam.point = a + t * along;
            }
            best = std::min(best, nearest);
            near.emplace_back(nearest, now.collision.triangle_face(id));
        }
        std::ranges::sort(near);
        for (const auto& [distance, face] : near) {
            if (seam.face == no_id)
                seam.face = face;
            else if (face != seam.face && seam.other == no_id)
                seam.other = face;
        }
        return seam;
    }
    Vec3 to_level(const Vec3& in_scene) const { return in_scene - scene_.offset(); }

  private:
    std::vector<Vec3> spheres(const Vec3& feet) const {
        std::vector<Vec3> centres;
        const double low = run_.radius, high = run_.height - run_.radius;
        const int count = 1 + static_cast<int>(std::ceil((high - low) / (0.5 * run_.radius)));
        const int most = std::min(count, 200);
        for (int i = 0; i < most; ++i)
            centres.push_back(scene_.to_scene(feet) +
                              Vec3(0.0, low + (high - low) * i / std::max(1, most - 1), 0.0));
        return centres;
    }
    static std::optional<RayHit> ray(const MovementScene& now, const Vec3& from, const Vec3& way,
                                     double far) {
        std::optional<RayHit> first = cast_ray(now.collision, from, way, far, RayStops::as_movement);
        for (const MovingPart& part : now.platforms) {
            const auto hit = cast_ray(part.at_end(), from, way, far, RayStops::as_movement);
            if (hit && (!first || hit->t < first->t)) first = hit;
        }
        return first;
    }
    LevelScene& scene_;
    const RecordedRun& run_;
};

class FaultFinder {
  public:
    FaultFinder(const Level& level, LevelScene& scene, const RecordedRun& run)
        : level_(level), names_(level), run_(run), m_(motion_of(run)), around_(scene, run) {}

    const RunMotion& motion() const { return m_; }

    std::vector<RecordedFault> find() {
        losses();
        hops();
        jitters();
        creeps();
        ways_out();
        // A player that trembles at a wall or fell through it has stopped, too: the nearer cause counts.
        std::ranges::stable_sort(faults_, {}, &RecordedFault::first);
        return std::move(faults_);
    }

  private:
    const Vec3& feet(std::size_t tick) const { return run_.ticks[tick].feet; }
    bool covered(std::size_t tick) const {
        return std::ranges::any_of(
            faults_, [&](const RecordedFault& f) { return tick + 2 >= f.first && tick <= f.last + 2; });
    }
    std::string thing(FaceId face) const { return thing_text(names_, face); }

    bool is_slow(std::size_t i) const {
        const double wanted = m_.wanted(i);
        return wanted > 0.05 * m_.walk_speed && m_.since[i] >= grace_s &&
               m_.speed(i) < stopped_below * wanted;
    }
    // The speed of the ticks just before, if it is steady.
    double speed_before(std::size_t i) const {
        double least = 1e9;
        for (std::size_t k = i - std::min<std::size_t>(i, 4); k < i; ++k)
            if (k > 0) least = std::min(least, m_.speed(k));
        return least > 1e8 ? 0.0 : least;
    }
    bool is_drop(std::size_t i) const {
        const double wanted = m_.wanted(i), before = speed_before(i);
        if (wanted == 0.0 || m_.since[i] < grace_s || before < 0.5 * wanted) return false;
        if (before - m_.speed(i) < snagged_by * wanted) return false;
        for (std::size_t k = i + 1; k < m_.size() && run_.ticks[k].time_s - run_.ticks[i].time_s < recovers_s;
             ++k)
            if (m_.speed(k) > 0.8 * before) return true;
        return false;
    }

    void losses() {
        for (std::size_t i = 2; i < m_.size(); ++i) {
            if (!is_slow(i) && !is_drop(i)) continue;
            std::size_t last = i;
            for (std::size_t k = i + 1;
                 k < m_.size() && run_.ticks[k].time_s - run_.ticks[last].time_s <= bridged_s + m_.dt(k); ++k)
                if (is_slow(k) || m_.speed(k) < 0.6 * speed_before(i)) last = k;
            const double lasts = run_.ticks[last].time_s - run_.ticks[i - 1].time_s;
            const double before = std::max(speed_before(i), 0.0);
            double least = m_.speed(i);
            for (std::size_t k = i; k <= last; ++k)
                least = std::min(least, m_.speed(k));
            RecordedFault fault{
                .kind = lasts >= stop_s ? FaultKind::stop : FaultKind::snag, .first = i, .last = last};
            const double from = fault.kind == FaultKind::stop ? std::max(before, m_.wanted(i)) : before;
            fault.lost_m_s = from - least;
            blame_way(fault, fmt::format("your controller loses {:.1f} of {:.1f} m/s", fault.lost_m_s, from));
            faults_.push_back(std::move(fault));
            i = last + 1;
        }
    }

    void blame_way(RecordedFault& fault, const std::string& what) {
        const std::size_t at = fault.first - 1;
        const Vec3 way = m_.heading(fault.first);
        const double far = std::max(0.15, 3.0 * m_.wanted(fault.first) * m_.dt(fault.first));
        const std::optional<Contact> hit = around_.in_the_way(at, feet(at), way, far);
        if (!hit) return blame_seam(fault, what);
        const Vec3 point = around_.to_level(hit->point);
        const double height = point.y() - feet(at).y();
        fault.face = hit->face;
        fault.position = point;
        const double slope = std::acos(std::clamp(hit->normal.y(), -1.0, 1.0)) * 180.0 / std::numbers::pi;
        const std::string of = thing(hit->face);
        if (hit->feature == Feature::interior)
            fault.text = fmt::format("{} at {}, {}", what, of,
                                     slope > 100.0 ? fmt::format("which leans over by {:.0f}°", slope - 90.0)
                                     : slope > 80.0 ? std::string("an upright face")
                                                    : fmt::format("which slopes {:.0f}°", slope));
        else if (slope > 100.0)
            fault.text =
                fmt::format("{} at an edge of {} that hangs {} above the feet", what, of, size_text(height));
        else
            fault.text = fmt::format("{} at the {} {} of {}", what, size_text(std::max(0.0, height)),
                                     hit->feature == Feature::edge ? "edge" : "corner", of);
    }
    void blame_seam(RecordedFault& fault, const std::string& what) {
        const LevelAround::Seam seam = around_.seam(fault.first, feet(fault.first));
        fault.face = seam.face;
        fault.other = seam.other;
        fault.position = seam.face == no_id ? feet(fault.first) : around_.to_level(seam.point);
        if (seam.face == no_id)
            fault.text = what + ", and nothing is in the way";
        else if (seam.other == no_id)
            fault.text =
                fmt::format("{} at an edge inside {}, and nothing is in the way", what, thing(seam.face));
        else
            fault.text = fmt::format("{} at the seam of {} and {}, and nothing is in the way", what,
                                     thing(seam.face), thing(seam.other));
    }

    void hops() {
        for (std::size_t i = 2; i + 1 < m_.size(); ++i) {
            if (run_.ticks[i].jump || covered(i) || m_.speed(i) < 0.2 * m_.walk_speed) continue;
            if (!(feet(i).y() - feet(i - 1).y() > hop_m) || feet(i - 1).y() - feet(i - 2).y() > hop_m)
                continue;
            std::size_t end = i + 1;
            double top = feet(i).y();
            while (end < m_.size() && feet(end).y() > feet(i - 1).y() + 0.4 * hop_m &&
                   run_.ticks[end].time_s - run_.ticks[i].time_s < 1.0)
                top = std::max(top, feet(end++).y());
            if (end >= m_.size() || feet(end).y() > feet(i - 1).y() + 0.4 * hop_m) continue;
            if (!flat(i - 1, end, 0.5 * (top - feet(i - 1).y()))) continue;
            RecordedFault fault{.kind = FaultKind::hop, .first = i, .last = end};
            fault.lost_m_s = top - feet(i - 1).y();
            blame_seam(fault, fmt::format("your controller hops {}", size_text(fault.lost_m_s)));
            faults_.push_back(std::move(fault));
            i = end;
        }
    }
    // Whether the ground below varies by less than `most` metres.
    bool flat(std::size_t first, std::size_t last, double most) {
        double low = 1e9, high = -1e9;
        for (const std::size_t tick : {first, (first + last) / 2, last}) {
            const auto ground = around_.ground(tick, feet(tick), 2.0);
            if (!ground || ground->normal.y() < 0.99) return false;
            const double y = around_.to_level(ground->point).y();
            low = std::min(low, y), high = std::max(high, y);
        }
        return high - low < most;
    }

    void jitters() {
        std::vector<std::size_t> turns;
        for (std::size_t i = 2; i < m_.size(); ++i) {
            const Vec3 a = feet(i - 1) - feet(i - 2), b = feet(i) - feet(i - 1);
            if (m_.since[i] >= grace_s && a.dot(b) < 0.0 && a.norm() > trembles_m && b.norm() > trembles_m)
                turns.push_back(i);
        }
        for (std::size_t k = 0; k + trembles <= turns.size(); ++k) {
            if (run_.ticks[turns[k + trembles - 1]].time_s - run_.ticks[turns[k]].time_s > 0.5) continue;
            std::size_t end = k + trembles - 1;
            while (end + 1 < turns.size() &&
                   run_.ticks[turns[end + 1]].time_s - run_.ticks[turns[end]].time_s < 0.2)
                ++end;
            RecordedFault fault{.kind = FaultKind::jitter, .first = turns[k], .last = turns[end]};
            for (std::size_t i = fault.first; i <= fault.last; ++i)
                fault.lost_m_s = std::max(fault.lost_m_s, (feet(i) - feet(i - 1)).norm());
            const std::vector<FaceId> faces = around_.touched(fault.first, feet(fault.first));
            fault.position = feet(fault.first);
            if (!faces.empty()) fault.face = faces[0];
            if (faces.size() > 1) fault.other = faces[1];
            fault.text = fmt::format("your controller trembles by {}{}{}", size_text(fault.lost_m_s),
                                     fault.face == no_id ? std::string() : " at " + thing(fault.face),
                                     fault.other == no_id ? std::string() : " and " + thing(fault.other));
            // A stop at the same place is the same thing.
            std::erase_if(faults_, [&](const RecordedFault& f) {
                return f.kind == FaultKind::snag && f.first <= fault.last && f.last >= fault.first;
            });
            faults_.push_back(std::move(fault));
            k = end;
        }
    }

    void creeps() {
        if (m_.guessed) return;
        for (std::size_t i = 1; i < m_.size(); ++i) {
            if (m_.wish[i].norm() > 0.0 || m_.since[i] < 0.5) continue;
            std::size_t end = i;
            while (end + 1 < m_.size() && m_.wish[end + 1].norm() == 0.0)
                ++end;
            const Vec3 moved = feet(end) - feet(i);
            const auto ground = around_.ground(i, feet(i), 0.3);
            const bool small =
                moved.norm() < 0.5 * m_.walk_speed * (run_.ticks[end].time_s - run_.ticks[i].time_s);
            if (ground && small && moved.norm() > creep_m && !covered(i)) {
                RecordedFault fault{.kind = FaultKind::creep, .first = i, .last = end};
                fault.lost_m_s = moved.norm();
                fault.face = ground->face;
                fault.position = around_.to_level(ground->point);
                const double slope = std::acos(std::min(1.0, ground->normal.y())) * 180.0 / std::numbers::pi;
                fault.text = fmt::format(
                    "your controller creeps {} in {:.1f} s without the stick, on {}, which slopes {:.0f}°",
                    size_text(fault.lost_m_s), run_.ticks[end].time_s - run_.ticks[i].time_s,
                    thing(fault.face), slope);
                faults_.push_back(std::move(fault));
            }
            i = end;
        }
    }

    void ways_out() {
        std::optional<std::size_t> out;
        const double lowest = level_.fall_limit.value_or(level_.mesh.bounds().min.y() - 2.0);
        std::size_t stood = 0;
        for (std::size_t i = 1; i < m_.size(); ++i) {
            if (!out)
                if (const auto hit = around_.between(i, feet(i - 1), feet(i))) {
                    out = i;
                    RecordedFault fault{.kind = FaultKind::through,
                                        .first = i,
                                        .last = i,
                                        .face = hit->face,
                                        .position = around_.to_level(hit->point)};
                    fault.lost_m_s = m_.velocity[i].norm();
                    fault.text =
                        fmt::format("your controller passes through {} at {:.1f} m/s{}", thing(hit->face),
                                    fault.lost_m_s, hit->back_face ? ", from behind" : "");
                    faults_.push_back(std::move(fault));
                }
            if (around_.ground(i, feet(i), 0.2)) stood = i;
            if (feet(i).y() >= lowest) continue;
            if (!out) {
                RecordedFault fault{
                    .kind = FaultKind::fall, .first = std::max<std::size_t>(stood, 1), .last = i};
                const LevelAround::Seam edge = around_.seam(stood, feet(stood));
                fault.face = edge.face;
                fault.position = feet(stood);
                fault.text = fmt::format("your controller falls out of the level{}",
                                         edge.face == no_id ? std::string() : " past " + thing(edge.face));
                faults_.push_back(std::move(fault));
            }
            break;
        }
        // What comes after it is no news.
        if (out) std::erase_if(faults_, [&](const RecordedFault& f) { return f.first > *out; });
    }

    const Level& level_;
    StoryNames names_;
    const RecordedRun& run_;
    RunMotion m_;
    LevelAround around_;
    std::vector<RecordedFault> faults_;
};

// Slipface's mover from half a second before the fault to half a second after it.
void compare(const Level& level, LevelScene& scene, const RunMotion& m, MovementSettings settings,
             RecordedFault& fault) {
    settings.radii = {m.run.radius, 0.5 * m.run.height, m.run.radius};
    settings.walk_speed = m.walk_speed;
    std::size_t begin = fault.first - 1, end = fault.last;
    const auto time = [&](std::size_t tick) { return m.run.ticks[tick].time_s; };
    while (begin > 0 && time(fault.first) - time(begin) < 0.5)
        --begin;
    while (end + 1 < m.size() && time(end) - time(fault.last) < 0.5)
        ++end;
    RecordedRun ghost{.radius = m.run.radius, .height = m.run.height, .walk_speed = m.walk_speed};
    const Vec3 middle(0.0, settings.radii.y(), 0.0);
    PlayerState state = scene.player_at(m.run.ticks[begin].feet + middle);
    state.velocity = begin == 0 ? Vec3::Zero() : m.velocity[begin];
    for (std::size_t i = begin; i <= end; ++i) {
        if (i > begin) {
            const double dt = m.dt(i);
            const PlayerInput input{.wish = m.wish[i], .buttons = {Button::jump, m.run.ticks[i].jump}};
            state = step(scene.at(std::max(0.0, time(i) - dt), dt), settings, state, input, dt).state;
        }
        const Vec3 feet = scene.to_level(state) - middle;
        if (!fault.differs_at && (feet - m.run.ticks[i].feet).norm() > 0.05) fault.differs_at = i;
        ghost.ticks.push_back(
            {.time_s = time(i), .feet = feet, .wish = m.wish[i], .jump = m.run.ticks[i].jump});
    }
    if (ghost.ticks.size() < 3) return;
    const std::vector<RecordedFault> own = FaultFinder(level, scene, ghost).find();
    // Of its own faults count those at the same time that are of the same kind, or end the way as well.
    fault.slipface_passes = !std::ranges::any_of(own, [&](const RecordedFault& f) {
        const bool there = f.last + begin + 3 >= fault.first && f.first + begin <= fault.last + 3;
        return there && (f.kind == fault.kind || f.kind == FaultKind::stop || f.kind == FaultKind::through ||
                         f.kind == FaultKind::fall);
    });
}

}  // namespace

const char* fault_name(FaultKind kind) {
    switch (kind) {
        case FaultKind::stop: return "stop";
        case FaultKind::snag: return "snag";
        case FaultKind::hop: return "hop";
        case FaultKind::jitter: return "jitter";
        case FaultKind::creep: return "creep";
        case FaultKind::through: return "through";
        case FaultKind::fall: return "fall";
    }
    return "";
}

std::vector<RecordedFault> find_recorded_faults(const Level& level, LevelScene& scene, const RecordedRun& run,
                                                const MovementSettings& settings) {
    FaultFinder finder(level, scene, run);
    std::vector<RecordedFault> faults = finder.find();
    for (RecordedFault& fault : faults)
        compare(level, scene, finder.motion(), settings, fault);
    return faults;
}

std::string compared_text(const RecordedFault& fault) {
    std::string text = fault.slipface_passes ? "Slipface passes" : "Slipface does not pass either";
    if (fault.differs_at) text += fmt::format("; differs at tick {}", *fault.differs_at);
    return text;
}

Tape tape_of(const RecordedRun& run) {
    const RunMotion motion = motion_of(run);
    std::vector<double> durations;
    for (std::size_t i = 1; i < motion.size(); ++i)
        durations.push_back(motion.dt(i));
    const auto middle = durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2);
    std::nth_element(durations.begin(), middle, durations.end());
    Tape tape;
    tape.dt = *middle;
    tape.dt_text = fmt::format("{}", tape.dt);
    tape.start = run.ticks.front().feet + Vec3(0.0, 0.5 * run.height, 0.0);
    tape.settings = {fmt::format("radius_x={}", run.radius), fmt::format("radius_y={}", 0.5 * run.height),
                     fmt::format("radius_z={}", run.radius), fmt::format("walk_speed={}", motion.walk_speed)};
    // Each tick of the tape has the input of the recorded tick in its middle.
    std::size_t at = 1;
    const double begin = run.ticks.front().time_s, end = run.ticks.back().time_s;
    for (std::size_t i = 0; begin + (static_cast<double>(i) + 0.5) * tape.dt < end && i < max_recorded_ticks;
         ++i) {
        while (run.ticks[at].time_s < begin + (static_cast<double>(i) + 0.5) * tape.dt)
            ++at;
        append_tick(tape, {.wish = motion.wish[at], .buttons = {Button::jump, run.ticks[at].jump}});
    }
    return tape;
}

}  // namespace slipface
