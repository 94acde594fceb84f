#include "slipface/movement/trace.h"

#include <fmt/format.h>

namespace slipface {

namespace {

std::string vector_text(const Vec3& v) {
    // Adding 0 turns -0 into 0.
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string face_text(FaceId face) {
    return face == no_id ? std::string("no face") : fmt::format("face {}", face);
}

std::string text_of(const SweepRecord& sweep) {
    std::string text = fmt::format("{} sweep {}: from {} by {}", pass_name(sweep.pass), sweep.iteration + 1,
                                   vector_text(sweep.from), vector_text(sweep.move));
    if (!sweep.contact) return text + ", free";
    const Contact& contact = *sweep.contact;
    return text +
           fmt::format(
               ", touches the {} of triangle {} ({}, surface {}) at t = {:.4g} with normal {}, stops at {}",
               feature_name(contact.feature), contact.triangle, face_text(contact.face), contact.surface,
               contact.t, vector_text(contact.normal), vector_text(sweep.reached));
}

std::string text_of(const ResponseRecord& response) {
    return fmt::format("{}: leftover {} ({:.4g} m) becomes {} ({:.4g} m) at normal {} ({}, surface {})",
                       rule_name(response.rule), vector_text(response.leftover_before),
                       response.leftover_before.norm(), vector_text(response.leftover_after),
                       response.leftover_after.norm(), vector_text(response.normal), face_text(response.face),
                       response.surface);
}

std::string text_of(const DecisionRecord& decision) {
    std::string text = fmt::format("{}: {}; {} = {:.4g}, limit {:.4g}", decision.hack, decision.outcome,
                                   decision.quantity, decision.value + 0.0, decision.limit + 0.0);
    if (decision.face != no_id) text += fmt::format(" ({})", face_text(decision.face));
    return text;
}

std::string text_of(const PushOutRecord& push) {
    return fmt::format("push_out: {} plane{}, from {} by {:.4g} m to {}, {}", push.planes,
                       push.planes == 1 ? "" : "s", vector_text(push.from), (push.to - push.from).norm(),
                       vector_text(push.to), push.free ? "free" : "still overlapping");
}

}  // namespace

void TraceRecorder::add(const TraceRecord& record) {
    records.push_back(record);
}

const char* pass_name(Pass pass) {
    switch (pass) {
        case Pass::slide:
            return "slide";
        case Pass::horizontal:
            return "horizontal";
        case Pass::vertical:
            return "vertical";
        case Pass::probe:
            return "probe";
        case Pass::step:
            return "step";
        case Pass::snap:
            return "snap";
    }
    return "unknown";
}

const char* rule_name(Rule rule) {
    switch (rule) {
        case Rule::slide:
            return "slide";
        case Rule::bounce:
            return "bounce";
        case Rule::straight_ahead:
            return "straight ahead";
        case Rule::keep_energy:
            return "keep energy";
        case Rule::stick:
            return "stick";
        case Rule::crease:
            return "crease";
        case Rule::stop:
            return "stop";
    }
    return "unknown";
}

std::string trace_text(const TraceRecord& record) {
    return std::visit([](const auto& r) { return text_of(r); }, record);
}

}  // namespace slipface
