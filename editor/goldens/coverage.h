// What the snapshots exercise, and what none does: there a change of the program stays green.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "slipface/level/level.h"
#include "slipface/movement/decision.h"

namespace slipface {

// Words: "setting step_up", "surface bounce", "object prop", "type ice of levels/yard".
struct Coverage {
    std::set<std::string> reached;
    std::set<std::string> there;  // in a level, and to be reached by somebody

    void add(const Coverage& other);
    void add_objects(const Level& level);
    // A run in `level`, named `place`: its settings, what they decided, and the types that the player
    // touched.
    void add_run(const Level& level, const std::string& place, const MovementSettings& settings,
                 const std::set<Decision>& acted, const std::set<SurfaceId>& touched);
};

// Of the settings that decide something, the members of a surface type, the objects of a level, and the types
// that a level uses. A setting is reached when what it decides happens, a switch that reports nothing when it
// is on; a member, when the player touches a type that has it.
std::vector<std::string> not_reached(const Coverage& coverage);

// "3 settings (step_up, ...), 2 members of surface types (...)"; empty: all is reached.
std::string not_reached_text(const std::vector<std::string>& words);

}  // namespace slipface
