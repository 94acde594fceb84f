// What a hack or rule can decide, one sentence each: the rows of setting_rows.inc.
#pragma once

#include <cstdint>
#include <span>

namespace slipface {

enum class Decision : std::uint8_t {
#define SLIPFACE_DECISION(kind, ...) kind,
#include "slipface/movement/setting_rows.inc"
};

enum class Outcome : std::uint8_t { acted, refused, switched_off };

// What a decision's numbers are. Movement has no inverse cosine; its angles come as cosines and sines.
enum class DecisionUnit : std::uint8_t {
    no_unit,
    metres,
    speed,  // m/s
    seconds,
    percent,  // as a fraction, 0..1
    slope,    // N.y, the cosine of a slope; shown in degrees from the horizontal, 90 is a wall, more an
              // overhang
    angle,    // the cosine of an angle
    lift,     // the sine of an angle between a direction and a plane
};

struct DecisionInfo {
    Decision kind;
    const char* hack;  // the setting's name in settings_table(), or "never_inside"
    Outcome outcome;
    DecisionUnit unit;
    const char* sentence;  // with {value} and {limit} where the numbers stand; without full stop
};

std::span<const DecisionInfo> decision_table();
const DecisionInfo& decision_info(Decision kind);

}  // namespace slipface
