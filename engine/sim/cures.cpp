#include "slipface/sim/cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cure_candidates.h"
#include "trial.h"

namespace slipface {
namespace {

// What a change must make up for, as a fraction of what the stop took.
constexpr double made_up = 0.5;
// Less than this is no gain, and no cost.
constexpr double unseen_m = 0.01, cost_m = 0.1;
// Trials start this long before the stop, because a jump may start there, and end this long after its start.
constexpr double lead_s = 1.0, after_s = 1.5;
// The costs of a cure are looked for this long before the stop, and this long after the trial.
constexpr double cost_before_s = 15.0, cost_after_s = 5.0;
constexpr std::size_t max_cures = 6;
// Cure::bluntness of what removes something.
constexpr int removes = 5;
// A cure passes from this many starts, each later than the other by a part of a tick and aside by
// millimetres: what only shifts the timing is none.
constexpr int starts = 10;
constexpr double aside_m = 0.003;
// A number that passes from one start is made larger by as many of its steps until it passes from all.
constexpr std::array<int, 5> margins{0, 1, 2, 4, 8};

bool better(const Cure& a, const Cure& b) {
    if (a.passes != b.passes) return a.passes;
    if (a.passes) {
        if (a.cost.empty() != b.cost.empty()) return a.cost.empty();
        if (a.bluntness != b.bluntness) return a.bluntness < b.bluntness;
        if (a.change != b.change && a.bluntness > 0) return a.change < b.change;
    }
    return a.gained_m > b.gained_m;
}

class Search {
  public:
    Search(const Level& in, const TapeRun& of, const Stop& at, const std::function<bool()>& cancelled)
        : level_(in), run_(of), stop_(at), cancelled_(cancelled) {}

    std::vector<Cure> cures(std::vector<Cure> repairs) {
        if (!build()) return {};
        prepare();
        std::vector<CureCandidate> candidates =
            cure_candidates(level_, run_.settings_at(stop_.first), stop_, asked());
        for (Cure& repair : repairs)
            candidates.emplace_back().cure = std::move(repair);
        for (const CureCandidate& candidate : candidates)
            if (!is_redundant(candidate))
                candidate.numbers.empty() ? try_plain(candidate) : try_number(candidate);
        std::ranges::stable_sort(found_, better);
        if (found_.size() > max_cures) found_.resize(max_cures);
        const Trial as_is = play_long({});
        for (Cure& cure : found_)
            if (change_level(&cure)) weigh(cure, play_long(cure.settings), as_is);
        std::ranges::stable_sort(found_, better);
        // What helps a little, and what takes a thing out of the game, is of use only where nothing else is.
        if (!found_.empty() && found_.front().passes) {
            const bool gentle = found_.front().bluntness < removes;
            std::erase_if(found_, [&](const Cure& cure) {
                return !cure.passes || (gentle && cure.bluntness >= removes);
            });
        }
        return std::move(found_);
    }

  private:
    // The settings that refused what a button asked for, from where trials start to the stop.
    std::vector<std::string_view> asked() const {
        std::vector<std::string_view> names;
        for (std::size_t tick = std::max<std::size_t>(first_, 1); tick <= stop_.first; ++tick) {
            const ButtonSet now = run_.input_at(tick).buttons, before = run_.input_at(tick - 1).buttons;
            if ((now.bits & ~before.bits) == 0) continue;
            for (const TraceRecord& record : run_.trace(*scene_, tick).records) {
                const auto* decision = std::get_if<DecisionRecord>(&record);
                if (decision == nullptr) continue;
                const DecisionInfo& info = decision_info(decision->kind);
                if (info.outcome != Outcome::acted) names.emplace_back(info.hack);
            }
        }
        return names;
    }

    void prepare() {
        start_ = run_start(*scene_, run_.start());
        first_ = ticks_before(run_, std::min(stop_.first, stop_.left), lead_s);
        end_ = std::min(run_.length(), stop_.first + ticks_in(run_, after_s));
        const double stop_ticks = static_cast<double>(stop_.last - stop_.first + 1);
        const double seen = static_cast<double>(std::min(end_, stop_.last + 1) - stop_.first);
        lost_m_ = stop_.lost_m * seen / stop_ticks;
        if (was_sent_back()) {
            const PlayerInput input = run_.input_at(stop_.first);
            lost_m_ = run_.settings_at(stop_.first).walk_speed * input.wish.norm() * run_.dt() *
                      static_cast<double>(end_ - stop_.first);
            // A player that fell onto lower ground goes on there.
            if (stop_.fell_m > 0.0) lost_m_ = -cost_m;
            stayed_up_ = run_.samples()[stop_.first].position.y() + 0.5 * stop_.fell_m;
        }
        began_ = run_.state_before(*scene_, first_);
        long_before_ = run_.state_before(*scene_, ticks_before(run_, first_, cost_before_s));
        as_is_m_ = play({}).advanced_m;
    }

    // The stretch around the stop. `shift` 0: from where the player was; up to `starts`: from beside it.
    Trial play(const std::vector<std::string>& settings, int shift = 0) {
        Trial trial;
        trial.tick = first_;
        trial.end = end_;
        trial.settings = settings;
        trial.state = began_;
        if (shift > 0) {
            const Vec3 way = trial.state.velocity.cwiseProduct(Vec3(1.0, 0.0, 1.0)) * run_.dt();
            const double part = static_cast<double>(shift) / (starts + 1);
            trial.state.position -= part * way;
            if (!way.isZero(0.0))
                trial.state.position +=
                    (shift % 2 == 0 ? aside_m : -aside_m) * part * Vec3(-way.z(), 0.0, way.x()).normalized();
        }
        trial.advance(*scene_, run_, start_, cancelled_() ? 0 : run_.length());
        if (was_sent_back()) land(trial);
        return trial;
    }
    // A fall that has not ended yet is no rescue, nor is one onto lower ground.
    void land(Trial& trial) const {
        const double advanced = trial.advanced_m;
        trial.end = run_.length();
        while (!trial.done() && !is_held(trial.state))
            trial.advance(*scene_, run_, start_, cancelled_() ? 0 : 1);
        const bool fell = stop_.fell_m > 0.0 && scene_->to_level(trial.state).y() < stayed_up_;
        if (!trial.sent_back && (fell || !is_held(trial.state))) trial.sent_back = end_ - 1;
        trial.advanced_m = advanced;
    }
    bool was_sent_back() const { return stop_.loss.cause >= StopCause::hazard; }

    Trial play_long(const std::vector<std::string>& settings) {
        Trial trial;
        trial.tick = ticks_before(run_, first_, cost_before_s);
        trial.end = std::min(run_.length(), end_ + ticks_in(run_, cost_after_s));
        trial.mark = first_;
        trial.mark_end = end_;
        trial.settings = settings;
        trial.state = long_before_;
        trial.advance(*scene_, run_, start_, cancelled_() ? 0 : run_.length());
        return trial;
    }

    // The level is as the cure says, and as it was otherwise. False: it cannot be built so.
    bool change_level(const Cure* cure) {
        if (original_overrides_) {
            level_.overrides = *std::exchange(original_overrides_, std::nullopt);
            if (level_.surfaces.size() > original_types_) level_.surfaces.resize(original_types_);
            repaint();
        }
        if (original_mesh_) {
            level_.mesh = std::exchange(original_mesh_, nullptr);
            if (!build()) return false;
        }
        if (cure == nullptr) return true;
        if (cure->mesh) {
            original_mesh_ = level_.mesh;
            level_.mesh = cure->mesh;
            if (build()) return true;
            level_.mesh = std::exchange(original_mesh_, nullptr);
            return false;
        }
        if (cure->faces.empty()) return true;
        original_overrides_ = level_.overrides;
        original_types_ = level_.surfaces.size();
        (void)apply_cure(level_, *cure);
        repaint();
        return true;
    }
    bool build() {
        Result<LevelScene> result = LevelScene::build(level_, run_.settings());
        if (!result) return false;
        built_.emplace(std::move(*result));
        scene_.emplace(*built_);
        return true;
    }
    void repaint() {
        built_->apply_surfaces();
        scene_.emplace(*built_);
    }

    // A number whose switch alone lets the player pass is one change too many.
    bool is_redundant(const CureCandidate& c) const {
        return !c.with.empty() && std::ranges::any_of(found_, [&](const Cure& cure) {
            return cure.passes && cure.settings == c.with;
        });
    }

    // Who walks faster asks for more.
    double gain_of(const Trial& t) const {
        MovementSettings now = run_.settings_at(stop_.first);
        const double speed = now.walk_speed;
        for (const std::string& setting : t.settings)
            (void)set_setting(now, setting);
        return t.advanced_m * (now.walk_speed > speed && speed > 0.0 ? speed / now.walk_speed : 1.0) -
               as_is_m_;
    }
    bool passes(const Trial& t) const {
        const double gained = gain_of(t);
        const bool survives = !t.sent_back || (*t.sent_back >= end_ && !was_sent_back());
        // Of a player that stood still nothing more is asked.
        return survives && gained >= made_up * lost_m_ && (gained > unseen_m || !(lost_m_ > 0.0));
    }
    bool passes(const Cure& cure, int shift) { return passes(play(cure.settings, shift)); }
    bool passes_from_all_starts(const Cure& cure) {
        for (int shift = 1; shift <= starts; ++shift)
            if (!passes(cure, shift)) return false;
        return true;
    }

    // Kept if it passes, from all starts, or else if it gains something.
    void keep(Cure cure) {
        const Trial trial = play(cure.settings);
        cure.gained_m = gain_of(trial);
        cure.passes = passes(trial);
        const bool by_chance = cure.passes && !passes_from_all_starts(cure);
        if (!by_chance && (cure.passes || cure.gained_m > unseen_m)) found_.push_back(std::move(cure));
    }

    void try_plain(const CureCandidate& c) {
        if (change_level(&c.cure)) keep(c.cure);
        change_level(nullptr);
    }

    // The smallest change, in whole steps, that passes from all starts.
    void try_number(const CureCandidate& c) {
        if (!passes(number_cure(c, c.extreme), 0)) return keep(number_cure(c, c.extreme));
        const double way = c.extreme > c.now ? 1.0 : -1.0;
        // Steps of the value, counted in the direction in which it changes.
        const auto value = [&](double steps) {
            return way > 0.0 ? std::min(steps * c.step, c.extreme) : std::max(-steps * c.step, c.extreme);
        };
        double bad = std::floor(way * c.now / c.step + 1e-9),
               good = std::ceil(way * c.extreme / c.step - 1e-9);
        while (good - bad > 1.5) {
            const double middle = std::floor(0.5 * (good + bad));
            (passes(number_cure(c, value(middle)), 0) ? good : bad) = middle;
        }
        for (const int margin : margins) {
            const Cure cure = number_cure(c, value(good + margin));
            if (!passes(cure, 0) || !passes_from_all_starts(cure)) continue;
            return keep(cure);
        }
    }

    // What elsewhere on the tape pays for the cure.
    void weigh(Cure& cure, const Trial& t, const Trial& as_is) const {
        const bool survives = !t.sent_back || *t.sent_back >= end_;
        const double gained = t.at_mark_end_m - as_is.at_mark_end_m;
        const double before = t.advanced_before_m - as_is.advanced_before_m;
        if (!survives || gained - before < made_up * lost_m_) cure.passes = false;
        if (before < -cost_m) cure.cost = fmt::format("loses {:.2f} m earlier on the tape", -before);
        if (t.sent_back && !as_is.sent_back) {
            if (!cure.cost.empty()) cure.cost += ", ";
            cure.cost += fmt::format("the player is then sent back to the start at {:.2f} s",
                                     static_cast<double>(*t.sent_back) * run_.dt());
        }
    }

    Level level_;
    TapeRun run_;
    Stop stop_;
    std::function<bool()> cancelled_;
    std::optional<LevelScene> built_;
    std::optional<TickScene> scene_;
    RunStart start_;
    std::size_t first_ = 0, end_ = 0;
    PlayerState began_, long_before_;  // before the tick first_, and cost_before_s earlier
    double as_is_m_ = 0.0, lost_m_ = 0.0;
    double stayed_up_ = 0.0;  // of a fall: the height of the middle of a player that did not fall
    std::vector<Cure> found_;
    std::optional<decltype(Level::overrides)> original_overrides_;  // while faces are painted
    std::size_t original_types_ = 0;
    LevelMesh original_mesh_;  // while a repaired one is tried
};

}  // namespace

std::vector<Cure> find_cures(const Level& level, const TapeRun& run, const Stop& stop,
                             std::vector<Cure> repairs, const std::function<bool()>& cancelled) {
    return Search(level, run, stop, cancelled).cures(std::move(repairs));
}

Status apply_cure(Level& level, const Cure& cure) {
    for (const std::string& setting : cure.settings)
        if (Status status = set_setting(level.movement, setting); !status) return status;
    if (cure.mesh) {
        if (!level.mesh || cure.mesh->face_count() != level.mesh.face_count())
            return Error{"cure", "found a level with other faces than those that were repaired"};
        level.mesh = cure.mesh;
    }
    if (cure.faces.empty()) return {};
    const FaceId last = *std::max_element(cure.faces.begin(), cure.faces.end());
    if (!level.mesh || last >= level.mesh.face_count())
        return Error{"cure", fmt::format("found face {}, which the level does not have", last)};
    auto type = std::find(level.surfaces.begin(), level.surfaces.end(), cure.type);
    if (type == level.surfaces.end()) {
        if (level.surfaces.size() > std::numeric_limits<SurfaceId>::max())
            return Error{"cure", "found no room for one more surface type"};
        level.surfaces.push_back(cure.type);
        type = level.surfaces.end() - 1;
    }
    level.overrides.resize(std::max<std::size_t>(level.overrides.size(), last + 1));
    for (const FaceId face : cure.faces)
        level.overrides[face] = static_cast<SurfaceId>(type - level.surfaces.begin());
    return {};
}

std::string cure_text(const Cure& cure) {
    std::string text = cure.passes && cure.gained_m < unseen_m
                           ? cure.text + ": then it does not happen"
                           : fmt::format("{}: {:.2f} m further", cure.text, cure.gained_m);
    if (!cure.passes) text += ", but still stopped";
    if (!cure.cost.empty()) text += "; " + cure.cost;
    return text;
}

}  // namespace slipface
