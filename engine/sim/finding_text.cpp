#include "finding_text.h"

#include <fmt/format.h>

#include "slipface/sim/story.h"

namespace slipface {
namespace {

constexpr FindingKindInfo kinds[] = {
    {"passed_through", "Passed through a face",
     "The centre of a walker passed through a solid face, or a platform passed through the centre",
     "Check that Moving platforms is on. If it is, this is a defect of the movement: report it with its "
     "tape"},
    {"left_level", "Left the level",
     "No ray from the spawn point leaves the level, yet a walker did, through a gap or a one-sided face",
     "Close the gap where the walker left, or give the face there a type that stops from both sides"},
    {"overlap", "Ended inside a face", "A walker ended a tick deeper inside a solid face than its skin",
     "Check whether a platform or a setting puts it there; otherwise report it with its tape"},
    {"stuck", "Got stuck",
     "A walker pushed the stick for at least 2 s but stayed within 1 cm, although nothing blocked it in the "
     "last quarter of a second",
     "Open the run and read Why. Widen or fill the corner, or turn on Step up or the analytic push-out"},
};
static_assert(std::size(kinds) == finding_kind_count);

std::string pair_words(const StoryNames& names, FaceId a, FaceId b) {
    if (a == no_id) return "";
    if (b == no_id) return " against " + thing_text(names, a);
    return " between " + thing_text(names, a) + " and " + thing_text(names, b);
}

}  // namespace

const FindingKindInfo& info_of(FindingKind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

std::string finding_text(const Level& level, const AuditOptions& options, const AuditFinding& finding) {
    const double seconds = static_cast<double>(finding.tick) * options.dt;
    const std::string walker = finding.life == 0
                                   ? fmt::format("Walker {}", finding.walker)
                                   : fmt::format("Walker {} in life {}", finding.walker, finding.life + 1);
    const Vec3& at = finding.position;
    const std::string where = fmt::format("({:.2f}, {:.2f}, {:.2f}) m", at.x(), at.y(), at.z());
    switch (finding.kind) {
        case FindingKind::passed_through:
            return fmt::format("{} passed through {} after {:.1f} s, {:.3f} m in one tick", walker,
                               thing_text(level, finding.face), seconds, finding.amount);
        case FindingKind::left_level:
            return fmt::format("{} left the level after {:.1f} s at {}; it last stood on {}", walker, seconds,
                               where, thing_text(level, finding.face));
        case FindingKind::overlap:
            return fmt::format("{} ended inside {} after {:.1f} s, by {:.1f} % of its radius", walker,
                               thing_text(level, finding.face), seconds, 100.0 * finding.amount);
        case FindingKind::stuck:
            return fmt::format("{} got stuck after {:.1f} s{}", walker, seconds - finding.amount,
                               pair_words(level, finding.face, finding.other));
    }
    return {};
}

}  // namespace slipface
