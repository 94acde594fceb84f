// The words of the level file, for reader and writer alike.
//
// {
//   "slipface": 1,                                  (2 if a surface type has a friction other than 1)
//   "mesh": "easy.obj",
//   "scale": 0.01, "up": "z",                   (metres a unit of the file, its upward axis; if not 1 and y)
//   "spawn": {"name": "start", "position": [0, 1, 0], "yaw": 0},     (without a name: "start"; if there is
//   one) "spawns": [{"name": "roof", "position": [...], "yaw": 0}],        (further ones, if there are any)
//   "fall_limit": -20,                                                (if it is not the usual one)
//   "surfaces": [{"name": "ice", "color": [...], "hatch": "diagonal", "hotkey": 2, ...one key a
//   surface_fields() row}], "rules": [{"pattern": "*ice*", "type": "ice"}], "overrides": [{"type": "ice",
//   "material": "stone", "faces": ["HASH CENTROID NORMAL AREA [COPY]", ...],
//                                       "packed": [...base64, where many faces are painted...]}],
//   "orphans": [...as overrides],
//   "hidden": [...as overrides, without "type"],                                        (if there are any)
//   "selections": [{"name": "stairs", "faces": [...as overrides, without "type"]}],     (if there are any)
//   "cameras": [{"name": "door", "eye": [...], "target": [...], "fov_y": 1.0472}],
//   "movement": {...one key a settings_table() row},           (basic_settings() where a key is missing)
//   "light": {"image": "easy.light.png", "geometry": "HASH", "texel": 0.25, "sun_direction": [...], ...,
//             "emitters": [{"pattern": "lava*", "color": [...]}]}
// }
#pragma once

#include <map>
#include <set>
#include <string>

#include "face_match.h"
#include "json_reader.h"
#include "json_text.h"

namespace slipface {

// What is written: 2 if a surface type has a friction other than 1, else 1, so that older programs read what
// they understand. In version 1 "friction" was the fraction of the speed along a surface that a bounce keeps.
inline constexpr int level_file_version = 2, plain_level_file_version = 1;

// The text of the file as it is written at `file_path`, which decides how it names the mesh.
std::string level_text(const Level& level, const std::filesystem::path& file_path);

Result<LoadedLevel> read_level(const Json& root, const std::string& location, MeshPtr mesh);
Result<ImportTransform> read_import_transform(const Json& root, const std::string& location);

// Refuses what is no level file of the version that is understood.
Status check_level_version(const Json& root, const std::string& location);

Json light_json(const LevelLight& light);
// Takes the known members out of `json`; errors go to `reader`.
void read_light(const Json& json, const std::string& path, JsonReader& reader, LevelLight& light);
// The members that light_json writes.
std::set<std::string_view> light_keys();

// A painted face as one short text: loop hash, centroid, normal, area, and the copy if it is not 0.
std::string face_row_text(const FaceKey& key);
bool parse_face_row(std::string_view text, FaceKey& key);  // leaves the material

// Unknown members by place. Things of one kind are found again by name, so they keep their members when
// others come and go; of several with one name the second is "NAME#2".
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
