// What moves in a scene: its probe and its tape, run, drawn and put into numbers.
#pragma once

#include <optional>
#include <vector>

#include "numbers_json.h"
#include "slipface/render/overlay.h"
#include "slipface/sim/simulate.h"
#include "slipface/snapshot/suite.h"
#include "staged_level.h"

namespace slipface {

struct SceneMovement {
    Overlay overlay;
    Numbers numbers;            // the "movement" section; null when nothing moves
    MovementSettings settings;  // of the tape, or of the probe

    std::vector<TraceRecord> probe;
    Tape tape;
    Vec3 start = Vec3::Zero();
    std::vector<PlayerState> states;  // [tick]
};

// Runs what the scene asks for. `settings`, if given, count instead of the level's, the scene's and the
// tape's.
Result<SceneMovement> run_movement(const Scene& scene, const StagedLevel& staged,
                                   const std::optional<MovementSettings>& settings = std::nullopt);

// Where the story touches something: the probe's contacts, else where the tape's player lands or touches a
// new kind of surface.
struct MovementContact {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitY();
    FaceId face = no_id;
};
std::vector<MovementContact> movement_contacts(const SceneMovement& story);

PlayerInput input_at(const Tape& tape, std::size_t tick);

}  // namespace slipface
