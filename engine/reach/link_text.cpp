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

}  // namespace

std::string link_to_json(const ReachLink& link) {
    return line_of(link_json(link));
}

std::string links_to_json(const ReachSearch& search, const ReachLinks& links) {
    const Level& level = search.level();
    std::string text = fmt::format(
        "{{\"slipface_links\": 1,\n\"level\": {},\n\"geometry\": \"{:016x}\",\n\"settings\": "
        "{},\n\"regions\": [",
        line_of(level.mesh_path.filename().string()), level.mesh->fingerprint,
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
    std::string text = fmt::format("f {}\n", search.level().mesh_path.filename().string());
    const Vec3& radii = search.level().movement.radii;
    for (const ReachLink& link : links.links) {
        const Vec3 &a = link.begin, &b = link.end;
        const bool walks = link.kind == LinkKind::walk;
        text += fmt::format("c {:.6f} {:.6f} {:.6f}  {:.6f} {:.6f} {:.6f}  {:.6f} 0 {} {}\n", a.x(), a.y(),
                            a.z(), b.x(), b.y(), b.z(), 2.0 * std::max(radii.x(), radii.z()), walks ? 0 : 5,
                            walks ? 1 : 8);
    }
    return text;
}

}  // namespace slipface
