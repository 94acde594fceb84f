// Links as JSON, and for RecastDemo.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "slipface/reach/links.h"

namespace slipface {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json link_json(const ReachLink& link) {
    const auto vector = [](const Vec3& of) { return Json{of.x(), of.y(), of.z()}; };
    Json json{{"from", link.from},
              {"to", link.to},
              {"kind", link_kind_names[static_cast<std::size_t>(link.kind)]},
              {"two_way", link.two_way},
              {"begin", vector(link.begin)},
              {"end", vector(link.end)},
              {"velocity", vector(link.velocity)},
              {"time_s", link.time_s}};
    if (link.from_face != no_id) json["from_face"] = link.from_face;
    if (link.to_face != no_id) json["to_face"] = link.to_face;
    json["begin_tick"] = link.begin_tick;
    json["tape"] = tape_to_text(link.tape);
    return json;
}

// A player on a rim hangs over it, lower than the face that holds it. Detour looks for its mesh as high as
// the place that it is given, so that is on the face.
Vec3 on_face(const Level& level, FaceId face, const Vec3& lowest) {
    if (face == no_id) return lowest;
    const Vec3 normal = face_normal(*level.mesh, face);
    if (!(normal.y() > 0.1)) return lowest;
    const Vec3 corner = level.mesh->corner_position(level.mesh->face_first_corner[face]).cast<double>();
    const double height =
        corner.y() -
        (normal.x() * (lowest.x() - corner.x()) + normal.z() * (lowest.z() - corner.z())) / normal.y();
    return {lowest.x(), std::clamp(height, lowest.y(), lowest.y() + level.movement.radii.y()), lowest.z()};
}

}  // namespace

std::string link_to_json(const ReachLink& link) {
    return line_of(link_json(link));
}

std::string links_to_json(const ReachSearch& search, const ReachLinks& links) {
    const Level& level = search.level();
    std::string text = fmt::format(
        "{{\"slipface_links\": 1,\n\"level\": {},\n\"geometry\": \"{:016x}\",\n\"settings\": "
        "{},\n\"regions\": [",
        line_of(level.mesh_path.filename().string()), level.mesh.fingerprint(),
        line_of(setting_changes(basic_settings(), level.movement)));
    const char* between = "\n";
    for (const WalkRegions::Region& region : links.regions.regions) {
        text += between + line_of({{"area_m2", region.area_m2}, {"faces", region.faces}});
        between = ",\n";
    }
    text += "],\n\"links\": [";
    between = "\n";
    for (const ReachLink& link : links.links) {
        text += between + link_to_json(link);
        between = ",\n";
    }
    return text + "]}\n";
}

// c BEGIN END RADIUS BIDIRECTIONAL AREA FLAGS, as RecastDemo writes them. Its area 5 and its flag 8 are a
// jump's; 0 and 1 are the ground's.
std::string links_to_gset(const ReachSearch& search, const ReachLinks& links) {
    const Level& level = search.level();
    std::string text = fmt::format("f {}\n", level.mesh_path.filename().string());
    // The mesh ends a radius and a few of its cells before a rim, and the player may stand a radius beyond.
    const double radius = 3.0 * std::max(level.movement.radii.x(), level.movement.radii.z());
    for (const ReachLink& link : links.links) {
        const Vec3 a = on_face(level, link.from_face, link.begin), b = on_face(level, link.to_face, link.end);
        const bool walks = link.kind == LinkKind::walk;
        text += fmt::format("c {:.6f} {:.6f} {:.6f}  {:.6f} {:.6f} {:.6f}  {:.6f} 0 {} {}\n", a.x(), a.y(),
                            a.z(), b.x(), b.y(), b.z(), radius, walks ? 0 : 5, walks ? 1 : 8);
    }
    return text;
}

}  // namespace slipface
