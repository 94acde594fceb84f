// The trace of a step: plain records in the order in which things happened. Every panel, plot and image that
// explains movement reads these and nothing else.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "slipface/collision/contact.h"
#include "slipface/movement/decision.h"

namespace slipface {

// Why a sweep was made.
enum class Pass : std::uint8_t { slide, horizontal, vertical, probe, step, snap };
// How a contact deflected the remainder.
enum class Rule : std::uint8_t { slide, bounce, straight_ahead, keep_energy, stick, crease, stop };

const char* pass_name(Pass pass);
const char* rule_name(Rule rule);

// One sweep. It reached `from + (contact ? contact->t : 1) * move`; with the skin the centre is at `reached`.
struct SweepRecord {
    Pass pass = Pass::slide;
    int iteration = 0;  // 0.. within its pass
    Vec3 from = Vec3::Zero();
    Vec3 move = Vec3::Zero();     // displacement, m
    Vec3 reached = Vec3::Zero();  // centre after this sweep, skin included
    std::optional<Contact> contact = std::nullopt;
    bool back = false;               // the contact is with the back of its triangle
    std::uint32_t platform = no_id;  // of MovementScene::platforms, that the contact's face belongs to
};

// What a contact did to the remainder, and with it to the velocity.
struct ResponseRecord {
    Rule rule = Rule::slide;
    Vec3 remainder_before = Vec3::Zero();
    Vec3 remainder_after = Vec3::Zero();
    Vec3 velocity_before = Vec3::Zero();
    Vec3 velocity_after = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    SurfaceId surface = default_surface;
    FaceId face = no_id;
};

// A hack or rule that was considered, and what it decided. decision_info() has the sentence.
struct DecisionRecord {
    Decision kind{};
    double value = 0.0;  // in decision_info(kind).unit; 0 where the sentence has no value
    double limit = 0.0;  // what decided, in the same unit; 0 where the sentence has no limit
    FaceId face = no_id;
};

// The ellipsoid was moved out of overlaps.
struct PushOutRecord {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::Zero();
    int planes = 0;
    bool free = false;  // nothing is overlapped at `to`
};

using TraceRecord = std::variant<SweepRecord, ResponseRecord, DecisionRecord, PushOutRecord>;

class TraceSink {
  public:
    virtual ~TraceSink() = default;
    virtual void add(const TraceRecord& record) = 0;
};

// Stores the records of one or more steps.
class TraceRecorder final : public TraceSink {
  public:
    void add(const TraceRecord& record) override;
    std::vector<TraceRecord> records;
};

}  // namespace slipface
