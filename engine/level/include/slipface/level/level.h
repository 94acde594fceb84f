// A level: immutable geometry, and everything that Slipface adds to it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/collision/collision_world.h"
#include "slipface/level/level_light.h"
#include "slipface/level/platform.h"
#include "slipface/mesh/import.h"
#include "slipface/movement/heightfield.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/surface_type.h"

namespace slipface {

// Faces whose material name matches `pattern` ('*' and '?', upper and lower case alike, ' ' and '_' alike,
// ".001" endings ignored) have type `type`. Of several rules that match, the last one counts; a rule whose
// type does not exist never does.
struct MaterialRule {
    std::string pattern;
    std::string type;
    friend bool operator==(const MaterialRule&, const MaterialRule&) = default;
};

struct CameraBookmark {
    std::string name;
    Vec3 eye = Vec3::Zero();
    Vec3 target = Vec3::Zero();
    double fov_y = 1.0471975511965976;  // radians
    friend bool operator==(const CameraBookmark&, const CameraBookmark&) = default;
};

// Where a player may begin.
struct Spawn {
    Vec3 position = Vec3::Zero();  // centre of the player
    double yaw = 0.0;              // radians, 0 looks along -Z, counter-clockwise seen from above
    std::string name = "start";
    friend bool operator==(const Spawn&, const Spawn&) = default;
};
inline constexpr std::size_t max_spawns = 10'000;  // of a level

// Where a face lies, for finding it again after the file was changed by another tool. Never an index.
// Centroid and area have the digits of a float and the normal four decimals, so that a key survives a file
// unchanged.
struct FaceKey {
    std::uint64_t loop_hash =
        0;  // of the corner positions rounded to 1e-5 m, independent of the starting corner
    Vec3 centroid = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    double area = 0.0;
    std::string material;
    std::uint32_t copy =
        0;  // which one of several faces with the same corners and material (0: the first of the file)
    friend bool operator==(const FaceKey&, const FaceKey&) = default;
};
FaceKey face_key(const Mesh& mesh, FaceId face);  // with copy = 0

// An override that found no face. Kept in the file, listed in the editor, never dropped.
struct Orphan {
    FaceKey key;
    std::string type;
    friend bool operator==(const Orphan&, const Orphan&) = default;
};

// Faces kept under a name, to be selected again.
struct SavedSelection {
    std::string name;
    std::vector<FaceId> faces;  // ascending
    friend bool operator==(const SavedSelection&, const SavedSelection&) = default;
};
inline constexpr std::size_t max_saved_selections = 1000;  // of a level

// Why a face has its type.
enum class SurfaceSource : std::uint8_t { none, rule, suffix, override_ };
const char* surface_source_name(SurfaceSource source);

// Terrain from a grey 16-bit PNG: columns of pixels lie along +X, rows along +Z.
struct HeightfieldSource {
    std::string file;            // relative to the level file's folder
    Vec3 origin = Vec3::Zero();  // world position of the first pixel; its y is added to every height
    Vec2 size{100.0, 100.0};     // metres from the first to the last pixel along x and z
    double low = 0.0;            // height of the value 0, metres above origin.y
    double high = 10.0;          // height of the value 65535
    friend bool operator==(const HeightfieldSource&, const HeightfieldSource&) = default;
};

// Where in the world the level lies, and how the world is divided (MovementSettings::sectors).
struct SectorLayout {
    double size = 0.0;              // edge of a sector, metres; 0: no sectors
    Vec3 placement = Vec3::Zero();  // world position of the level's origin
    friend bool operator==(const SectorLayout&, const SectorLayout&) = default;
};

// Unknown keys of the file, kept and written back: an object from the place ("/", "/surfaces/ice",
// "/cameras/door") to the unknown members there, as compact JSON text.
struct UnknownKeys {
    std::string json = "{}";
    friend bool operator==(const UnknownKeys&, const UnknownKeys&) = default;
};

struct Level {
    std::filesystem::path mesh_path;  // the OBJ
    std::filesystem::path file_path;  // NAME.slipface.json beside it, whether it exists or not
    MeshPtr mesh;
    ImportTransform import_transform;  // what the user says of the file's coordinates
    ImportSummary import_summary;      // how the mesh was made of them; not stored
    FileStamp mesh_stamp;              // of mesh_path when it was read

    std::vector<SurfaceType> surfaces = preset_surface_types();
    std::vector<MaterialRule> rules;
    std::vector<std::optional<SurfaceId>> overrides;  // [face]; nothing: unset, which differs from `default`
    std::vector<Orphan> orphans;
    // Where the work on the level stands: for editors alone, a face collides whether hidden or not.
    std::vector<FaceId> hidden;  // ascending; neither drawn nor picked
    std::vector<SavedSelection> selections;
    // The main spawn, where a player begins unless another is asked for, and the others. find_start() says
    // where a player really begins, because a spawn may lie inside a wall.
    Vec3 spawn = Vec3::Zero();  // centre of the player
    double spawn_yaw = 0.0;     // radians, as Spawn::yaw
    std::string spawn_name = "start";
    bool spawn_is_set = true;  // false: nobody has chosen one; then there are no others either
    std::vector<Spawn> more_spawns;
    // Height below which a player has fallen out of the level, metres. Nothing: 60 m below its lowest point.
    std::optional<double> fall_limit;
    std::vector<CameraBookmark> cameras;
    MovementSettings movement;
    std::vector<Platform> platforms;
    std::optional<HeightfieldSource> heightfield;
    std::shared_ptr<const Heightfield> terrain;  // what load_terrain made of `heightfield`; may be null
    SectorLayout sectors;
    std::optional<LevelLight> light;  // nothing: drawn with the renderer's own light
    UnknownKeys unknown;
};

// The type of each face, and where it comes from. An override that is no type of the level counts as unset.
struct ResolvedSurfaces {
    std::vector<SurfaceId> surface;     // [face] what counts: override, else suffix, else rule, else default
    std::vector<SurfaceSource> source;  // [face]
};
ResolvedSurfaces resolve_surfaces(const Level& level);

// Whether a face of `material` has what a rule, or an emitter of light, gives to `pattern`.
bool material_matches(std::string_view pattern, std::string_view material);

// A type for a name that a game's file uses: the preset of that name, else one that is not solid.
SurfaceType found_surface_type(std::string_view name);

std::optional<SurfaceId> find_surface(const Level& level, std::string_view name);

// A collision world of the level's mesh with the resolved surfaces and rules applied.
Result<CollisionWorld> build_collision_world(const Level& level);
void apply_surfaces(CollisionWorld& world, const Level& level);  // after types or faces changed

}  // namespace slipface
