#include "json_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "slipface/base/text.h"

namespace slipface {

namespace {

constexpr double farthest = 1e9;  // metres
constexpr double longest = 1e6;   // seconds
constexpr std::size_t max_path_points = 10'000;

void maybe_number(JsonReader& reader, const Json& object, const std::string& path, const char* key,
                  double low, double high, double& out) {
    if (const Json* value = object.find(key)) reader.number(*value, path + "/" + key, low, high, out);
}

void maybe_vector(JsonReader& reader, const Json& object, const std::string& path, const char* key,
                  Vec3& out) {
    if (const Json* value = object.find(key))
        reader.vector(*value, path + "/" + key, -farthest, farthest, out);
}

void read_repeat(JsonReader& reader, const Json& json, const std::string& path, PathRepeat& repeat) {
    std::string name;
    if (!reader.text(json, path, name)) return;
    const auto found = std::find(path_repeat_names.begin(), path_repeat_names.end(), name);
    if (found == path_repeat_names.end()) {
        reader.fail(path, json_kind_text(json), fmt::format("one of {}", fmt::join(path_repeat_names, ", ")));
        return;
    }
    repeat = static_cast<PathRepeat>(found - path_repeat_names.begin());
}

void read_spin(JsonReader& reader, const Json& json, const std::string& path, Platform& platform) {
    if (!reader.object(json, path)) return;
    maybe_vector(reader, json, path, "axis", platform.spin_axis);
    maybe_vector(reader, json, path, "pivot", platform.spin_pivot);
    maybe_number(reader, json, path, "rate", -100.0, 100.0, platform.spin_rate);
    if (reader.ok() && !(platform.spin_axis.norm() > 1e-6)) {
        reader.fail(path + "/axis", "a vector of length 0", "an axis of rotation");
    }
}

void read_path(JsonReader& reader, const Json& json, const std::string& path,
               std::vector<PathPoint>& points) {
    if (!reader.array(json, path, max_path_points)) return;
    for (std::size_t i = 0; i < json.items.size() && reader.ok(); ++i) {
        const std::string here = fmt::format("{}/{}", path, i);
        const Json& item = json.items[i];
        PathPoint point;
        if (!reader.object(item, here)) return;
        const Json* offset = reader.member(item, here, "offset");
        if (offset == nullptr) return;
        reader.vector(*offset, here + "/offset", -farthest, farthest, point.offset);
        maybe_number(reader, item, here, "speed", 1e-3, 1e3, point.speed);
        maybe_number(reader, item, here, "pause", 0.0, longest, point.pause_s);
        points.push_back(point);
    }
}

}  // namespace

Platform read_platform(JsonReader& reader, const Json& json, const std::string& path) {
    Platform platform;
    if (!reader.object(json, path)) return platform;
    const Json* name = reader.member(json, path, "name");
    const Json* group = reader.member(json, path, "group");
    if (name == nullptr || group == nullptr || !reader.text(*name, path + "/name", platform.name) ||
        !reader.text(*group, path + "/group", platform.group)) {
        return platform;
    }
    if (const Json* value = json.find("path")) read_path(reader, *value, path + "/path", platform.path);
    if (const Json* value = json.find("repeat"))
        read_repeat(reader, *value, path + "/repeat", platform.repeat);
    if (const Json* value = json.find("spin")) read_spin(reader, *value, path + "/spin", platform);
    maybe_number(reader, json, path, "phase", 0.0, longest, platform.phase_s);
    return platform;
}

HeightfieldSource read_heightfield(JsonReader& reader, const Json& json, const std::string& path) {
    HeightfieldSource source;
    if (!reader.object(json, path)) return source;
    const Json* file = reader.member(json, path, "file");
    if (file == nullptr || !reader.text(*file, path + "/file", source.file)) return source;
    maybe_vector(reader, json, path, "origin", source.origin);
    if (const Json* size = json.find("size")) {
        if (!reader.array(*size, path + "/size", 2)) return source;
        if (size->items.size() != 2) {
            reader.fail(path + "/size", fmt::format("{} numbers", size->items.size()), "two: along x and z");
            return source;
        }
        reader.number(size->items[0], path + "/size/0", 1e-3, 1e7, source.size.x());
        reader.number(size->items[1], path + "/size/1", 1e-3, 1e7, source.size.y());
    }
    maybe_number(reader, json, path, "low", -1e6, 1e6, source.low);
    maybe_number(reader, json, path, "high", -1e6, 1e6, source.high);
    if (reader.ok() && !(source.low < source.high)) {
        reader.fail(path + "/high", to_text(source.high),
                    fmt::format("more than \"low\", {}", to_text(source.low)));
    }
    return source;
}

SectorLayout read_sectors(JsonReader& reader, const Json& json, const std::string& path) {
    SectorLayout sectors;
    if (!reader.object(json, path)) return sectors;
    maybe_number(reader, json, path, "size", 0.0, 1e7, sectors.size);
    maybe_vector(reader, json, path, "placement", sectors.placement);
    if (reader.ok() && sectors.size > 0.0 && sectors.size < 1.0) {
        reader.fail(path + "/size", json_kind_text(*json.find("size")), "0 for none, or at least 1 m");
    }
    return sectors;
}

Json vector_json(const Vec3& vector) {
    Json json = json_array();
    for (const double part : {vector.x(), vector.y(), vector.z()})
        json.items.push_back(json_number(part));
    return json;
}

Json path_point_json(const PathPoint& point) {
    Json json = json_object();
    json_add(json, "offset", vector_json(point.offset));
    json_add(json, "speed", json_number(point.speed));
    json_add(json, "pause", json_number(point.pause_s));
    return json;
}

Json spin_json(const Platform& platform) {
    Json json = json_object();
    json_add(json, "axis", vector_json(platform.spin_axis));
    json_add(json, "pivot", vector_json(platform.spin_pivot));
    json_add(json, "rate", json_number(platform.spin_rate));
    return json;
}

Json platform_json(const Platform& platform) {
    Json json = json_object();
    json_add(json, "name", json_string(platform.name));
    json_add(json, "group", json_string(platform.group));
    json_add(json, "repeat", json_string(path_repeat_names[static_cast<std::size_t>(platform.repeat)]));
    json_add(json, "phase", json_number(platform.phase_s));
    return json;
}

Json heightfield_json(const HeightfieldSource& source) {
    Json json = json_object();
    json_add(json, "file", json_string(source.file));
    json_add(json, "origin", vector_json(source.origin));
    Json size = json_array();
    size.items = {json_number(source.size.x()), json_number(source.size.y())};
    json_add(json, "size", std::move(size));
    json_add(json, "low", json_number(source.low));
    json_add(json, "high", json_number(source.high));
    return json;
}

Json sectors_json(const SectorLayout& sectors) {
    Json json = json_object();
    json_add(json, "size", json_number(sectors.size));
    json_add(json, "placement", vector_json(sectors.placement));
    return json;
}

}  // namespace slipface
