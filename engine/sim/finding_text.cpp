#include "finding_text.h"

#include <fmt/format.h>

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

// Its group, else its material; empty if it has neither.
std::string face_name(const Level& level, FaceId face) {
    const Mesh& mesh = *level.mesh;
    if (face >= mesh.face_count()) return {};
    const std::uint32_t group = face < mesh.face_group.size() ? mesh.face_group[face] : no_id;
    if (group < mesh.groups.size() && !mesh.groups[group].empty()) return mesh.groups[group];
    const std::uint32_t material = face < mesh.face_material.size() ? mesh.face_material[face] : no_id;
    return material < mesh.materials.size() ? mesh.materials[material].name : std::string();
}

std::string pair_words(const Level& level, FaceId a, FaceId b) {
    if (b == no_id) return a == no_id ? "" : " against " + face_words(level, a);
    const std::string one = face_name(level, a), two = face_name(level, b);
    if (one.empty() || two.empty()) return fmt::format(" between faces {} and {}", a, b);
    if (one == two) return fmt::format(" between faces {} and {} (`{}`)", a, b, one);
    return fmt::format(" between faces {} and {} (`{}`, `{}`)", a, b, one, two);
}

}  // namespace

const FindingKindInfo& info_of(FindingKind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

std::string face_words(const Level& level, FaceId face) {
    if (face == no_id) return "the air";
    const std::string name = face_name(level, face);
    return name.empty() ? fmt::format("face {}", face) : fmt::format("face {} (`{}`)", face, name);
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
                               face_words(level, finding.face), seconds, finding.amount);
        case FindingKind::left_level:
            return fmt::format("{} left the level after {:.1f} s at {}; it last stood on {}", walker, seconds,
                               where, face_words(level, finding.face));
        case FindingKind::overlap:
            return fmt::format("{} ended inside {} after {:.1f} s, by {:.1f} % of its radius", walker,
                               face_words(level, finding.face), seconds, 100.0 * finding.amount);
        case FindingKind::stuck:
            return fmt::format("{} got stuck after {:.1f} s{}", walker, seconds - finding.amount,
                               pair_words(level, finding.face, finding.other));
    }
    return {};
}

}  // namespace slipface
