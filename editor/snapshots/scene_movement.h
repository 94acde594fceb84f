// The movement in a scene: runs, draws and measures its probe and its tape.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "goldens/numbers_json.h"
#include "goldens/suite.h"
#include "slipface/movement/decision.h"
#include "slipface/render/overlay.h"
#include "slipface/sim/simulate.h"
#include "snapshots/staged_level.h"

namespace slipface {

struct SceneMovement {
    Overlay overlay;
    Numbers numbers;            // the "movement" section; null when nothing moves
    MovementSettings settings;  // of the tape, or of the probe
    std::set<Decision> acted;   // what they decided
    std::set<SurfaceId> touched;

    std::vector<TraceRecord> probe;
    Tape tape;
    Vec3 start = Vec3::Zero();
    std::vector<PlayerState> states;  // [tick]
};

// Runs the scene's probe and tape.
Result<SceneMovement> run_movement(const Scene& scene, const StagedLevel& staged);

// The contacts of the movement, at most 12: those of the probe, then those where the tape's player lands or
// touches a new surface type.
struct MovementContact {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitY();
    FaceId face = no_id;
};
std::vector<MovementContact> movement_contacts(const SceneMovement& story);

}  // namespace slipface
