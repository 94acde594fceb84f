#include "snapshots/staged_level.h"

#include <algorithm>
#include <cmath>

#include "goldens/level_digest.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/named_file.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/mesh/texture_file.h"
#include "slipface/scenes/demo.h"

namespace slipface {

namespace {

std::uint64_t text_hash(const std::string& text) {
    Hasher hasher;
    hasher.text(text);
    return hasher.value();
}

// Hashes of all image files that the level is drawn with, including the baked light.
Numbers textures_json(const Level& level) {
    Numbers textures = Numbers::object();
    if (level.light && !level.light->image.empty()) {
        const NamedFile file = named_file(level.light->image, level.file_path.parent_path());
        const Result<std::string> bytes = file ? read_file(file.path) : Result<std::string>(file.error());
        textures[level.light->image] = hex_text(text_hash(bytes ? *bytes : std::string()));
    }
    for (const Material& material : level.mesh->materials) {
        if (material.texture.empty() || textures.contains(material.texture)) continue;
        const Result<TextureBytes> read = read_texture(material, level.mesh_path.parent_path());
        textures[material.texture] = hex_text(text_hash(read ? read->bytes : std::string()));
    }
    return textures;
}

Numbers materials_json(const Mesh& mesh) {
    Numbers materials = Numbers::object();
    for (const Material& material : mesh.materials) {
        Vec3 color = material.diffuse.cast<double>() * 1e6;
        for (double& part : color)
            part = std::round(part) / 1e6;
        materials[material.name] = {{"color", json_of(color)}, {"texture", material.texture}};
    }
    return materials;
}

// The types with all their parameters, and the rest of what the level file says and a scene shows or plays:
// not the faces' types and materials' rules, which have numbers of their own, and not what is only for the
// editor or for other scenes.
void add_file(Numbers& numbers, const Level& level) {
    Numbers file = Numbers::parse(annotations_json(level), nullptr, false);
    Numbers types = Numbers::object();
    for (Numbers& type : file["surfaces"]) {
        const std::string name = type["name"];
        type.erase("name");
        type.erase("hotkey");
        types[name] = std::move(type);
    }
    numbers["types"] = std::move(types);
    for (const char* key : {"slipface", "mesh", "overrides", "orphans", "rules", "cameras", "movement",
                            "goals", "hidden", "selections", "surfaces", "parts"})
        file.erase(key);
    numbers["file"] = std::move(file);
}

Numbers level_numbers(const Level& level) {
    Numbers numbers;
    numbers["name"] = level.mesh_path.stem().string();
    numbers["mesh"] = hex_text(level.mesh.fingerprint());
    numbers["digest"] = "";
    numbers["faces"] = level.mesh.face_count();
    numbers["triangles"] = level.mesh.triangle_count();
    numbers["bounds"] = Numbers::array({json_of(level.mesh.bounds().min), json_of(level.mesh->bounds.max)});
    std::vector<std::size_t> counts(level.surfaces.size(), 0);
    for (const SurfaceId surface : resolve_surfaces(level).surface)
        if (surface < counts.size()) ++counts[surface];
    Numbers types = Numbers::object();
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0) types[level.surfaces[i].name] = counts[i];
    numbers["surfaces"] = types;
    numbers["textures"] = textures_json(level);
    numbers["appearance"] = hex_text(appearance_hash(*level.mesh));
    numbers["materials"] = materials_json(*level.mesh);
    add_file(numbers, level);
    if (level.light && !level.light->image.empty())
        numbers["light_drawn"] = light_fits(*level.mesh, *level.light);
    return numbers;
}

bool all_solid(const Level& level) {
    return std::all_of(level.surfaces.begin(), level.surfaces.end(),
                       [](const SurfaceType& surface) { return surface.solid; });
}

}  // namespace

Result<std::unique_ptr<StagedLevel>> stage_level(Level level) {
    if (!level.mesh) return Error{level.mesh_path.string(), "has no geometry"};
    auto staged = std::make_unique<StagedLevel>();
    staged->level = std::move(level);
    Result<CollisionWorld> world = build_collision_world(staged->level);
    if (!world) return world.error();
    staged->collision = *std::move(world);
    if (!all_solid(staged->level)) {
        const Mesh& mesh = *staged->level.mesh;
        std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
        for (auto& triangle : triangles)
            for (std::uint32_t& corner : triangle)
                corner = mesh.corner_vertex[corner];
        Result<CollisionWorld> geometry =
            CollisionWorld::build({mesh.positions, triangles, mesh.triangle_face});
        if (!geometry) return geometry.error();
        staged->geometry = *std::move(geometry);
    }
    staged->numbers = level_numbers(staged->level);
    if (staged->level.mesh.triangle_count() <= max_digest_triangles)
        staged->digest = digest_name(staged->level);
    staged->numbers["digest"] = staged->digest;
    return staged;
}

namespace {

Result<std::unique_ptr<StagedLevel>> stage_demo(std::string_view text) {
    const std::vector<std::string_view> words = split(text, ':');
    const DemoInfo* info = words.size() == 3 ? find_demo(words[1]) : nullptr;
    if (info == nullptr || (words[2] != "on" && words[2] != "off")) {
        std::string names;
        for (const DemoInfo& demo : demo_table())
            names += (names.empty() ? "" : ", ") + std::string(demo.name);
        return Error{std::string(text),
                     "is no demo; expected demo:NAME:on or demo:NAME:off, with NAME one of " + names};
    }
    Demo demo = make_demo(*info);
    demo.level.movement = words[2] == "on" ? demo.on : demo.off;
    Result<std::unique_ptr<StagedLevel>> staged = stage_level(std::move(demo.level));
    if (staged) (*staged)->tape = std::move(demo.tape);
    return staged;
}

}  // namespace

Result<std::unique_ptr<StagedLevel>> load_staged_level(const std::filesystem::path& path) {
    if (const std::string text = path.string(); text.starts_with(demo_prefix)) return stage_demo(text);
    Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return loaded.error();
    return stage_level(std::move(loaded->level));
}

}  // namespace slipface
