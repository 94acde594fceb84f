#include "slipface/movement/rest.h"

#include <bit>
#include <tuple>

#include "mover.h"
#include "slipface/collision/revision.h"

namespace slipface {

namespace {

// Equal numbers have the same bits but for the sign of zero.
bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
template <int Size>
bool same_bits(const Eigen::Matrix<double, Size, 1>& a, const Eigen::Matrix<double, Size, 1>& b) {
    for (int axis = 0; axis < Size; ++axis)
        if (!same_bits(a[axis], b[axis])) return false;
    return true;
}
bool same_bits(const PlayerState& a, const PlayerState& b) {
    const auto same = [&](auto... member) { return (same_bits(a.*member, b.*member) && ...); };
    return a == b && std::apply(same, PlayerState::vectors) && std::apply(same, PlayerState::numbers);
}

// Those that were shared last on this thread, if they are the same.
std::shared_ptr<const MovementSettings> shared(const MovementSettings& settings) {
    thread_local std::shared_ptr<const MovementSettings> latest;
    if (latest == nullptr || *latest != settings) latest = std::make_shared<const MovementSettings>(settings);
    return latest;
}

// Whether a platform is anywhere in the box during the tick, for all that is known without asking each.
bool may_meet_platform(const MovementScene& scene, const Vec3& radii, const Aabb& box) {
    if (scene.platforms.empty()) return false;
    if (scene.tree == nullptr || box.empty()) return true;
    bool any = false;
    const Vec3 slack = slack_around(radii, box.max.cwiseAbs().cwiseMax(box.min.cwiseAbs()), box.size());
    scene.tree->visit({box.min - slack, box.max + slack}, [&](std::uint32_t) { any = true; });
    return any;
}

}  // namespace

const StepResult* Rest::find(const MovementScene& scene, const MovementSettings& settings,
                             const PlayerState& state, const PlayerInput& input, double dt) const {
    const bool same = known_ && scene.filter == nullptr && same_bits(state, result_.state) && dt == dt_ &&
                      same_bits(input.wish, input_.wish) && input.buttons == input_.buttons &&
                      settings == *settings_ && revision(scene.collision) == world_ &&
                      scene.surfaces.data() == surfaces_.data() &&
                      scene.surfaces.size() == surfaces_.size() && scene.heightfield == heightfield_ &&
                      scene.sectors == sectors_ && scene.platforms.empty() != platforms_ &&
                      !may_meet_platform(scene, settings.radii, looked_);
    return same ? &result_ : nullptr;
}

void Rest::note(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, const Aabb& looked, const StepResult& result) {
    // What a filter answers may be another thing in the next step.
    known_ = scene.filter == nullptr && same_bits(state, result.state) && state.ground_platform == no_id &&
             !may_meet_platform(scene, settings.radii, looked);
    if (!known_) return;
    result_ = result;
    input_ = input;
    dt_ = dt;
    settings_ = shared(settings);
    world_ = revision(scene.collision);
    surfaces_ = scene.surfaces;
    heightfield_ = scene.heightfield;
    sectors_ = scene.sectors;
    platforms_ = !scene.platforms.empty();
    looked_ = looked;
}

}  // namespace slipface
