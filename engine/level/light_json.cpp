// The light of a level in its file.

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "json_parts.h"
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

void read_geometry(const JsonNode& node, std::uint64_t& out) {
    std::string text;
    if (!node.text(text)) return;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
    if (error != std::errc() || end != text.data() + text.size() || text.size() != 16)
        node.fail(json_quoted(text), "16 hexadecimal digits");
}

LightEmitter read_emitter(const JsonNode& node) {
    LightEmitter emitter;
    if (!node.object()) return emitter;
    const JsonNode pattern = node.need("pattern"), color = node.need("color");
    pattern.text(emitter.pattern);
    color.vector(0.0, brightest, emitter.color);
    node["window"].boolean(emitter.window);
    return emitter;
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
    json_add(json, "emitters", json_array_of(light.emitters, [](const LightEmitter& emitter) {
                 Json item = json_object(
                     {{"pattern", json_string(emitter.pattern)}, {"color", vector_json(emitter.color)}});
                 if (emitter.window) json_add(item, "window", json_bool(true));
                 return item;
             }));
    return json;
}

void read_light(const JsonNode& node, LevelLight& light) {
    if (!node.object()) return;
    node["image"].text(light.image);
    read_geometry(node["geometry"], light.geometry);
    for (const LightNumber& number : numbers)
        node[number.key].number(number.lowest, number.highest, light.*number.member);
    for (const LightVector& vector : vectors)
        node[vector.key].vector(vector.lowest, brightest, light.*vector.member);
    node["emitters"].each(max_emitters,
                          [&](const JsonNode& emitter) { light.emitters.push_back(read_emitter(emitter)); });
}

}  // namespace slipface
