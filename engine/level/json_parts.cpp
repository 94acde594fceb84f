#include "json_parts.h"

#include <fmt/format.h>

#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr double longest = 1e6;  // seconds

constexpr std::size_t max_path_points = 10'000;

PathPoint read_path_point(const JsonNode& node) {
    PathPoint point;
    if (!node.object()) return point;
    node.need("offset").vector(-farthest_position, farthest_position, point.offset);
    node["speed"].number(1e-3, 1e3, point.speed);
    node["pause"].number(0.0, longest, point.pause_s);
    return point;
}

void read_spin(const JsonNode& node, Platform& platform) {
    if (!node.object()) return;
    const JsonNode axis = node["axis"];
    axis.vector(-farthest_position, farthest_position, platform.spin_axis);
    node["pivot"].vector(-farthest_position, farthest_position, platform.spin_pivot);
    node["rate"].number(-100.0, 100.0, platform.spin_rate);
    if (!(platform.spin_axis.norm() > 1e-6)) axis.fail("a vector of length 0", "an axis of rotation");
}

}  // namespace

Platform read_platform(const JsonNode& node, std::vector<JsonNode>& parts) {
    Platform platform;
    if (!node.object()) return platform;
    const JsonNode name = node.need("name"), group = node.need("group");
    name.text(platform.name);
    group.text(platform.group);
    node["path"].each(max_path_points, [&](const JsonNode& point) {
        platform.path.push_back(read_path_point(point));
        parts.push_back(point);
    });
    node["repeat"].one_of(path_repeat_names, platform.repeat);
    parts.push_back(node["spin"]);
    read_spin(parts.back(), platform);
    node["phase"].number(0.0, longest, platform.phase_s);
    return platform;
}

void read_animation(const JsonNode& node, Animation& animation) {
    if (!node || !node.object()) return;
    const double most = fastest_animation;
    node["clip"].text(animation.clip);
    node["speed"].number(-most, most, animation.speed);
    node["phase"].number(-longest, longest, animation.phase_s);
    node["scroll_u"].number(-most, most, animation.scroll.x());
    node["scroll_v"].number(-most, most, animation.scroll.y());
    node["columns"].integer(1, max_pictures_a_side, animation.columns);
    node["rows"].integer(1, max_pictures_a_side, animation.rows);
    node["pictures_per_second"].number(-most, most, animation.pictures_per_s);
}

Prop read_prop(const JsonNode& node) {
    Prop prop;
    if (!node.object()) return prop;
    const JsonNode name = node.need("name"), mesh = node.need("mesh"), scale = node["scale"];
    name.text(prop.name);
    if (mesh.text(prop.mesh) && prop.mesh.empty()) mesh.fail("an empty name", "a geometry file");
    node["position"].vector(-farthest_prop, farthest_prop, prop.position);
    node["rotation"].vector(-largest_prop_rotation, largest_prop_rotation, prop.rotation);
    scale.vector(-largest_prop_scale, largest_prop_scale, prop.scale);
    if (scale && prop.scale.cwiseAbs().minCoeff() < smallest_prop_scale)
        scale.fail("a scale nearer to 0", fmt::format("at least {} along each axis, or at most -{}",
                                                      smallest_prop_scale, smallest_prop_scale));
    node["texture"].text(prop.texture);
    node["type"].text(prop.type);
    read_animation(node["animation"], prop.animation);
    return prop;
}

HeightfieldSource read_heightfield(const JsonNode& node) {
    HeightfieldSource source;
    if (!node.object() || !node.need("file").text(source.file)) return source;
    node["origin"].vector(-farthest_position, farthest_position, source.origin);
    const JsonNode size = node["size"], high = node["high"];
    if (size.array(2) && size.json().items.size() != 2)
        size.fail(fmt::format("{} numbers", size.json().items.size()), "two: along x and z");
    Eigen::Index axis = 0;
    size.each(2, [&](const JsonNode& part) { part.number(1e-3, 1e7, source.size[axis++]); });
    node["low"].number(-1e6, 1e6, source.low);
    high.number(-1e6, 1e6, source.high);
    if (node && !(source.low < source.high))
        high.fail(to_text(source.high), fmt::format("more than \"low\", {}", to_text(source.low)));
    return source;
}

SectorLayout read_sectors(const JsonNode& node) {
    SectorLayout sectors;
    if (!node.object()) return sectors;
    const JsonNode size = node["size"];
    size.number(0.0, 1e7, sectors.size);
    node["placement"].vector(-farthest_position, farthest_position, sectors.placement);
    if (node && sectors.size > 0.0 && sectors.size < 1.0) size.fail("0 for none, or at least 1 m");
    return sectors;
}

Json vector_json(const Vec3& vector) {
    return json_array({json_number(vector.x()), json_number(vector.y()), json_number(vector.z())});
}

Json path_point_json(const PathPoint& point) {
    return json_object({{"offset", vector_json(point.offset)},
                        {"speed", json_number(point.speed)},
                        {"pause", json_number(point.pause_s)}});
}

Json spin_json(const Platform& platform) {
    return json_object({{"axis", vector_json(platform.spin_axis)},
                        {"pivot", vector_json(platform.spin_pivot)},
                        {"rate", json_number(platform.spin_rate)}});
}

Json platform_json(const Platform& platform) {
    return json_object({{"name", json_string(platform.name)},
                        {"group", json_string(platform.group)},
                        {"repeat", json_string(path_repeat_names[static_cast<std::size_t>(platform.repeat)])},
                        {"phase", json_number(platform.phase_s)}});
}

// Members that are as usual are left out.
Json animation_json(const Animation& animation) {
    const Animation usual;
    Json json = json_object();
    const auto add = [&](const char* name, double value, double as_usual) {
        if (value != as_usual) json_add(json, name, json_number(value));
    };
    if (!animation.clip.empty()) json_add(json, "clip", json_string(animation.clip));
    add("speed", animation.speed, usual.speed);
    add("phase", animation.phase_s, usual.phase_s);
    add("scroll_u", animation.scroll.x(), usual.scroll.x());
    add("scroll_v", animation.scroll.y(), usual.scroll.y());
    add("columns", animation.columns, usual.columns);
    add("rows", animation.rows, usual.rows);
    add("pictures_per_second", animation.pictures_per_s, usual.pictures_per_s);
    return json;
}

Json prop_json(const Prop& prop) {
    Json json = json_object({{"name", json_string(prop.name)},
                             {"mesh", json_string(prop.mesh)},
                             {"position", vector_json(prop.position)}});
    if (!prop.rotation.isZero(0.0)) json_add(json, "rotation", vector_json(prop.rotation));
    if (prop.scale != Vec3::Ones()) json_add(json, "scale", vector_json(prop.scale));
    if (!prop.texture.empty()) json_add(json, "texture", json_string(prop.texture));
    if (!prop.type.empty()) json_add(json, "type", json_string(prop.type));
    if (prop.animation.moves()) json_add(json, "animation", animation_json(prop.animation));
    return json;
}

Json heightfield_json(const HeightfieldSource& source) {
    return json_object({{"file", json_string(source.file)},
                        {"origin", vector_json(source.origin)},
                        {"size", json_array({json_number(source.size.x()), json_number(source.size.y())})},
                        {"low", json_number(source.low)},
                        {"high", json_number(source.high)}});
}

Json sectors_json(const SectorLayout& sectors) {
    return json_object({{"size", json_number(sectors.size)}, {"placement", vector_json(sectors.placement)}});
}

}  // namespace slipface
