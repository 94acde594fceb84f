// What went wrong in a run of another controller, from its positions and the level alone.
#pragma once

#include <string>

#include "slipface/level/level_scene.h"
#include "slipface/sim/recorded_run.h"
#include "slipface/sim/tape.h"

namespace slipface {

enum class FaultKind : std::uint8_t {
    stop,     // the player makes less than two fifths of the speed that was wanted, for a quarter of a second
    snag,     // the same for a moment, or a third of the speed is lost and comes back
    hop,      // thrown up on flat ground
    jitter,   // to and fro under an unchanged stick
    creep,    // moves without the stick
    through,  // the middle of the body passes through a face
    fall,     // out of the level
};
const char* fault_name(FaultKind kind);

struct RecordedFault {
    FaultKind kind = FaultKind::stop;
    std::size_t first = 0, last = 0;  // ticks
    double lost_m_s = 0.0;            // of a stop or a snag; m of a hop or a creep
    FaceId face = no_id;              // what it nearly touched; no_id: nothing was found
    FaceId other = no_id;             // of a seam or a corner
    Vec3 position = Vec3::Zero();     // in the level's coordinates
    std::string text = {};            // "your controller loses 4.0 of 6.0 m/s at the 12 mm edge of `tile_7`"
    // Slipface's mover with the same body and inputs, from half a second before.
    bool slipface_passes = false;
    std::optional<std::size_t> differs_at = {};  // the tick from which it is more than 5 cm elsewhere
};

// "Slipface passes; differs at tick 57".
std::string compared_text(const RecordedFault& fault);

// In the order of their ticks. `settings` are those of Slipface's mover; its body and speed become the run's.
std::vector<RecordedFault> find_recorded_faults(const Level& level, LevelScene& scene, const RecordedRun& run,
                                                const MovementSettings& settings);

// The inputs of the run for Slipface's mover, with its body, its speed and the usual time of its ticks.
Tape tape_of(const RecordedRun& run);

}  // namespace slipface
