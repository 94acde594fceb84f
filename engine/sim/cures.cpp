#include "slipface/sim/cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cure_candidates.h"

namespace slipface {
namespace {

// What a change must make up for, as a fraction of what the stop took.
constexpr double made_up = 0.5;
constexpr int bisections = 12;
// Less than this is no gain, and no cost.
constexpr double unseen_m = 0.01, cost_m = 0.1;

// A stretch of the tape run with a change. Ends where the player is sent back to the start.
struct Trial {
    std::size_t tick = 0, end = 0;
    std::vector<std::string> settings;
    PlayerState state;

    double advanced_m = 0.0;         // towards the stick
    double advanced_before_m = 0.0;  // of it before the tick `mark`
    double at_mark_end_m = 0.0;      // until the tick `mark_end`
    std::size_t mark = 0, mark_end = 0;
    std::optional<std::size_t> sent_back;

    bool done() const { return tick >= end || sent_back; }

    std::size_t advance(const TickScene& scene, const TapeRun& run, const RunStart& start,
                        std::size_t ticks) {
        std::size_t used = 0;
        for (; used < ticks && !done(); ++used, ++tick) {
            if (tick == mark) advanced_before_m = advanced_m;
            MovementSettings now = run.settings_at(tick);
            for (const std::string& change : settings)
                (void)set_setting(now, change);
            const PlayerInput input = run.input_at(tick);
            const TickResult result = play_tick(scene.at(tick, run.dt()), now, state, input, run.dt(), start);
            const Vec3 moved = scene.to_level(result.stepped) - scene.to_level(state);
            const Vec3 requested(input.wish.x(), 0.0, input.wish.y());
            if (!requested.isZero(0.0)) advanced_m += moved.dot(requested) / requested.norm();
            // The stick into a ladder asks for height.
            if (state.climbing && moved.y() > 0.0) advanced_m += moved.y();
            if (tick < mark_end) at_mark_end_m = advanced_m;
            if (result.respawn != Respawn::none) sent_back = tick;
            state = result.state;
        }
        return used;
    }
};

bool better(const Cure& a, const Cure& b) {
    if (a.passes != b.passes) return a.passes;
    if (a.passes) {
        if (a.cost.empty() != b.cost.empty()) return a.cost.empty();
        if (a.bluntness != b.bluntness) return a.bluntness < b.bluntness;
        if (a.change != b.change && a.bluntness > 0) return a.change < b.change;
    }
    return a.gained_m > b.gained_m;
}

}  // namespace

struct CureSearch::Impl {
    Impl(const Level& in, const TapeRun& of, const Stop& at) : level(in), run(of), stop(at) {}

    Level level;
    TapeRun run;
    Stop stop;
    std::optional<LevelScene> built;
    std::optional<TickScene> scene;
    RunStart start;
    PlayerState began;
    std::size_t first = 0, end = 0;
    bool sent_back = false;  // the stop is that the player was sent back

    std::vector<Cure> repairs;
    std::vector<CureCandidate> candidates;
    std::size_t index = 0;
    std::optional<Trial> trial;
    enum class Phase { as_is, whole_as_is, plain, extreme, bisecting, rounded, whole, finished };
    Phase phase = Phase::as_is;
    double bad = 0.0, good = 0.0;
    int rounds = 0;
    Cure trying;
    double as_is_m = 0.0, lost_m = 0.0;
    Trial whole_as_is;
    std::vector<Cure> found;
    FaceId painted = no_id;
    std::optional<SurfaceId> painted_over;

    void begin() {
        if (!build()) {
            phase = Phase::finished;
            return;
        }
        start = run_start(*scene, run.start());
        const auto ticks = [&](double seconds) {
            return static_cast<std::size_t>(std::ceil(seconds / run.dt()));
        };
        first = stop.first - std::min(stop.first, ticks(lead_s));
        // Not across an earlier way back to the start.
        for (std::size_t tick = first; tick < stop.first; ++tick)
            if (run.samples()[tick].respawned) first = tick + 1;
        end = std::min(run.length(), stop.first + ticks(after_s));
        sent_back = stop.loss.cause >= StopCause::hazard;
        const double stop_ticks = static_cast<double>(stop.last - stop.first + 1);
        const double seen = static_cast<double>(std::min(end, stop.last + 1) - stop.first);
        lost_m = stop.lost_m * seen / stop_ticks;
        if (sent_back) {
            const PlayerInput input = run.input_at(stop.first);
            lost_m = run.settings_at(stop.first).walk_speed * input.wish.norm() * run.dt() *
                     static_cast<double>(end - stop.first);
        }
        began = run.state_before(*scene, first);
        candidates = cure_candidates(level, run.settings_at(stop.first), stop.loss);
        for (Cure& repair : repairs)
            candidates.emplace_back().cure = std::move(repair);
        start_near({});
    }

    void start_near(std::vector<std::string> settings) {
        trial.emplace();
        trial->tick = first;
        trial->end = end;
        trial->mark_end = end;
        trial->settings = std::move(settings);
        trial->state = began;
    }

    void start_whole(std::vector<std::string> settings) {
        trial.emplace();
        trial->end = run.length();
        trial->settings = std::move(settings);
        trial->state = start.player;
        trial->mark = first;
        trial->mark_end = end;
    }

    // The level is as the cure that is tried says, and as it was otherwise. False: it cannot be built so.
    bool change_level(const Cure* cure) {
        if (painted != no_id) {
            level.overrides[painted] = painted_over;
            if (level.surfaces.size() > original_types) level.surfaces.resize(original_types);
            painted = no_id;
            repaint();
        }
        if (original_mesh) {
            level.mesh = std::exchange(original_mesh, nullptr);
            if (!build()) return false;
        }
        if (cure == nullptr) return true;
        if (cure->mesh) {
            original_mesh = level.mesh;
            level.mesh = cure->mesh;
            if (build()) return true;
            level.mesh = std::exchange(original_mesh, nullptr);
            return false;
        }
        if (cure->face == no_id) return true;
        painted = cure->face;
        level.overrides.resize(std::max<std::size_t>(level.overrides.size(), painted + 1));
        painted_over = level.overrides[painted];
        original_types = level.surfaces.size();
        (void)apply_cure(level, *cure);
        repaint();
        return true;
    }
    std::size_t original_types = 0;
    LevelMesh original_mesh;  // while a repaired one is tried
    bool build() {
        Result<LevelScene> result = LevelScene::build(level, run.settings());
        if (!result) return false;
        built.emplace(std::move(*result));
        scene.emplace(*built);
        return true;
    }
    void repaint() {
        built->apply_surfaces();
        scene.emplace(*built);
    }

    // A number whose switch alone lets the player pass is one change too many.
    bool is_redundant(const CureCandidate& c) const {
        return !c.with.empty() && std::any_of(found.begin(), found.end(), [&](const Cure& cure) {
            return cure.passes && cure.settings == c.with;
        });
    }

    void judge(Cure& cure, const Trial& t) const {
        cure.gained_m = t.advanced_m - as_is_m;
        const bool survives = !t.sent_back || *t.sent_back >= end;
        cure.passes = survives && cure.gained_m >= made_up * lost_m && cure.gained_m > unseen_m;
    }

    void keep(const Cure& cure) {
        if (cure.passes || cure.gained_m > unseen_m) found.push_back(cure);
    }

    // The next candidate, or the checks on the whole tape.
    void next_candidate() {
        change_level(nullptr);
        if (index >= candidates.size()) {
            std::stable_sort(found.begin(), found.end(), better);
            if (found.size() > CureSearch::maximum) found.resize(CureSearch::maximum);
            index = 0;
            return next_whole();
        }
        const CureCandidate& c = candidates[index];
        if (is_redundant(c)) {
            ++index;
            return next_candidate();
        }
        if (c.numbers.empty()) {
            trying = c.cure;
            phase = Phase::plain;
            if (!change_level(&trying)) {
                ++index;
                return next_candidate();
            }
        } else {
            trying = number_cure(c, c.extreme);
            bad = c.now;
            good = c.extreme;
            rounds = 0;
            phase = Phase::extreme;
        }
        start_near(trying.settings);
    }

    void next_whole() {
        change_level(nullptr);
        if (index >= found.size()) {
            std::stable_sort(found.begin(), found.end(), better);
            // What helps a little is of use only where nothing else does.
            if (!found.empty() && found.front().passes)
                std::erase_if(found, [](const Cure& cure) { return !cure.passes; });
            phase = Phase::finished;
            trial.reset();
            return;
        }
        phase = Phase::whole;
        change_level(&found[index]);
        start_whole(found[index].settings);
    }

    void bisect(const CureCandidate& c) {
        if (std::abs(good - bad) <= c.step || ++rounds > bisections) {
            // To the next whole step on the side that passes.
            const double steps = good / c.step;
            const double rounded =
                (good > c.now ? std::ceil(steps - 1e-9) : std::floor(steps + 1e-9)) * c.step;
            const bool beyond = good > c.now ? rounded > c.extreme : rounded < c.extreme;
            phase = Phase::rounded;
            trying = number_cure(c, beyond ? good : rounded);
        } else {
            phase = Phase::bisecting;
            trying = number_cure(c, 0.5 * (good + bad));
        }
        start_near(trying.settings);
    }

    // What elsewhere on the tape pays for the cure.
    void weigh(Cure& cure, const Trial& t) const {
        const bool survives = !t.sent_back || *t.sent_back >= end;
        const double gained = t.at_mark_end_m - whole_as_is.at_mark_end_m;
        const double before = t.advanced_before_m - whole_as_is.advanced_before_m;
        if (!survives || gained - before < made_up * lost_m) cure.passes = false;
        if (before < -cost_m) cure.cost = fmt::format("loses {:.2f} m earlier on the tape", -before);
        if (t.sent_back && !whole_as_is.sent_back) {
            if (!cure.cost.empty()) cure.cost += ", ";
            cure.cost += fmt::format("the player is then sent back to the start at {:.2f} s",
                                     static_cast<double>(*t.sent_back) * run.dt());
        }
    }

    void trial_done() {
        const Trial t = *trial;
        switch (phase) {
            case Phase::as_is:
                as_is_m = t.advanced_m;
                phase = Phase::whole_as_is;
                return start_whole({});
            case Phase::whole_as_is: whole_as_is = t; return next_candidate();
            case Phase::plain:
                judge(trying, t);
                keep(trying);
                ++index;
                return next_candidate();
            case Phase::extreme:
                judge(trying, t);
                if (trying.passes) return bisect(candidates[index]);
                keep(trying);
                ++index;
                return next_candidate();
            case Phase::bisecting: {
                judge(trying, t);
                (trying.passes ? good : bad) = 0.5 * (good + bad);
                return bisect(candidates[index]);
            }
            case Phase::rounded:
                judge(trying, t);
                keep(trying);
                ++index;
                return next_candidate();
            case Phase::whole:
                weigh(found[index], t);
                ++index;
                return next_whole();
            case Phase::finished: return;
        }
    }
};

CureSearch::CureSearch(const Level& level, const TapeRun& run, const Stop& stop, std::vector<Cure> repairs)
    : impl_(std::make_unique<Impl>(level, run, stop)) {
    impl_->repairs = std::move(repairs);
}
CureSearch::~CureSearch() = default;
CureSearch::CureSearch(CureSearch&&) noexcept = default;
CureSearch& CureSearch::operator=(CureSearch&&) noexcept = default;

bool CureSearch::done() const {
    return impl_->phase == Impl::Phase::finished;
}

bool CureSearch::advance(std::size_t ticks) {
    Impl& impl = *impl_;
    if (!impl.built && !done()) impl.begin();
    while (!done()) {
        if (impl.trial->done()) {
            impl.trial_done();
            continue;
        }
        if (ticks == 0) break;
        ticks -= std::min(ticks, impl.trial->advance(*impl.scene, impl.run, impl.start, ticks));
    }
    return done();
}

const std::vector<Cure>& CureSearch::cures() const {
    static const std::vector<Cure> none;
    return done() ? impl_->found : none;
}

Status apply_cure(Level& level, const Cure& cure) {
    for (const std::string& setting : cure.settings)
        if (Status status = set_setting(level.movement, setting); !status) return status;
    if (cure.mesh) {
        if (!level.mesh || cure.mesh->face_count() != level.mesh.face_count())
            return Error{"cure", "found a level with other faces than those that were repaired"};
        level.mesh = cure.mesh;
    }
    if (cure.face == no_id) return {};
    if (!level.mesh || cure.face >= level.mesh.face_count())
        return Error{"cure", fmt::format("found face {}, which the level does not have", cure.face)};
    auto type = std::find(level.surfaces.begin(), level.surfaces.end(), cure.type);
    if (type == level.surfaces.end()) {
        if (level.surfaces.size() > std::numeric_limits<SurfaceId>::max())
            return Error{"cure", "found no room for one more surface type"};
        level.surfaces.push_back(cure.type);
        type = level.surfaces.end() - 1;
    }
    level.overrides.resize(std::max<std::size_t>(level.overrides.size(), cure.face + 1));
    level.overrides[cure.face] = static_cast<SurfaceId>(type - level.surfaces.begin());
    return {};
}

std::string cure_text(const Cure& cure) {
    std::string text = fmt::format("{}: {:.2f} m further", cure.text, cure.gained_m);
    if (!cure.passes) text += ", but still stopped";
    if (!cure.cost.empty()) text += "; " + cure.cost;
    return text;
}

}  // namespace slipface
