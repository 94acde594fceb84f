#include "level_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "slipface/base/text.h"

namespace slipface {
namespace {

// Of a key's position and area: what the writer limits them to, so that every written key can be read.
constexpr double largest_float = std::numeric_limits<float>::max();

float in_range(double value) {
    return static_cast<float>(std::clamp(value, -largest_float, largest_float)) + 0.0F;
}

bool parse_part(std::string_view text, double limit, double& value) {
    const std::optional<double> number = parse_double(text);
    if (!number || !(std::abs(*number) <= limit)) return false;
    value = *number;
    return true;
}

bool parse_vector(std::string_view text, double limit, Vec3& vector) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 3) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (!parse_part(parts[static_cast<std::size_t>(axis)], limit, vector[axis])) return false;
    }
    return true;
}

bool parse_count(std::string_view text, std::uint32_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

double as_float(double value) {
    return static_cast<double>(static_cast<float>(value));
}

}  // namespace

std::string face_row_text(const FaceKey& key) {
    const Vec3& c = key.centroid;
    const Vec3& n = key.normal;
    std::string row =
        fmt::format("{:016x} {},{},{} {},{},{} {}", key.loop_hash, in_range(c.x()), in_range(c.y()),
                    in_range(c.z()), n.x() + 0.0, n.y() + 0.0, n.z() + 0.0, in_range(key.area));
    if (key.copy > 0) row += fmt::format(" {}", key.copy);
    return row;
}

bool parse_face_row(std::string_view text, FaceKey& key) {
    const std::vector<std::string_view> words = split(text, ' ');
    if (words.size() < 4 || words.size() > 5 || words[0].size() != 16) return false;
    const auto [end, error] = std::from_chars(words[0].data(), words[0].data() + 16, key.loop_hash, 16);
    if (error != std::errc() || end != words[0].data() + 16) return false;
    if (!parse_vector(words[1], largest_float, key.centroid) || !parse_vector(words[2], 1.001, key.normal))
        return false;
    if (!parse_part(words[3], largest_float, key.area) || key.area < 0.0) return false;
    key.centroid = key.centroid.unaryExpr(&as_float);
    key.area = as_float(key.area);
    return words.size() == 4 || parse_count(words[4], key.copy);
}

UnknownMembers UnknownMembers::parse(const UnknownKeys& keys) {
    UnknownMembers members;
    // The locations add one level of nesting to the file's own limit.
    const Result<Json> json = parse_json(keys.json, "unknown keys", max_json_depth + 1);
    if (!json || json->kind != Json::Kind::object) return members;
    for (std::size_t i = 0; i < json->keys.size(); ++i) {
        if (json->items[i].kind == Json::Kind::object)
            members.objects_.emplace(json->keys[i], json->items[i]);
    }
    return members;
}

UnknownKeys UnknownMembers::text() const {
    Json json = json_object();
    for (const auto& [location, object] : objects_)
        json_add(json, location, object);
    return {json_compact(json)};
}

std::string UnknownMembers::location(std::string_view kind, std::string_view name) {
    std::string location = fmt::format("/{}/{}", kind, name);
    const int count = ++names_[location];
    return count == 1 ? location : fmt::format("{}#{}", location, count);
}

void UnknownMembers::add(const std::string& location, std::string_view key, const Json& value) {
    const auto object = objects_.try_emplace(location, json_object()).first;
    json_add(object->second, key, value);
}

void UnknownMembers::append_to(Json& object, const std::string& location) const {
    const auto found = objects_.find(location);
    if (found == objects_.end()) return;
    for (std::size_t i = 0; i < found->second.keys.size(); ++i) {
        if (object.find(found->second.keys[i]) == nullptr) {
            json_add(object, found->second.keys[i], found->second.items[i]);
        }
    }
}

}  // namespace slipface
