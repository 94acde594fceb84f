// What a level's author wants to be true of where the player gets, checked by `slipface reach --check`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

enum class GoalKind : std::uint8_t { reach, never };
inline constexpr std::array<const char*, 2> goal_kind_names{"reach", "never"};

// A named position that the player must reach, or must never reach.
struct Goal {
    std::string name;
    GoalKind kind = GoalKind::reach;
    Vec3 position = Vec3::Zero();    // of the player's centre, metres, in the level's coordinates
    double radius = 1.0;             // reached when the player's centre is this near, metres
    std::optional<double> within_s;  // `reach` alone: must not take longer, seconds
    std::string from;                // a spawn, or another goal's position; empty: the main spawn
    // As for set_setting(), "dash=off": what is different for this goal from the level's movement.
    std::vector<std::string> settings{};
    friend bool operator==(const Goal&, const Goal&) = default;
};
inline constexpr std::size_t max_goals = 10'000;  // of a level
inline constexpr std::size_t max_goal_settings = 100;
inline constexpr double smallest_goal_radius = 0.01, largest_goal_radius = 1000.0;

}  // namespace slipface
