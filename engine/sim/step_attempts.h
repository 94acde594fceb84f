// Follows the attempts to step up in a trace. Of the plain move and the attempt one counts, the other was
// taken back.
#pragma once

#include <string_view>
#include <utility>

#include "slipface/movement/trace.h"

namespace slipface {

class StepAttempts {
  public:
    enum class Seen { nothing, begins, acted, refused };

    Seen note(const SweepRecord& sweep) {
        if (sweep.pass != Pass::step || trying_) return Seen::nothing;
        trying_ = true;
        return Seen::begins;
    }
    Seen note(const DecisionRecord& decision) {
        if (!decides(decision)) return Seen::nothing;
        // Skipped when certain to be refused.
        const bool tried = std::exchange(trying_, false);
        if (decision_info(decision.kind).outcome == Outcome::acted) return Seen::acted;
        return tried ? Seen::refused : Seen::nothing;
    }
    template <class Record>
    Seen note(const Record&) {
        return Seen::nothing;
    }

    // True if the decision is about stepping up.
    static bool decides(const DecisionRecord& decision) {
        const bool of_rim =
            decision.kind >= Decision::step_rim && decision.kind <= Decision::step_rim_blocked;
        return std::string_view(decision_info(decision.kind).hack) == "step_up" && !of_rim;
    }

  private:
    bool trying_ = false;
};

}  // namespace slipface
