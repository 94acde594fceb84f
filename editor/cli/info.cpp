#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <span>

#include "cli/format.h"
#include "cli/verbs.h"
#include "slipface/base/counted.h"
#include "slipface/base/named_file.h"
#include "slipface/image/image.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"
#include "slipface/mesh/facing_doubt.h"
#include "slipface/mesh/open_edges.h"
#include "slipface/mesh/rig.h"
#include "slipface/mesh/size_doubt.h"
#include "slipface/mesh/texture_file.h"
#include "slipface/mesh/up_doubt.h"

namespace slipface::cli {
namespace {

struct LevelInfo {
    LoadedLevel loaded;
    std::vector<std::size_t> faces_of_type, triangles_of_type;  // [SurfaceId]
    double load_s = 0.0;
    double bvh_s = 0.0;
    BvhStatistics bvh;
    Start start;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Reports each image once that is missing or that the editor would not draw by its header. The pictures
// themselves are not decoded, which would take most of the time.
void add_texture_warnings(LoadedLevel& loaded) {
    constexpr std::size_t maximum = 100;
    Warnings found;
    const std::filesystem::path folder = loaded.level.mesh_path.parent_path();
    std::set<std::string> known;
    for (const Material& material : loaded.level.mesh->materials) {
        if (material.texture.empty() || !known.insert(material.texture).second) continue;
        const std::string location = location_of(material);
        const Result<TextureBytes> read = read_texture(material, folder);
        if (!read) {
            found.push_back({location, read.error().message});
            continue;
        }
        if (!read->note.empty()) found.push_back({location, read->note});
        if (const Status status = check_image_header(read->bytes, read->location); !status)
            found.push_back({location, status.error().text()});
    }
    const std::optional<LevelLight>& light = loaded.level.light;
    if (light && !light->image.empty()) {
        const NamedFile image = named_file(light->image, loaded.level.file_path.parent_path());
        if (!image)
            found.push_back({image.path.string(), image.error().message + "; drawn without baked light"});
        else if (!light_fits(*loaded.level.mesh, *light))
            found.push_back({image.path.string(),
                             "was baked for other geometry and is not drawn; bake it again with \"slipface "
                             "bake-light\""});
    }
    const std::size_t listed = std::min(found.size(), maximum);
    loaded.warnings.insert(loaded.warnings.end(), found.begin(),
                           found.begin() + static_cast<std::ptrdiff_t>(listed));
    if (found.size() > listed)
        loaded.warnings.push_back({loaded.level.mesh_path.string(),
                                   fmt::format("{} more textures cannot be used", found.size() - listed)});
}

Result<LevelInfo> gather(const std::filesystem::path& path) {
    LevelInfo info;
    const auto start = std::chrono::steady_clock::now();
    Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return loaded.error();
    info.load_s = seconds_since(start);
    info.loaded = std::move(*loaded);
    add_texture_warnings(info.loaded);

    const Level& level = info.loaded.level;
    const auto bvh_start = std::chrono::steady_clock::now();
    const Result<CollisionWorld> world = build_collision_world(level);
    if (!world) return world.error();
    info.bvh_s = seconds_since(bvh_start);
    info.bvh = world->statistics();

    Result<LevelScene> scene = LevelScene::borrow(level, *world, level.movement);
    if (!scene) return scene.error();
    const Result<Start> begin = find_start(level, *scene, level.movement);
    if (!begin) return begin.error();
    info.start = *begin;

    info.faces_of_type.resize(level.surfaces.size());
    info.triangles_of_type.resize(level.surfaces.size());
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    for (FaceId face = 0; face < level.mesh.face_count(); ++face) {
        const SurfaceId surface = resolved.surface[face];
        ++info.faces_of_type[surface];
        info.triangles_of_type[surface] += level.mesh->face_corner_count(face) - 2;
    }
    return info;
}

std::size_t painted_count(const Level& level) {
    std::size_t count = 0;
    for (const auto& surface : level.overrides)
        count += surface ? 1 : 0;
    return count;
}

// The names of the objects or groups that have faces, in the order of the file.
OutputJson objects_json(const Mesh& mesh) {
    std::vector<bool> used(mesh.groups.size());
    for (const std::uint32_t group : mesh.face_group)
        used[group] = true;
    OutputJson names = OutputJson::array();
    for (std::size_t group = 0; group < used.size(); ++group)
        if (used[group]) names.push_back(mesh.groups[group]);
    return names;
}

double bytes_a_triangle(const LevelInfo& info) {
    const std::size_t triangles = info.loaded.level.mesh.triangle_count();
    return triangles == 0 ? 0.0 : static_cast<double>(info.bvh.bytes) / static_cast<double>(triangles);
}

// Of the geometry's own file; those of props are the props'.
std::span<const Clip> clips_of(const Level& level) {
    const MeshPtr& mesh = own_mesh(level);
    return mesh && mesh->rig ? std::span<const Clip>(mesh->rig->clips) : std::span<const Clip>();
}

void print_info_json(const LevelInfo& info, std::ostream& out) {
    const Level& level = info.loaded.level;
    const Mesh& mesh = *level.mesh;
    OutputJson json;
    json["level"] = level.mesh_path.string();
    json["fingerprint"] = hash_text(mesh.fingerprint);
    json["faces"] = mesh.face_count();
    json["triangles"] = mesh.triangle_count();
    json["vertices"] = mesh.positions.size();
    json["materials"] = mesh.materials.size();
    json["props"] = level.props.size();
    json["clips"] = OutputJson::array();
    for (const Clip& clip : clips_of(level))
        json["clips"].push_back({{"name", clip.name}, {"seconds", clip.seconds}});
    json["faces_per_type"] = OutputJson::object();
    for (std::size_t i = 0; i < level.surfaces.size(); ++i) {
        json["faces_per_type"][level.surfaces[i].name] = info.faces_of_type[i];
    }
    json["triangles_per_type"] = OutputJson::object();
    for (std::size_t i = 0; i < level.surfaces.size(); ++i)
        json["triangles_per_type"][level.surfaces[i].name] = info.triangles_of_type[i];
    json["objects"] = objects_json(mesh);
    json["painted_faces"] = painted_count(level);
    json["guessed_faces"] = level.guessed.size();
    json["faces_of_two_readings"] = info.loaded.second.faces.size();
    json["orphans"] = level.orphans.size();
    json["bounds"] = {{"min", vector_json(mesh.bounds.min)}, {"max", vector_json(mesh.bounds.max)}};
    json["spawns"] = OutputJson::array();
    for (const Spawn& spawn : all_spawns(level))
        json["spawns"].push_back(
            {{"name", spawn.name}, {"position", vector_json(spawn.position)}, {"yaw", spawn.yaw}});
    json["start"] = {{"position", vector_json(info.start.position)},
                     {"yaw", info.start.yaw},
                     {"stands", info.start.stands},
                     {"note", info.start.note}};
    const ImportSummary& read = level.import_summary;
    json["import"] = {{"size_m", vector_json(read.size)},
                      {"scale", read.scale},
                      {"scale_from", import_source_names[static_cast<std::size_t>(read.scale_from)]},
                      {"scale_reason", read.scale_reason},
                      {"up", up_axis_names[static_cast<std::size_t>(read.up)]},
                      {"up_from", import_source_names[static_cast<std::size_t>(read.up_from)]},
                      {"up_reason", read.up_reason}};
    if (const auto doubt = size_doubt(mesh, read)) {
        json["import"]["doubt"] = doubt->text();
        json["import"]["better_scale"] = doubt->better_scale;
    }
    if (const auto doubt = up_doubt(mesh, read)) {
        json["import"]["up_doubt"] = doubt->text();
        json["import"]["better_up"] = up_axis_names[static_cast<std::size_t>(doubt->better_up)];
    }
    json["import"]["flip"] = level.import_transform.flip;
    if (const auto doubt = facing_doubt(mesh)) json["import"]["facing_doubt"] = doubt->text();
    json["spawns_in_file"] = OutputJson::array();
    for (const FoundSpawn& spawn : info.loaded.found_spawns)
        json["spawns_in_file"].push_back(
            {{"name", spawn.name}, {"feet", vector_json(spawn.feet)}, {"yaw", spawn.yaw}});
    json["open_edges"] = open_edge_count(mesh);
    json["undrawn_faces"] = info.loaded.undrawn.size();
    json["load_s"] = info.load_s;
    json["bvh_s"] = info.bvh_s;
    json["bvh_bytes"] = info.bvh.bytes;
    json["bvh_bytes_a_triangle"] = bytes_a_triangle(info);
    json["bvh_nodes"] = info.bvh.nodes;
    json["bvh_depth"] = info.bvh.depth;
    json["warnings"] = OutputJson::array();
    for (const Diagnostic& warning : info.loaded.warnings) {
        json["warnings"].push_back({{"location", warning.location}, {"message", warning.message}});
    }
    print_json(out, json);
}

// How the file was read, as the editor's card shows it.
void print_import(const LevelInfo& info, std::ostream& out) {
    const Level& level = info.loaded.level;
    const ImportSummary& read = level.import_summary;
    const auto assumed = [](ImportSource source, const std::string& reason) {
        const std::string_view name = import_source_names[static_cast<std::size_t>(source)];
        return source == ImportSource::given ? std::string(name) : fmt::format("{}: {}", name, reason);
    };
    print_row(out, "size",
              fmt::format("{:.3f} x {:.3f} x {:.3f} m", read.size.x(), read.size.y(), read.size.z()));
    if (const auto doubt = size_doubt(*level.mesh, read)) print_row(out, "", doubt->text());
    print_row(out, "scale",
              fmt::format("{:.6g} m per unit ({})", read.scale, assumed(read.scale_from, read.scale_reason)));
    print_row(out, "up axis",
              fmt::format("{} ({})", up_axis_names[static_cast<std::size_t>(read.up)],
                          assumed(read.up_from, read.up_reason)));
    if (const auto doubt = up_doubt(*level.mesh, read)) print_row(out, "", doubt->text());
    const auto facing = facing_doubt(*level.mesh);
    if (facing || level.import_transform.flip)
        print_row(out, "faces", level.import_transform.flip ? "flipped (given)" : "as in the file");
    if (facing)
        print_row(out, "",
                  fmt::format("{}; \"slipface import {}\" turns all faces", facing->text(),
                              level.import_transform.flip ? "--flip no" : "--flip yes"));
    if (const std::size_t count = info.loaded.found_spawns.size(); count > 0)
        print_row(out, "spawns in file", std::to_string(count));
    print_row(out, "open edges", std::to_string(open_edge_count(*level.mesh)));
    if (const std::size_t count = info.loaded.undrawn.size(); count > 0)
        print_row(out, "undrawn faces", std::to_string(count));
}

void print_info_text(const LevelInfo& info, std::ostream& out) {
    const Level& level = info.loaded.level;
    const Mesh& mesh = *level.mesh;
    print_row(out, "level", level.mesh_path.string());
    print_row(out, "faces", std::to_string(mesh.face_count()));
    print_row(out, "triangles", std::to_string(mesh.triangle_count()));
    print_row(out, "materials", std::to_string(mesh.materials.size()));
    const std::span<const Clip> clips = clips_of(level);
    for (std::size_t i = 0; i < clips.size(); ++i)
        print_row(out, i == 0 ? "clips" : "", fmt::format("{}  {:.3g} s", clips[i].name, clips[i].seconds));
    if (!level.props.empty())
        print_row(out, "props",
                  fmt::format("{} of {} meshes", level.props.size(), level.placed.meshes.size()));
    print_row(out, "bounds min", vector_text(mesh.bounds.min) + "  m");
    print_row(out, "bounds max", vector_text(mesh.bounds.max) + "  m");
    const std::vector<Spawn> spawns = all_spawns(level);
    constexpr std::size_t max_spawns = 10;
    for (std::size_t i = 0; i < std::min(max_spawns, spawns.size()); ++i)
        print_row(out, i == 0 ? "spawns" : "",
                  spawns[i].name + "  " + vector_text(spawns[i].position) + "  m");
    if (spawns.size() > max_spawns)
        print_row(out, "", fmt::format("and {} more", spawns.size() - max_spawns));
    print_row(out, "player begins", vector_text(info.start.position) + "  m");
    if (!info.start.note.empty()) print_row(out, "", info.start.note);
    print_import(info, out);
    print_row(out, "loaded in", duration_text(info.load_s));
    print_row(out, "BVH built in",
              fmt::format("{}, {}, {:.1f} bytes per triangle", duration_text(info.bvh_s),
                          bytes_text(info.bvh.bytes), bytes_a_triangle(info)));
    print_row(out, "painted faces", fmt::format("{} ({})", painted_count(level), info.loaded.match.text()));
    if (const std::size_t differ = info.loaded.second.faces.size(); differ > 0)
        print_row(out, "",
                  fmt::format("the geometry fits two readings of the paint, which differ in {}; open the "
                              "level in the editor to choose",
                              counted(differ, "face")));
    out << "\nfaces per type\n";
    for (std::size_t i = 0; i < level.surfaces.size(); ++i) {
        out << fmt::format("  {:<14}{:>9}\n", level.surfaces[i].name, info.faces_of_type[i]);
    }
    if (info.loaded.warnings.empty()) return;
    out << "\nwarnings\n";
    for (const Diagnostic& warning : info.loaded.warnings)
        out << "  " << warning.text() << '\n';
}

}  // namespace

int run_info(const InfoOptions& options, std::ostream& out, std::ostream& err) {
    const Result<LevelInfo> info = gather(options.level);
    if (!info) return bad_input(err, info.error());
    options.json ? print_info_json(*info, out) : print_info_text(*info, out);
    return exit_fine;
}

}  // namespace slipface::cli
