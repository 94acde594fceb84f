#include "slipface/movement/decision.h"

#include <array>
#include <cstddef>

namespace slipface {

namespace {

constexpr auto make_decisions() {
    using enum Decision;
    using enum Outcome;
    using enum DecisionUnit;
    return std::to_array<DecisionInfo>({
#define SLIPFACE_DECISION(...) {__VA_ARGS__},
#include "slipface/movement/setting_rows.inc"
    });
}
constexpr auto decisions = make_decisions();

}  // namespace

std::span<const DecisionInfo> decision_table() {
    return decisions;
}

const DecisionInfo& decision_info(Decision kind) {
    return decisions[static_cast<std::size_t>(kind)];
}

}  // namespace slipface
