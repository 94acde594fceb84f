#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "goldens/camera_names.h"
#include "goldens/suite.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {

namespace {

using Json = nlohmann::json;

constexpr std::size_t max_scenes = 10000;
constexpr std::uint64_t max_suite_bytes = std::uint64_t{16} << 20U;
constexpr int smallest_side = 16, largest_side = 4096;

// Thrown inside this file only: the first error ends the parsing.
struct Refusal {
    Error error;
};

[[noreturn]] void refuse(const std::string& location, const std::string& message) {
    throw Refusal{{location, message}};
}

std::string shown(const Json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

[[noreturn]] void refuse_type(const std::string& location, const Json& value, const char* expected) {
    refuse(location, fmt::format("found {}, expected {}", shown(value), expected));
}

const Json& member(const Json& object, const std::string& location, const char* key) {
    const auto found = object.find(key);
    if (found == object.end()) refuse(location, fmt::format("has no \"{}\"", key));
    return *found;
}

std::string text_of(const Json& value, const std::string& location) {
    if (!value.is_string()) refuse_type(location, value, "text");
    return value.get<std::string>();
}

double number_of(const Json& value, const std::string& location, double minimum, double maximum) {
    if (value.is_number()) {
        const double number = value.get<double>();
        if (number >= minimum && number <= maximum) return number;
    }
    refuse(location,
           fmt::format("found {}, expected a number from {} to {}", shown(value), minimum, maximum));
}

Vec3 vec3_of(const Json& value, const std::string& location) {
    if (!value.is_array() || value.size() != 3) refuse_type(location, value, "three numbers [x, y, z]");
    Vec3 result;
    for (std::size_t i = 0; i < 3; ++i) {
        result[static_cast<Eigen::Index>(i)] =
            number_of(value[i], fmt::format("{}/{}", location, i), -1e7, 1e7);
    }
    return result;
}

void only_keys(const Json& object, const std::string& location, std::initializer_list<const char*> allowed) {
    if (!object.is_object()) refuse_type(location, object, "an object");
    for (const auto& [key, value] : object.items()) {
        const bool known = std::any_of(allowed.begin(), allowed.end(),
                                       [&key = key](const char* name) { return key == name; });
        if (known) continue;
        std::string names;
        for (const char* name : allowed)
            names += (names.empty() ? "" : ", ") + std::string(name);
        refuse(fmt::format("{}/{}", location, key), "is unknown, expected one of: " + names);
    }
}

std::filesystem::path path_of(const Json& value, const std::string& location,
                              const std::filesystem::path& folder) {
    const std::string text = text_of(value, location);
    if (text.empty() || text.find('\0') != std::string::npos) refuse(location, "found no usable path");
    if (text.starts_with("demo:")) return text;
    return (folder / text).lexically_normal();
}

std::variant<std::string, Camera> camera_of(const Json& value, const std::string& location) {
    if (value.is_string()) {
        std::string name = value.get<std::string>();
        if (const auto wrong = wrong_camera_name(name)) refuse(location, *wrong);
        return name;
    }
    if (!value.is_object()) refuse_type(location, value, "a name or {\"eye\": ..., \"target\": ...}");
    only_keys(value, location, {"eye", "target", "fov_deg"});
    Camera camera;
    camera.eye = vec3_of(member(value, location, "eye"), location + "/eye");
    camera.target = vec3_of(member(value, location, "target"), location + "/target");
    if (camera.eye == camera.target) refuse(location, "eye and target are the same point");
    if (value.contains("fov_deg")) {
        camera.fov_y =
            number_of(value["fov_deg"], location + "/fov_deg", 1.0, 170.0) * std::numbers::pi / 180.0;
    }
    return camera;
}

void set_style(Scene& scene, const Json& value, const std::string& location) {
    LevelStyle& style = scene.style;
    style = {};
    scene.grid = false;
    style.textured = false;
    style.overlay = 0.0f;
    const std::string text = text_of(value, location);
    for (const std::string_view word : split(text, ' ')) {
        if (word.empty() || word == "plain") continue;
        if (word == "textured") {
            style.textured = true;
        } else if (word == "unlit") {
            style.baked_light = false;
        } else if (word == "overlay") {
            style.overlay = LevelStyle{}.overlay;
        } else if (word == "wireframe") {
            style.wireframe = true;
        } else if (word == "cutaway") {
            style.back_faces = false;
        } else if (word == "grid") {
            scene.grid = true;
        } else {
            refuse(location,
                   fmt::format(
                       "found \"{}\", expected plain, textured, unlit, overlay, wireframe, cutaway or grid",
                       word));
        }
    }
}

std::vector<std::string> settings_of(const Json& value, const std::string& location) {
    if (!value.is_array()) refuse_type(location, value, "an array of \"name=value\"");
    std::vector<std::string> settings;
    MovementSettings scratch;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string here = fmt::format("{}/{}", location, i);
        settings.push_back(text_of(value[i], here));
        const Status status = set_setting(scratch, settings.back());
        if (!status) refuse(here, status.error().text());
    }
    return settings;
}

std::vector<MaskRect> masks_of(const Json& value, const std::string& location) {
    if (!value.is_array()) refuse_type(location, value, "an array of [x, y, width, height]");
    std::vector<MaskRect> masks;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string here = fmt::format("{}/{}", location, i);
        if (!value[i].is_array() || value[i].size() != 4)
            refuse_type(here, value[i], "four numbers [x, y, width, height]");
        std::array<int, 4> numbers{};
        for (std::size_t k = 0; k < 4; ++k)
            numbers[k] =
                static_cast<int>(number_of(value[i][k], fmt::format("{}/{}", here, k), 0, largest_side));
        masks.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
    }
    return masks;
}

SceneProbe probe_of(const Json& value, const std::string& location) {
    only_keys(value, location, {"from", "move", "radii", "settings"});
    SceneProbe probe;
    const Json& from = member(value, location, "from");
    if (from != "spawn") probe.from = vec3_of(from, location + "/from");
    probe.move = vec3_of(member(value, location, "move"), location + "/move");
    if (value.contains("radii")) {
        probe.radii = vec3_of(value["radii"], location + "/radii");
        if (!(probe.radii->minCoeff() > 0.0)) refuse(location + "/radii", "expected three numbers above 0");
    }
    if (value.contains("settings")) probe.settings = settings_of(value["settings"], location + "/settings");
    return probe;
}

// The members about the image, of a scene or of the suite's defaults.
void read_image(Scene& scene, const Json& value, const std::string& location) {
    if (value.contains("size")) {
        const Json& size = value["size"];
        if (!size.is_array() || size.size() != 2)
            refuse_type(location + "/size", size, "two numbers [width, height]");
        for (const std::size_t i : {0u, 1u}) {
            const std::string here = fmt::format("{}/size/{}", location, i);
            if (!size[i].is_number_integer()) refuse_type(here, size[i], "a whole number of pixels");
            const int side = static_cast<int>(number_of(size[i], here, smallest_side, largest_side));
            (i == 0 ? scene.width : scene.height) = side;
        }
    }
    if (value.contains("style")) set_style(scene, value["style"], location + "/style");
    if (value.contains("profile")) {
        const std::string profile = text_of(value["profile"], location + "/profile");
        if (profile != "scene" && profile != "ui")
            refuse_type(location + "/profile", value["profile"], "\"scene\" or \"ui\"");
        scene.tolerance = profile == "ui" ? ui_tolerance : scene_tolerance;
    }
}

void read_cameras(Scene& scene, const Json& value, const std::string& location) {
    if (value.contains("camera")) refuse(location, "has both \"camera\" and \"cameras\"");
    const Json& list = value["cameras"];
    if (!list.is_array() || list.empty())
        refuse_type(location + "/cameras", list, "an array of camera names");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string here = fmt::format("{}/cameras/{}", location, i);
        scene.cameras.push_back(text_of(list[i], here));
        if (several_cameras(scene.cameras.back())) continue;
        if (const auto wrong = wrong_camera_name(scene.cameras.back())) refuse(here, *wrong);
    }
}

OtherProgram program_of(const Json& value, const std::string& location, const std::filesystem::path& folder) {
    OtherProgram program;
    program.folder = folder;
    if (value.contains("images")) {
        only_keys(value, location, {"name", "images", "profile", "masks"});
        program.folder = path_of(value["images"], location + "/images", folder);
        return program;
    }
    only_keys(value, location, {"name", "command", "frames", "seconds", "profile", "masks"});
    program.command = text_of(value["command"], location + "/command");
    if (trim(program.command).empty()) refuse(location + "/command", "found nothing, expected a command");
    const Json frames = value.value("frames", Json::array());
    if (!frames.is_array()) refuse_type(location + "/frames", frames, "an array of names");
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const std::string here = fmt::format("{}/frames/{}", location, i);
        program.frames.push_back(text_of(frames[i], here));
        if (!valid_snapshot_name(program.frames.back()))
            refuse_type(here, frames[i], "letters, digits, '-', '_', '@' and '/'");
    }
    if (value.contains("seconds"))
        program.seconds = static_cast<int>(number_of(value["seconds"], location + "/seconds", 1, 3600));
    return program;
}

Scene scene_of(const Json& value, const std::string& location, const std::filesystem::path& folder,
               const Scene& defaults) {
    Scene scene = defaults;
    if (value.contains("command") || value.contains("images"))
        scene.program = program_of(value, location, folder);
    else
        only_keys(value, location,
                  {"name", "level", "camera", "cameras", "size", "style", "probe", "tape", "settings",
                   "profile", "masks", "command", "images"});
    scene.location = location;
    scene.name = text_of(member(value, location, "name"), location + "/name");
    if (!valid_snapshot_name(scene.name)) {
        refuse(location + "/name", fmt::format("found {}, expected letters, digits, '-', '_', '@' and '/'",
                                               shown(value["name"])));
    }
    if (!scene.program) scene.level = path_of(member(value, location, "level"), location + "/level", folder);
    if (value.contains("cameras")) read_cameras(scene, value, location);
    if (value.contains("camera")) scene.camera = camera_of(value["camera"], location + "/camera");
    read_image(scene, value, location);
    if (value.contains("probe")) scene.probe = probe_of(value["probe"], location + "/probe");
    if (value.contains("tape")) scene.tape = path_of(value["tape"], location + "/tape", folder);
    if (value.contains("settings")) scene.settings = settings_of(value["settings"], location + "/settings");
    if (value.contains("masks")) scene.masks = masks_of(value["masks"], location + "/masks");
    return scene;
}

// nlohmann's parser keeps the last of equal keys; here the second one is refused. The callback sees every key
// with its depth.
Json parse_json(std::string_view text, const std::string& location) {
    std::vector<std::set<std::string>> keys;
    std::string repeated;
    const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
        const auto level = static_cast<std::size_t>(depth);
        if (event == Json::parse_event_t::object_start) {
            keys.resize(level + 1);
            keys[level].clear();
        } else if (event == Json::parse_event_t::key && level > 0 && level <= keys.size()) {
            const auto& key = parsed.get_ref<const std::string&>();
            if (!keys[level - 1].insert(key).second && repeated.empty()) repeated = key;
        }
        return true;
    };
    try {
        Json json = Json::parse(text, watch);
        if (!repeated.empty()) refuse(location, fmt::format("duplicate key \"{}\"", repeated));
        return json;
    } catch (const Json::parse_error& error) {
        const std::size_t end = std::min(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
        refuse(fmt::format("{}:{}", location, line), "is no JSON here");
    }
}

}  // namespace

Result<std::vector<Scene>> parse_scene_suite(std::string_view text, const std::filesystem::path& file) try {
    const std::string location = file.filename().string();
    const Json json = parse_json(text, location);
    const std::string top = location + ":";
    only_keys(json, top, {"version", "defaults", "scenes"});
    const Json& version = member(json, top, "version");
    if (version != 1) refuse(location + ":/version", fmt::format("found {}, expected 1", shown(version)));
    const Json& list = member(json, top, "scenes");
    if (!list.is_array()) refuse_type(location + ":/scenes", list, "an array");
    if (list.size() > max_scenes)
        refuse(location + ":/scenes", fmt::format("has more than {} scenes", max_scenes));

    Scene defaults;
    if (json.contains("defaults")) {
        only_keys(json["defaults"], location + ":/defaults", {"size", "style", "profile"});
        read_image(defaults, json["defaults"], location + ":/defaults");
    }
    std::vector<Scene> scenes;
    std::set<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string here = fmt::format("{}:/scenes/{}", location, i);
        scenes.push_back(scene_of(list[i], here, file.parent_path(), defaults));
        if (!names.insert(scenes.back().name).second) {
            refuse(here + "/name", fmt::format("\"{}\" comes twice", scenes.back().name));
        }
    }
    return scenes;
} catch (const Refusal& refusal) {
    return refusal.error;
} catch (const std::exception& exception) {
    return Error{file.filename().string(), exception.what()};
}

Result<std::vector<Scene>> load_scene_suite(const std::filesystem::path& file) {
    const Result<std::string> text = read_file(file, max_suite_bytes);
    if (!text) return text.error();
    return parse_scene_suite(*text, file);
}

}  // namespace slipface
