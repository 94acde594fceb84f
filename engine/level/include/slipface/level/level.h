// A level: immutable geometry, and all annotations that Slipface adds to it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/collision/collision_world.h"
#include "slipface/level/goal.h"
#include "slipface/level/level_light.h"
#include "slipface/level/level_mesh.h"
#include "slipface/level/platform.h"
#include "slipface/level/prop.h"
#include "slipface/mesh/import.h"
#include "slipface/movement/heightfield.h"
#include "slipface/movement/settings.h"
#include "slipface/movement/surface_type.h"

namespace slipface {

// Gives the type `type` to the faces whose material name matches `pattern`. Wildcards are '*' and '?'; case
// is ignored, ' ' equals '_', and an ending like ".001" is ignored. The last matching rule wins. A rule that
// names an unknown type is ignored.
struct MaterialRule {
    std::string pattern;
    std::string type;
    friend bool operator==(const MaterialRule&, const MaterialRule&) = default;
};

inline constexpr std::size_t max_material_rules = 100'000;  // of a level

struct CameraBookmark {
    std::string name;
    Vec3 eye = Vec3::Zero();
    Vec3 target = Vec3::Zero();
    double fov_y = 1.0471975511965976;  // radians
    friend bool operator==(const CameraBookmark&, const CameraBookmark&) = default;
};

// A position at which a player may start.
struct Spawn {
    Vec3 position = Vec3::Zero();  // centre of the player
    double yaw = 0.0;              // radians, 0 looks along -Z, counter-clockwise seen from above
    std::string name = "start";
    friend bool operator==(const Spawn&, const Spawn&) = default;
};
inline constexpr std::size_t max_spawns = 10'000;  // of a level

// Identifies a face by its geometry, never by its index, so that the face is found again after another tool
// changed the file. Centroid and area are rounded to float and the normal to four decimals, so that writing
// and reading a key does not change it.
struct FaceKey {
    std::uint64_t loop_hash =
        0;  // of the corner positions rounded to 1e-5 m, independent of the starting corner
    Vec3 centroid = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    double area = 0.0;
    std::string material;
    std::uint32_t copy =
        0;  // number among the faces with the same corners and material, in file order; 0: the first
    friend bool operator==(const FaceKey&, const FaceKey&) = default;
};
FaceKey face_key(const Mesh& mesh, FaceId face);  // with copy = 0

// An override whose face was not found. It stays in the file and is listed in the editor.
struct Orphan {
    FaceKey key;
    std::string type;
    friend bool operator==(const Orphan&, const Orphan&) = default;
};

// A named set of faces that can be selected again.
struct SavedSelection {
    std::string name;
    std::vector<FaceId> faces;  // ascending
    friend bool operator==(const SavedSelection&, const SavedSelection&) = default;
};
inline constexpr std::size_t max_saved_selections = 1000;  // of a level

// Why a face has its type.
enum class SurfaceSource : std::uint8_t { none, rule, suffix, prop, override_ };
const char* surface_source_name(SurfaceSource source);

// Terrain from a 16-bit greyscale PNG: columns of pixels run along +X, rows along +Z.
struct HeightfieldSource {
    std::string file;            // relative to the level file's folder
    Vec3 origin = Vec3::Zero();  // world position of the first pixel; its y is added to every height
    Vec2 size{100.0, 100.0};     // metres from the first to the last pixel along x and z
    double low = 0.0;            // height of the value 0, metres above origin.y
    double high = 10.0;          // height of the value 65535
    friend bool operator==(const HeightfieldSource&, const HeightfieldSource&) = default;
};

// The level's position in the world, and the world's division into sectors (MovementSettings::sectors).
struct SectorLayout {
    double size = 0.0;              // edge of a sector, metres; 0: no sectors
    Vec3 placement = Vec3::Zero();  // world position of the level's origin
    friend bool operator==(const SectorLayout&, const SectorLayout&) = default;
};

// Unknown keys of the file, preserved and written back: an object that maps a location ("/",
// "/surfaces/ice", "/cameras/door") to the unknown members there, as compact JSON text.
struct UnknownKeys {
    std::string json = "{}";
    friend bool operator==(const UnknownKeys&, const UnknownKeys&) = default;
};

// The props of a level as part of its geometry.
struct PlacedProps {
    std::vector<PropMesh> meshes;    // each file once, in alphabetical order
    std::vector<FaceId> first_face;  // [prop + 1] in Level::mesh; a missing mesh has no faces
    // The prop that a face belongs to, or no_id.
    std::uint32_t prop_of(FaceId face) const;
};

struct Level {
    std::filesystem::path mesh_path;  // the OBJ
    std::filesystem::path file_path;  // NAME.slipface.json beside it, whether it exists or not
    // All geometry: the faces of the OBJ, and after them those of the props (place_props()). Faces of props
    // can be painted, hidden and selected like all others.
    LevelMesh mesh;
    ImportTransform import_transform;  // the user's choice of scale and upward axis
    ImportSummary import_summary;      // how the mesh was made from the file's coordinates; not stored
    FileStamp mesh_stamp;              // of mesh_path when it was read

    std::vector<SurfaceType> surfaces = preset_surface_types();
    std::vector<MaterialRule> rules;
    // [face]; empty: unset, which differs from `default`, as are all faces beyond the list.
    std::vector<std::optional<SurfaceId>> overrides;
    std::vector<Orphan> orphans;
    // State of the editing. Movement ignores it: hidden faces collide too.
    std::vector<FaceId> hidden;  // ascending; neither drawn nor picked
    // Painted faces whose type was found by doubtful matching, and which the user has not accepted yet;
    // ascending.
    std::vector<FaceId> guessed;
    std::vector<SavedSelection> selections;
    // The main spawn, which is used unless another one is named, and the others. A spawn may lie inside a
    // wall: find_start() computes the position at which the player really starts.
    Vec3 spawn = Vec3::Zero();  // centre of the player
    double spawn_yaw = 0.0;     // radians, as Spawn::yaw
    std::string spawn_name = "start";
    bool spawn_is_set = true;  // false: no main spawn, see has_spawn(), and no others
    std::vector<Spawn> more_spawns;
    // Height below which a player has fallen out of the level, metres. Empty: 60 m below the lower of the
    // start and the lowest static point (run_start()).
    std::optional<double> fall_limit;
    std::vector<CameraBookmark> cameras;
    std::vector<Goal> goals;
    MovementSettings movement;
    std::vector<Platform> platforms;
    std::vector<Prop> props;
    PlacedProps placed;  // made from `props` by place_props(); not stored
    std::optional<HeightfieldSource> heightfield;
    std::shared_ptr<const Heightfield> terrain;  // made from `heightfield` by load_terrain(); may be null
    SectorLayout sectors;
    std::optional<LevelLight> light;  // empty: drawn with the renderer's own light
    UnknownKeys unknown;
};

// Reads the meshes of the level's props, unless level.placed has them, and gives level.mesh their faces after
// the OBJ's. A mesh that is missing, outside the folder of the level's geometry or damaged, and props that
// would exceed the triangles that collision takes, are warnings: the props stay in the list without faces.
Warnings place_props(Level& level);
bool has_instances(const Level& level);  // false: level.mesh is another than place_props() made
const PropMesh* find_prop_mesh(const Level& level, std::string_view file);  // null: no prop names it
// The faces of one prop alone, where it stands; null: it has none.
MeshPtr prop_mesh(const Level& level, std::size_t prop);
TriangleId prop_first_triangle(const Level& level, std::size_t prop);  // in the level
Aabb prop_bounds(const Level& level, std::size_t prop);                // empty: it has no faces
// Whether a platform with this group moves anything.
bool has_group(const Level& level, std::string_view group);
// The geometry without the props.
const MeshPtr& own_mesh(const Level& level);
// The same level whose OBJ alone is its geometry, without the props and what belongs to their faces.
Level without_props(const Level& level);
// The same level whose props are faces of its geometry like all others: for other programs.
Level with_flat_props(const Level& level);

// The type of each face, and its source. An override out of range of Level::surfaces counts as unset. Empty
// for a level without a mesh.
struct ResolvedSurfaces {
    std::vector<SurfaceId> surface;     // [face] override, else its prop's, suffix, rule, default
    std::vector<SurfaceSource> source;  // [face]
};
ResolvedSurfaces resolve_surfaces(const Level& level);

// [prop][face of its mesh]; null: the prop has no faces.
using PropSurfaces = std::vector<std::shared_ptr<const ResolvedSurfaces>>;

// The same in parts: props of one mesh with the same types share a list.
struct SurfaceParts {
    ResolvedSurfaces own;  // of the faces that belong to no prop
    PropSurfaces props;
};
SurfaceParts resolve_parts(const Level& level);
PropSurfaces resolve_props(const Level& level);                // SurfaceParts::props without overrides
void paint_props(const Level& level, PropSurfaces& surfaces);  // with them
ResolvedSurfaces joined(const SurfaceParts& parts);
// The instances of the props whose faces fulfil `wanted(prop)`, for a collision world that has the OBJ's
// triangles first; `offset` moves them. None without has_instances().
std::vector<Instance> prop_instances(const Level& level, const SurfaceParts& types, const Vec3& offset,
                                     const std::function<bool(std::size_t)>& wanted);

// Whether the material name `material` matches the pattern of a rule or of a light emitter (MaterialRule).
bool material_matches(std::string_view pattern, std::string_view material);

// The preset type of that name; if there is none, a new type of that name that is not solid. For type names
// that a game's file (a Quake map) uses.
SurfaceType found_surface_type(std::string_view name);

// The level's type with exactly this name, or nothing.
std::optional<SurfaceId> find_surface(const Level& level, std::string_view name);

// A collision world of all faces of the level's mesh, as modelled, with the resolved types. Errors: the level
// has no mesh, or its triangles cannot be built.
Result<CollisionWorld> build_collision_world(const Level& level);
// Updates the types in `world`, after types, rules or overrides of the level changed.
void apply_surfaces(CollisionWorld& world, const Level& level);

}  // namespace slipface
