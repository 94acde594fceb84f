#include "goldens/level_facts.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "goldens/face_list.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/image/image.h"
#include "slipface/level/level_file.h"

namespace slipface {

namespace {

std::string hash_text(std::string_view bytes) {
    Hasher hasher;
    hasher.text(bytes);
    return hex_text(hasher.value());
}

// The level file's members, without what is stored as faces, and without what names the format.
Numbers members_json(const Level& level, Numbers& order) {
    Level bare = level;
    bare.overrides.clear();
    bare.orphans.clear();
    bare.unknown = {};
    Numbers members = Numbers::parse(level_to_json(bare, LevelText::without_parts), nullptr, false);
    for (const char* key : {"slipface", "overrides", "orphans", "parts"})
        members.erase(key);
    for (auto& [key, list] : members.items()) {
        const char* const name = key == "rules" ? "pattern" : "name";
        if (!list.is_array() || list.empty() || !list[0].is_object() || !list[0].contains(name)) continue;
        std::map<std::string, Numbers> named;  // sorted, so that files do not differ by order
        Numbers names = Numbers::array();      // a line each, so that branches merge
        for (Numbers& item : list) {
            const auto text = item[name].get<std::string>();
            names.push_back(Numbers::array({text}));
            item.erase(name);
            std::string unique = text;
            for (int copy = 2; named.contains(unique); ++copy)
                unique = fmt::format("{} ({})", text, copy);
            named.emplace(unique, std::move(item));
        }
        order[key] = std::move(names);
        list = Numbers::object();
        for (auto& [text, item] : named)
            list[text] = std::move(item);
    }
    return members;
}

// `type_of(face)` is the name of its type; empty: others decide.
template <class TypeOf>
Numbers objects_json(const Mesh& mesh, const TypeOf& type_of) {
    std::map<std::string, FaceList> objects;
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        FaceFact fact{{}, mesh.materials[mesh.face_material[face]].name, type_of(face)};
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
            const Vec3f p = mesh.corner_position(c);
            fact.corners.push_back({p.x(), p.y(), p.z(), mesh.corner_uv[c].x(), mesh.corner_uv[c].y()});
        }
        objects[mesh.groups[mesh.face_group[face]]].push_back(std::move(fact));
    }
    Numbers json = Numbers::object();
    for (auto& [name, faces] : objects)
        json[name] = face_list_json(std::move(faces));
    return json;
}

// The objects as the file has them.
Numbers names_of(const std::vector<std::string>& groups) {
    Numbers names = Numbers::array();
    for (const std::string& name : groups)
        names.push_back(Numbers::array({name}));
    return names;
}

// Materials that a face has, and the images that they name.
struct Looks {
    std::filesystem::path folder;
    std::map<std::string, Numbers> materials;
    std::map<std::string, std::string> pictures;

    void add_picture(const std::string& name, const std::string* content) {
        if (name.empty() || pictures.contains(name)) return;
        const Result<std::string> bytes = content ? Result(*content) : read_file(folder / name);
        if (!bytes) {
            pictures[name] = "missing";
            return;
        }
        const Result<Image> image = decode_image(*bytes, name);
        pictures[name] = image ? fmt::format("{} x {} {:016x}", image->width, image->height,
                                             hash_blocks(image->rgba.data(), image->rgba.size()))
                               : hash_text(*bytes);
    }
    void add(const Mesh& mesh, const std::string& file) {
        const std::set<std::uint32_t> used(mesh.face_material.begin(), mesh.face_material.end());
        for (const std::uint32_t index : used) {
            const Material& material = mesh.materials[index];
            Vec3 color = material.diffuse.cast<double>() * 1e6;
            for (double& part : color)
                part = std::round(part) / 1e6;
            const std::string name =
                file.empty() ? material.name : fmt::format("{} of {}", material.name, file);
            materials[name] = {{"color", json_of(color)}, {"texture", material.texture}};
            add_picture(material.texture, material.picture.get());
        }
    }
};

Numbers terrain_json(const Heightfield& terrain) {
    const std::string_view bytes(reinterpret_cast<const char*>(terrain.heights.data()),
                                 terrain.heights.size() * sizeof(double));
    Numbers json = {{"columns", terrain.columns}, {"rows", terrain.rows}, {"hash", hash_text(bytes)}};
    if (terrain.heights.size() <= max_packed_corners) json["packed"] = packed_text(bytes);
    return json;
}

// What was painted on faces of props, by the prop's name.
Numbers paint_of_props(const Level& level) {
    std::map<std::string, Hasher> painted;
    for (FaceId face = static_cast<FaceId>(own_mesh(level)->face_count()); face < level.overrides.size();
         ++face) {
        const std::uint32_t prop = level.placed.prop_of(face);
        if (!level.overrides[face] || prop == no_id || prop >= level.props.size()) continue;
        Hasher& hasher = painted[level.props[prop].name];
        hasher.u64(face - level.placed.first_face[prop]);
        if (*level.overrides[face] < level.surfaces.size())
            hasher.text(level.surfaces[*level.overrides[face]].name);
    }
    Numbers json = Numbers::object();
    for (const auto& [name, hasher] : painted)
        json[name] = hex_text(hasher.value());
    return json;
}

}  // namespace

Numbers level_facts(const Level& level, const Warnings& warnings) {
    Numbers facts = {{"version", 2}, {"kind", "level"}}, order = Numbers::object();
    facts["members"] = members_json(level, order);
    const Mesh& own = *own_mesh(level);
    const std::vector<SurfaceId> surfaces = resolve_parts(level).own.surface;
    facts["objects"] = objects_json(own, [&](FaceId face) {
        return surfaces[face] < level.surfaces.size() ? level.surfaces[surfaces[face]].name : "default";
    });
    order["objects"] = names_of(own.groups);
    Looks looks{level.mesh_path.parent_path(), {}, {}};
    looks.add(own, "");
    Numbers meshes = Numbers::object();
    for (const PropMesh& prop : level.placed.meshes) {
        if (!prop.mesh) continue;
        meshes[prop.file] = objects_json(*prop.mesh, [](FaceId) { return ""; });
        looks.add(*prop.mesh, prop.file);
    }
    facts["meshes"] = std::move(meshes);
    if (Numbers paint = paint_of_props(level); !paint.empty()) facts["painted"] = std::move(paint);
    for (const Prop& prop : level.props)
        looks.add_picture(prop.texture, nullptr);
    if (level.light && !level.light->image.empty()) {
        looks.add_picture(level.light->image, nullptr);
        facts["light_fits"] = light_fits(*level.mesh, *level.light);
    }
    facts["materials"] = Numbers::object();
    for (const auto& [name, material] : looks.materials)
        facts["materials"][name] = material;
    facts["pictures"] = Numbers::object();
    for (const auto& [name, hash] : looks.pictures)
        facts["pictures"][name] = hash;
    if (level.terrain) facts["terrain"] = terrain_json(*level.terrain);
    facts["warnings"] = Numbers::array();
    for (const Diagnostic& warning : warnings)
        facts["warnings"].push_back(Numbers::array({warning.message}));
    facts["order"] = std::move(order);
    return facts;
}

std::vector<double> terrain_heights(const Numbers& terrain) {
    const auto bytes =
        terrain.is_object() && terrain.contains("packed") ? unpacked_text(terrain["packed"]) : std::nullopt;
    std::vector<double> heights(bytes ? bytes->size() / sizeof(double) : 0);
    if (!heights.empty()) std::memcpy(heights.data(), bytes->data(), heights.size() * sizeof(double));
    return heights;
}

}  // namespace slipface
