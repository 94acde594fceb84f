// The format of the level file, for reader and writer. Members marked (*) are left out if not needed.
//
// {
//   "slipface": 1,                                  (2 if a surface type has a friction other than 1)
//   "mesh": "easy.obj",
//   "scale": 0.01, "up": "z",    (*) metres per unit of the file, upward axis
//   "flip": true,                (*) the faces look the other way than in the file
//   "spawn": {"name": "start", "position": [0, 1, 0], "yaw": 0},    (*) without a name: "start"
//   "spawns": [{"name": "roof", "position": [...], "yaw": 0}],      (*) further ones
//   "fall_limit": -20,                                              (*)
//   "surfaces": [{"name": "ice", "color": [...], "hatch": "diagonal", "hotkey": 2,
//                 ...one key per surface_fields() row}],
//   "rules": [{"pattern": "*ice*", "type": "ice"}],
//   "overrides": [{"type": "ice", "material": "stone", "faces": ["HASH CENTROID NORMAL AREA [COPY]", ...],
//                  "packed": [...base64, if many faces are painted...]}],
//   "parts": {...},                             (*) see json_paint.h
//   "orphans": [...as overrides],
//   "hidden": [...as overrides, without "type"],                                       (*)
//   "selections": [{"name": "stairs", "faces": [...as overrides, without "type"]}],    (*)
//   "cameras": [{"name": "door", "eye": [...], "target": [...], "fov_y": 1.0472}],
//   "goals": [{"name": "roof", "kind": "reach", "position": [...], "radius": 1,        (*)
//              "within_s": 20, "from": "start", "settings": ["dash=off"]}],          (the last three: *)
//   "movement": {...one key per settings_table() row; a missing one has its value of basic_settings()},
//   "light": {"image": "easy.light.png", "geometry": "HASH", "texel": 0.25, "sun_direction": [...], ...,
//             "emitters": [{"pattern": "lava*", "color": [...]}]},                     (*)
//   "platforms", "props", "heightfield", "sectors": see json_parts.h                   (*)
// }
#pragma once

#include <map>
#include <string>

#include "face_match.h"
#include "json_reader.h"
#include "json_text.h"

namespace slipface {

// What is written: 2 if a surface type has a friction other than 1, else 1, so that older programs read what
// they understand. In version 1 "friction" was the fraction of the speed along a surface that a bounce keeps.
inline constexpr int level_file_version = 2, plain_level_file_version = 1;

// The text of the level's file. `file_path` decides how the text names the mesh: relative or absolute.
std::string level_text(const Level& level, const std::filesystem::path& file_path,
                       LevelText written = LevelText::whole);

// The level in a file's JSON, applied to `mesh`. `location` names the file in errors and warnings. The meshes
// of its props are those of `known`, or read from the folder of `mesh_path`; without one, of the mesh that
// the file names.
struct PropSource {
    std::filesystem::path mesh_path;
    std::vector<PropMesh> known;
};
Result<LoadedLevel> read_level(const Json& root, const std::string& location, MeshPtr mesh,
                               PropSource props = {});
Result<ImportTransform> read_import_transform(const Json& root, const std::string& location);

// Error: `root` is no level file of level_file_version.
Status check_level_version(const Json& root, const std::string& location);

Json light_json(const LevelLight& light);
void read_light(const JsonNode& node, LevelLight& light);

// A painted face in one line: loop hash, centroid, normal, area, and the copy if it is not 0.
std::string face_row_text(const FaceKey& key);
// False if `text` is no such line. Does not set the material.
bool parse_face_row(std::string_view text, FaceKey& key);

// Unknown members by location. Objects of one kind are identified by name, so their members stay with them
// when others are added or removed. The second object with the same name is "NAME#2".
class UnknownMembers {
  public:
    static UnknownMembers parse(const UnknownKeys& keys);
    UnknownKeys text() const;

    std::string location(std::string_view kind, std::string_view name);  // "/surfaces/ice"; counts the names
    void add(const std::string& location, std::string_view key, const Json& value);
    void append_to(Json& object, const std::string& location) const;

  private:
    std::map<std::string, Json> objects_;
    std::map<std::string, int> names_;
};

}  // namespace slipface
