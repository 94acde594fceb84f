// The light of a level in its file.

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "level_json.h"

namespace slipface {
namespace {

constexpr std::size_t max_emitters = 1000;
constexpr double brightest = 1000.0;

struct LightVector {
    const char* key;
    Vec3 LevelLight::*member;
    double lowest;
};
constexpr std::array<LightVector, 5> vectors{{{"sun_direction", &LevelLight::sun_direction, -brightest},
                                              {"sun_color", &LevelLight::sun_color, 0.0},
                                              {"sky_zenith", &LevelLight::sky_zenith, 0.0},
                                              {"sky_horizon", &LevelLight::sky_horizon, 0.0},
                                              {"ambient", &LevelLight::ambient, 0.0}}};

struct LightNumber {
    const char* key;
    double LevelLight::*member;
    double lowest, highest;
};
constexpr std::array<LightNumber, 3> numbers{{{"texel", &LevelLight::texel_m, 0.01, 100.0},
                                              {"sun_size", &LevelLight::sun_size, 0.0, 0.5},
                                              {"haze", &LevelLight::haze_m, 0.0, 1e6}}};

Json vector_json(const Vec3& vector) {
    Json json = json_array();
    for (int axis = 0; axis < 3; ++axis)
        json.items.push_back(json_number(vector[axis]));
    return json;
}

void read_geometry(const Json& json, const std::string& path, JsonReader& reader, std::uint64_t& out) {
    std::string text;
    if (!reader.text(json, path, text)) return;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
    if (error != std::errc() || end != text.data() + text.size() || text.size() != 16)
        reader.fail(path, json_quoted(text), "16 hexadecimal digits");
}

void read_image(const Json& json, const std::string& path, JsonReader& reader, std::string& out) {
    if (!reader.text(json, path, out)) return;
    // A level from elsewhere must not make the program open any file that it names.
    if (out.find_first_of("/\\:") != std::string::npos || out == ".." || out.find('\0') != std::string::npos)
        reader.fail(path, json_quoted(out), "a file name in the level's folder");
}

void read_emitters(const Json& json, const std::string& path, JsonReader& reader, LevelLight& light) {
    if (!reader.array(json, path, max_emitters)) return;
    for (std::size_t i = 0; i < json.items.size() && reader.ok(); ++i) {
        const std::string here = fmt::format("{}/{}", path, i);
        if (!reader.object(json.items[i], here)) return;
        const Json* pattern = reader.member(json.items[i], here, "pattern");
        const Json* color = reader.member(json.items[i], here, "color");
        LightEmitter emitter;
        if (pattern == nullptr || color == nullptr ||
            !reader.text(*pattern, here + "/pattern", emitter.pattern) ||
            !reader.vector(*color, here + "/color", 0.0, brightest, emitter.color))
            return;
        if (const Json* window = json.items[i].find("window"))
            reader.boolean(*window, here + "/window", emitter.window);
        light.emitters.push_back(std::move(emitter));
    }
}

}  // namespace

Json light_json(const LevelLight& light) {
    Json json = json_object();
    if (!light.image.empty()) {
        json_add(json, "image", json_string(light.image));
        json_add(json, "geometry", json_string(fmt::format("{:016x}", light.geometry)));
    }
    for (const LightNumber& number : numbers)
        json_add(json, number.key, json_number(light.*number.member));
    for (const LightVector& vector : vectors)
        json_add(json, vector.key, vector_json(light.*vector.member));
    Json emitters = json_array();
    for (const LightEmitter& emitter : light.emitters) {
        Json item = json_object();
        json_add(item, "pattern", json_string(emitter.pattern));
        json_add(item, "color", vector_json(emitter.color));
        if (emitter.window) json_add(item, "window", json_bool(true));
        emitters.items.push_back(std::move(item));
    }
    json_add(json, "emitters", std::move(emitters));
    return json;
}

void read_light(const Json& json, const std::string& path, JsonReader& reader, LevelLight& light) {
    if (!reader.object(json, path)) return;
    if (const Json* value = json.find("image")) read_image(*value, path + "/image", reader, light.image);
    if (const Json* value = json.find("geometry"))
        read_geometry(*value, path + "/geometry", reader, light.geometry);
    for (const LightNumber& number : numbers) {
        if (const Json* value = json.find(number.key))
            reader.number(*value, path + "/" + number.key, number.lowest, number.highest,
                          light.*number.member);
    }
    for (const LightVector& vector : vectors) {
        if (const Json* value = json.find(vector.key))
            reader.vector(*value, path + "/" + vector.key, vector.lowest, brightest, light.*vector.member);
    }
    if (const Json* value = json.find("emitters")) read_emitters(*value, path + "/emitters", reader, light);
}

std::set<std::string_view> light_keys() {
    std::set<std::string_view> keys{"image", "geometry", "emitters"};
    for (const LightNumber& number : numbers)
        keys.insert(number.key);
    for (const LightVector& vector : vectors)
        keys.insert(vector.key);
    return keys;
}

}  // namespace slipface
