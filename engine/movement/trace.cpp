#include "slipface/movement/trace.h"

namespace slipface {

void TraceRecorder::add(const TraceRecord& record) {
    records.push_back(record);
}

const char* pass_name(Pass pass) {
    switch (pass) {
        case Pass::slide: return "slide";
        case Pass::horizontal: return "horizontal";
        case Pass::vertical: return "vertical";
        case Pass::probe: return "probe";
        case Pass::step: return "step";
        case Pass::snap: return "snap";
    }
    return "unknown";
}

const char* rule_name(Rule rule) {
    switch (rule) {
        case Rule::slide: return "slide";
        case Rule::bounce: return "bounce";
        case Rule::straight_ahead: return "straight ahead";
        case Rule::keep_energy: return "keep energy";
        case Rule::stick: return "stick";
        case Rule::crease: return "crease";
        case Rule::stop: return "stop";
    }
    return "unknown";
}

}  // namespace slipface
