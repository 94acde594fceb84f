#include <array>

#include "slipface/movement/settings.h"

namespace slipface {

namespace {

using S = MovementSettings;

constexpr double radians_per_degree = 0.017453292519943295;

// Values of `basic` and `maximum`.
constexpr double off = 0.0;
constexpr double last(std::span<const Choice> choices) {
    return static_cast<double>(choices.size() - 1);
}

const auto table = std::to_array<SettingInfo>({
#define SLIPFACE_SETTING(...) {__VA_ARGS__},
#include "slipface/movement/setting_rows.inc"
});

constexpr auto formulas = std::to_array<FormulaInfo>({
#define SLIPFACE_FORMULA(...) {__VA_ARGS__},
#include "slipface/movement/setting_rows.inc"
});

}  // namespace

std::span<const SettingInfo> settings_table() {
    return table;
}

std::span<const FormulaInfo> formula_table() {
    return formulas;
}

const FormulaInfo* find_formula(std::string_view hack) {
    for (const FormulaInfo& info : formulas)
        if (info.hack == hack) return &info;
    return nullptr;
}

}  // namespace slipface
