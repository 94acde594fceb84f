// A suite of scenes: levels, cameras, and what is drawn over the levels. The file screenshots/scenes.json:
//
//   { "version": 1,
//     "defaults": { "size": [960, 540], "style": "textured overlay" },
//     "scenes": [
//       { "name": "scenes/easy-iso",
//         "level": "../assets/levels/easy.obj",
//         "camera": "auto:iso",
//         "probe": { "from": [0, 1, 0], "move": [0, 0, -3] },
//         "tape": "../assets/tapes/easy.tape" },
//       { "name": "scenes/easy", "level": "../assets/levels/easy.obj", "cameras": ["auto:iso4", "bookmarks"]
//       } ] }
//
// name: the golden is NAME.png; letters, digits, '-', '_', '@' and '/'.
//
// level, tape: paths relative to the suite file. The levels "demo:NAME:on" and "demo:NAME:off" are the scenes
// of a hack (engine/scenes), with their tape, their camera and the hack's switch on or off. "demo:*" is all
// of them: the snapshots NAME/DEMO-off and NAME/DEMO-on.
//
// camera: one of the names below, or { "eye": [x, y, z], "target": [x, y, z], "fov_deg": 60 }, where fov_deg
// may be left out. Without a camera: "auto:iso".
//
//   auto:iso, iso-back, top, bottom, front, back, left, right   all of the level (named_view)
//   auto:map               "top" with a grid in metres and a scale
//   auto:iso:K             K of 4 corners, counter-clockwise
//   auto:turntable:K/N     K of N directions around the level
//   tape:K/N               behind the player, at K of N moments of the tape
//   contact:K              at the K-th contact of the probe, or of the tape
//   any other word         the level's bookmark with that name
//
// cameras: a list of names. Each gives a snapshot NAME@CAMERA. Beside the names above, these stand for
// several: auto:iso4, auto:turntable:N, tape:N, contacts (each contact, at most 12) and bookmarks (all of the
// level).
//
// size: pixels, 16 to 4096 per side. Without: 960 x 540.
//
// style: any of textured, unlit (without the level's baked light), overlay, wireframe, cutaway (back faces
// not drawn, so that rooms are seen from outside) and grid (metres, with a scale); "plain" means none of
// them. Without: "textured overlay".
//
// probe: one slide_move(), drawn by draw_trace(). "from" may be "spawn". Without "radii" ([x, y, z]) and
// "settings" (["max_slides=5"]), the level's are used.
//
// tape: simulated from its start or the level's spawn. The path of the centre, the start and the end are
// drawn. "settings" beside it are applied after the tape's own.
//
// profile: the gate's tolerance, "scene" (default) or "ui". masks: [[x, y, width, height], ...], areas that
// are not compared.
//
// A row of another program has, instead of a level and what is drawn over it, one of these:
//
//   "command": "build/demo --frames 3"   a line for the shell, run in the suite's folder. It writes PNGs into
//                                        the folder that the variable SLIPFACE_CAPTURE names, and NAME.json
//                                        beside NAME.png: { "numbers": { "NAME": VALUE }, "widgets": {
//                                        "NAME": [x, y, width, height] }, "renderer": { ... } }, each of
//                                        which may be left out (slipface/capture.h writes both)
//   "images": "shots"                    a folder that has such files
//
// frames: what the command writes, ["menu", "map"]: the snapshots NAME/menu and NAME/map. Without: one image.
// Those of a folder are NAME/FILE. seconds: how long the command may take; without: 60. Files that the
// command names are its inputs, but not those that can be executed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "goldens/golden.h"
#include "slipface/view/camera.h"
#include "slipface/view/level_style.h"

namespace slipface {

struct SceneProbe {
    std::optional<Vec3> from;  // nothing: the level's spawn
    Vec3 move = Vec3::Zero();
    std::optional<Vec3> radii;
    std::vector<std::string> settings;  // "name=value"
};

// What another program shows.
struct OtherProgram {
    std::string command;           // a line for the shell; empty: the images lie in `folder`
    std::filesystem::path folder;  // the command runs there
    std::vector<std::string> frames;
    std::string frame;  // the one of this snapshot; empty: the only one
    int seconds = 60;
};

struct Scene {
    std::string name;
    std::optional<OtherProgram> program;  // then there is no level
    std::filesystem::path level;
    std::variant<std::string, Camera> camera = "auto:iso";
    int width = 960;
    int height = 540;
    LevelStyle style;
    bool grid = false;
    std::optional<SceneProbe> probe;
    std::optional<std::filesystem::path> tape;
    std::vector<std::string> settings;  // "name=value", for the tape
    CompareTolerance tolerance = scene_tolerance;
    std::vector<MaskRect> masks;
    std::vector<std::string> cameras;  // not expanded yet; if there are any, `camera` is ignored
    std::string location;              // "scenes.json:/scenes/2", for errors
};

// Errors name the file and the JSON path ("scenes.json:/scenes/2/size"), or the line of text that is no JSON.
// Unknown keys and duplicate names are errors.
Result<std::vector<Scene>> parse_scene_suite(std::string_view text, const std::filesystem::path& file);
Result<std::vector<Scene>> load_scene_suite(const std::filesystem::path& file);

}  // namespace slipface
