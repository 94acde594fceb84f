// A level for scenes: loaded once, with the data that images and movement need.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "slipface/level/level.h"
#include "slipface/render/level_image.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct StagedLevel {
    Level level;
    CollisionWorld collision;
    CollisionWorld geometry;   // with every face solid, for visibility. Empty: `collision` has all faces
    Warnings warnings;         // of reading it
    std::optional<Tape> tape;  // of a demo, for scenes without a tape of their own

    const CollisionWorld& visible() const { return geometry.triangle_count() > 0 ? geometry : collision; }
};

Result<std::unique_ptr<StagedLevel>> stage_level(Level level, Warnings warnings = {});
// A level's file, or "demo:NAME:on" and "demo:NAME:off": a scene of demo_table() with its switch on or off.
Result<std::unique_ptr<StagedLevel>> load_staged_level(const std::filesystem::path& path);

inline constexpr std::string_view demo_prefix = "demo:";

}  // namespace slipface
