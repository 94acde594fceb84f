// Finds the cause of the motion lost in one tick.
#include <algorithm>
#include <cmath>

#include "slipface/sim/stops.h"
#include "step_attempts.h"

namespace slipface {
namespace {

struct Taken {
    FaceId face = no_id;
    SurfaceId surface = default_surface;
    double lost_m = 0.0;
    double worst_m = 0.0;  // by one record
    std::size_t record = 0;
    const SweepRecord* sweep = nullptr;
    Rule rule = Rule::slide;
};

class Reader {
  public:
    explicit Reader(const TickTrace& trace) : trace_(trace) {
        const Vec2 wish = trace.input.wish.isZero(0.0) ? Vec2(Vec2::Zero()) : trace.input.wish.normalized();
        heading_ = Vec3(wish.x(), 0.0, wish.y());
    }

    std::optional<Loss> read() {
        for (std::size_t i = 0; i < trace_.records.size(); ++i)
            std::visit([&](const auto& record) { take(i, record); }, trace_.records[i]);
        if (special_) return special_;
        if (heading_.isZero(0.0)) return std::nullopt;
        const auto maximum = std::max_element(
            taken_.begin(), taken_.end(), [](const Taken& a, const Taken& b) { return a.lost_m < b.lost_m; });
        double all = carried_m_;
        for (const Taken& t : taken_)
            all += t.lost_m;
        const double made = (trace_.to - trace_.from).dot(heading_);
        if (!(all > 0.0) || made >= all) return std::nullopt;
        if (carried_m_ > 0.0 && (maximum == taken_.end() || carried_m_ >= maximum->lost_m))
            return carried_loss();
        return loss_by(*maximum);
    }

  private:
    double towards(const Vec3& v) const { return v.dot(heading_); }

    void take(std::size_t index, const SweepRecord& sweep) {
        if (attempts_.note(sweep) == StepAttempts::Seen::begins) before_step_ = taken_;
        // A response is to the last contact; sweeps that only check its distance may follow it.
        if (sweep.contact) sweep_ = &sweep;
        if (!carrying_) return;
        carrying_ = false;
        if (const double against = -towards(sweep.move); against > 0.0) {
            carried_m_ += against;
            carried_record_ = index;
        }
    }

    void take(std::size_t index, const ResponseRecord& response) {
        const double lost = towards(response.remainder_before - response.remainder_after);
        if (!(lost > 0.0)) return;
        auto known = std::find_if(taken_.begin(), taken_.end(),
                                  [&](const Taken& t) { return t.face == response.face; });
        if (known == taken_.end()) {
            taken_.push_back({.face = response.face, .surface = response.surface});
            known = taken_.end() - 1;
        }
        known->lost_m += lost;
        if (lost <= known->worst_m) return;
        known->worst_m = lost;
        known->record = index;
        known->sweep = sweep_;
        known->rule = response.rule;
    }

    void take(std::size_t index, const DecisionRecord& decision) {
        if (StepAttempts::decides(decision)) step_decision_ = decision;
        switch (attempts_.note(decision)) {
            case StepAttempts::Seen::acted: taken_.clear(); break;
            case StepAttempts::Seen::refused: taken_ = before_step_; break;
            default: break;
        }
        switch (decision.kind) {
            case Decision::surface_carried:
            case Decision::platform_carried:
                carrying_ = true;
                carrier_ = decision;
                break;
            case Decision::friction_slid:
                // All that the player did not make of the wish.
                if (towards(trace_.before.ground_normal) < 0.0) {
                    carrier_ = decision;
                    carried_record_ = index;
                    carried_m_ =
                        std::max(0.0, trace_.settings.walk_speed * trace_.input.wish.norm() * trace_.dt -
                                          towards(trace_.to - trace_.from));
                }
                break;
            case Decision::still_stuck:
                if (!heading_.isZero(0.0)) special(StopCause::sticky, index, decision);
                break;
            case Decision::ladder_wall_above: special(StopCause::ladder_end, index, decision); break;
            case Decision::hazard_touched: special(StopCause::hazard, index, decision); break;
            case Decision::never_inside:
            case Decision::nudge_failed:
            case Decision::push_out_off:
                if (!special_) special(StopCause::inside, index, decision);
                break;
            case Decision::platform_crushed:
                special(StopCause::crushed, index, decision);
                special_->other = trace_.before.ground_face;
                break;
            case Decision::terrain_wall: special(StopCause::terrain, index, decision); break;
            case Decision::wall:
            case Decision::too_steep_to_stand: steep_.push_back(decision); break;
            default: break;
        }
    }
    void take(std::size_t, const PushOutRecord&) {}

    void special(StopCause cause, std::size_t index, const DecisionRecord& decision) {
        special_ = Loss{.cause = cause,
                        .record = index,
                        .face = decision.face,
                        .surface = trace_.before.ground_surface,
                        .position = sweep_ ? sweep_->contact->point : trace_.from,
                        .because = decision};
        if (sweep_ && sweep_->contact->face == decision.face) {
            special_->surface = sweep_->contact->surface;
            special_->normal = sweep_->contact->normal;
        }
    }

    Loss carried_loss() const {
        return {.cause = carrier_.kind == Decision::platform_carried ? StopCause::platform
                         : carrier_.kind == Decision::friction_slid  ? StopCause::slippery
                                                                     : StopCause::carried,
                .lost_m = carried_m_,
                .record = carried_record_,
                .face = carrier_.face,
                .surface = trace_.before.ground_surface,
                .position = trace_.from - Vec3(0.0, trace_.settings.radii.y(), 0.0),
                .normal = trace_.before.ground_normal,
                .because = carrier_};
    }

    Loss loss_by(const Taken& maximum) const {
        Loss loss{.lost_m = maximum.lost_m,
                  .record = maximum.record,
                  .face = maximum.face,
                  .surface = maximum.surface};
        if (maximum.sweep == nullptr) return loss;
        const SweepRecord& sweep = *maximum.sweep;
        const Contact& contact = *sweep.contact;
        loss.position = contact.point;
        loss.normal = contact.normal;
        loss.in_air = !is_held(trace_.before);
        const double centre = sweep.from.y() + contact.t * sweep.move.y();
        loss.height_m = contact.point.y() - (centre - trace_.settings.radii.y());
        // On a slope the lowest point of the body is not what the player stands on.
        if (!loss.in_air) loss.height_m -= trace_.before.ground_rise;
        if (contact.feature != Feature::interior) loss.because = step_decision_;
        for (const DecisionRecord& steep : steep_)
            if (!loss.because && steep.face == maximum.face) loss.because = steep;

        // What the thing is to the player, a wall, a step or a ceiling, is seen by trying.
        if (maximum.rule == Rule::stick)
            loss.cause = StopCause::sticky;
        else if (sweep.platform != no_id)
            loss.cause = StopCause::platform;
        else if (sweep.back)
            loss.cause = StopCause::back;
        return loss;
    }

    const TickTrace& trace_;
    Vec3 heading_ = Vec3::Zero();
    const SweepRecord* sweep_ = nullptr;
    std::vector<Taken> taken_, before_step_;
    std::vector<DecisionRecord> steep_;
    std::optional<DecisionRecord> step_decision_;
    std::optional<Loss> special_;
    bool carrying_ = false;
    StepAttempts attempts_;
    double carried_m_ = 0.0;
    std::size_t carried_record_ = 0;
    DecisionRecord carrier_;
};

}  // namespace

std::optional<Loss> loss_of(const TickTrace& trace) {
    return Reader(trace).read();
}

}  // namespace slipface
