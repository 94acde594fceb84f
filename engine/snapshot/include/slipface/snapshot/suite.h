// A suite of scenes: which level from where, with what drawn over it. Kept as text, screenshots/scenes.json:
//
//   { "version": 1,
//     "scenes": [
//       { "name": "scenes/easy-iso",
//         "level": "../assets/levels/easy.obj",
//         "camera": "auto:iso",
//         "size": [960, 540],
//         "style": "textured overlay",
//         "probe": { "from": [0, 1, 0], "move": [0, 0, -3] },
//         "tape": "../assets/tapes/easy.tape" } ] }
//
// name: the golden is NAME.png; letters, digits, '-', '_' and '/'.
//
// level, tape: relative to the suite file.
//
// camera: "auto:" and a name of named_view, or the name of one of the level's bookmarks, or { "eye": [x, y,
// z], "target": [x, y, z], "fov_deg": 60 }, where fov_deg may be left out. Without a camera: "auto:iso".
//
// size: pixels, 16 to 4096 a side. Without: 960 x 540.
//
// style: any of textured, overlay, wireframe, cutaway (back faces left out, so that rooms are seen from
// outside); "plain" stands for none of them. Without: "textured overlay".
//
// probe: one slide_move, drawn with draw_trace. "from" may be "spawn". "radii" ([x, y, z]) and "settings"
// (["max_slides=5"]) may be given; else the level's count.
//
// tape: simulated from its start or the level's spawn; the path of the centre, the start and the end are
// drawn.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "slipface/render/level_picture.h"
#include "slipface/snapshot/golden.h"

namespace slipface {

struct SceneProbe {
    std::optional<Vec3> from;  // nothing: the level's spawn
    Vec3 move = Vec3::Zero();
    std::optional<Vec3> radii;
    std::vector<std::string> settings;  // "name=value"
};

struct Scene {
    std::string name;
    std::filesystem::path level;
    std::variant<std::string, Camera> camera = "auto:iso";
    int width = 960;
    int height = 540;
    LevelStyle style;
    std::optional<SceneProbe> probe;
    std::optional<std::filesystem::path> tape;
    std::string place;  // "scenes.json:/scenes/2", for errors
};

// Errors name the file and the JSON path ("scenes.json:/scenes/2/size"), or the line for text that is no
// JSON. Keys that are not known and names that come twice are errors.
Result<std::vector<Scene>> parse_scene_suite(std::string_view text, const std::filesystem::path& file);
Result<std::vector<Scene>> load_scene_suite(const std::filesystem::path& file);

// One scene as a picture. Errors of the level, the tape or the camera's name are the scene's.
Result<Image> render_scene(const Scene& scene, OffscreenContext& context);

// The scenes as snapshots. They render in `context`, which must outlive them, and load each level once.
std::vector<Snapshot> scene_snapshots(const std::vector<Scene>& scenes, OffscreenContext& context);

}  // namespace slipface
