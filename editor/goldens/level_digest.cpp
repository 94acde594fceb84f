#include "goldens/level_digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <numeric>

#include "goldens/numbers_json.h"
#include "slipface/base/bytes.h"
#include "slipface/base/hash.h"
#include "slipface/image/pack.h"
#include "slipface/level/level_file.h"

namespace slipface {

namespace {

constexpr std::string_view magic = "slipface-digest 2\n";
constexpr std::size_t largest_digest = std::size_t{256} << 20U;  // unpacked

using Writer = ByteWriter<std::uint32_t>;
using Reader = ByteReader<std::uint32_t>;

// Differences of neighbours compress better than the numbers.
void put_ascending(Writer& out, std::vector<std::uint32_t> numbers) {
    std::adjacent_difference(numbers.begin(), numbers.end(), numbers.begin());
    out.put_list(numbers);
}

std::vector<std::uint32_t> get_ascending(Reader& in) {
    std::vector<std::uint32_t> numbers = in.get_list<std::uint32_t>();
    std::partial_sum(numbers.begin(), numbers.end(), numbers.begin());
    return numbers;
}

// False if an index is out of range.
bool consistent(const Mesh& mesh, std::size_t faces_with_surface) {
    const std::size_t faces = mesh.face_material.size(), corners = mesh.corner_vertex.size();
    const auto below = [](const auto& list, std::size_t limit) {
        return std::all_of(list.begin(), list.end(), [&](std::uint32_t i) { return i < limit; });
    };
    const auto offsets = [&](const std::vector<std::uint32_t>& list, std::size_t total) {
        return list.size() == faces + 1 && list.front() == 0 && list.back() == total &&
               std::is_sorted(list.begin(), list.end());
    };
    if (mesh.materials.empty() || mesh.groups.empty()) return false;
    if (mesh.face_group.size() != faces || faces_with_surface != faces) return false;
    if (!below(mesh.corner_vertex, mesh.positions.size()) ||
        !below(mesh.face_material, mesh.materials.size()) || !below(mesh.face_group, mesh.groups.size()) ||
        !below(mesh.triangle_face, faces))
        return false;
    if (!offsets(mesh.face_first_corner, corners) ||
        !offsets(mesh.face_first_triangle, mesh.triangles.size()))
        return false;
    for (const auto& triangle : mesh.triangles)
        if (!below(triangle, corners)) return false;
    return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                       [](const Vec3f& p) { return p.allFinite(); });
}

// Triangle corners are stored relative to their face's first corner: small, repeated numbers.
void write_mesh(Writer& out, const Mesh& mesh) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float> values;
        for (const Vec3f& position : mesh.positions)
            values.push_back(position[axis]);
        out.put_list(values);
    }
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<float> values;
        for (const Vec2f& uv : mesh.corner_uv)
            values.push_back(uv[axis]);
        out.put_list(values);
    }
    out.put_list(mesh.corner_vertex);
    put_ascending(out, mesh.face_first_corner);
    out.put_list(mesh.face_material);
    out.put_list(mesh.face_group);
    put_ascending(out, mesh.face_first_triangle);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            out.put(corner - mesh.face_first_corner[mesh.triangle_face[i]]);
    out.put(static_cast<std::uint32_t>(mesh.materials.size()));
    for (const Material& material : mesh.materials) {
        out.put_text(material.name);
        out.put_text(material.texture);
        for (int c = 0; c < 3; ++c)
            out.put(material.diffuse[c]);
    }
    out.put(static_cast<std::uint32_t>(mesh.groups.size()));
    for (const std::string& group : mesh.groups)
        out.put_text(group);
    out.put(mesh.fingerprint);
}

bool read_triangles(Reader& in, Mesh& mesh) {
    const std::size_t faces = mesh.face_material.size();
    if (!in.ok || mesh.face_first_triangle.size() != faces + 1 || mesh.face_first_corner.size() != faces + 1)
        return false;
    for (FaceId face = 0; face < faces; ++face) {
        const std::uint32_t first = mesh.face_first_triangle[face], last = mesh.face_first_triangle[face + 1];
        if (last < first || last > max_digest_triangles) return false;
        for (std::uint32_t i = first; i < last; ++i) {
            std::array<std::uint32_t, 3> corners{};
            for (std::uint32_t& corner : corners)
                corner = mesh.face_first_corner[face] + in.get<std::uint32_t>();
            mesh.triangles.push_back(corners);
            mesh.triangle_face.push_back(face);
        }
    }
    return in.ok;
}

bool read_mesh(Reader& in, Mesh& mesh) {
    std::array<std::vector<float>, 3> axes;
    for (auto& axis : axes)
        axis = in.get_list<float>();
    if (axes[1].size() != axes[0].size() || axes[2].size() != axes[0].size()) return false;
    for (std::size_t i = 0; i < axes[0].size(); ++i) {
        mesh.positions.emplace_back(axes[0][i], axes[1][i], axes[2][i]);
        mesh.bounds.add(mesh.positions.back().cast<double>());
    }
    const std::vector<float> u = in.get_list<float>(), v = in.get_list<float>();
    mesh.corner_vertex = in.get_list<std::uint32_t>();
    if (u.size() != v.size() || u.size() != mesh.corner_vertex.size()) return false;
    for (std::size_t corner = 0; corner < u.size(); ++corner)
        mesh.corner_uv.emplace_back(u[corner], v[corner]);
    mesh.face_first_corner = get_ascending(in);
    mesh.face_material = in.get_list<std::uint32_t>();
    mesh.face_group = in.get_list<std::uint32_t>();
    mesh.face_first_triangle = get_ascending(in);
    if (!read_triangles(in, mesh)) return false;
    for (auto count = in.get<std::uint32_t>(); in.ok && count > 0; --count) {
        Material material;
        material.name = in.get_text();
        material.texture = in.get_text();
        for (int c = 0; c < 3; ++c)
            material.diffuse[c] = in.get<float>();
        mesh.materials.push_back(std::move(material));
    }
    for (auto count = in.get<std::uint32_t>(); in.ok && count > 0; --count)
        mesh.groups.push_back(in.get_text());
    mesh.fingerprint = in.get<std::uint64_t>();
    return in.ok;
}

}  // namespace

std::string annotations_json(const Level& level) {
    Level bare = with_flat_props(level);
    bare.overrides.assign(level.mesh.face_count(), std::nullopt);
    bare.orphans.clear();
    bare.unknown = {};
    return level_to_json(bare);
}

std::uint64_t appearance_hash(const Mesh& mesh) {
    Hasher hasher;
    hasher.bytes(mesh.corner_uv.data(), mesh.corner_uv.size() * sizeof(Vec2f));
    for (const Material& material : mesh.materials) {
        hasher.u64(material.name.size());
        hasher.text(material.name);
        hasher.u64(material.texture.size());
        hasher.text(material.texture);
        hasher.bytes(material.diffuse.data(), sizeof(Vec3f));
    }
    return hasher.value();
}

std::string digest_name(const Level& level) {
    Hasher hasher;
    if (level.mesh) {
        hasher.u64(level.mesh.fingerprint());
        hasher.u64(appearance_hash(*level.mesh));
    }
    const std::vector<SurfaceId> surfaces = resolve_surfaces(level).surface;
    hasher.bytes(surfaces.data(), surfaces.size());
    hasher.text(annotations_json(level));
    std::string stem;
    for (const char c : level.mesh_path.stem().string()) {
        const bool kept =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        stem += kept ? c : '-';
    }
    return stem.substr(0, 60) + "-" + hex_text(hasher.value());
}

Result<std::string> encode_digest(const Level& level) {
    if (!level.mesh) return Error{"digest", "the level has no geometry"};
    if (level.mesh.triangle_count() > max_digest_triangles)
        return Error{"digest", fmt::format("the level has {} triangles; a digest stores at most {}",
                                           level.mesh.triangle_count(), max_digest_triangles)};
    Writer out;
    out.put_text(annotations_json(level));
    out.put_list(resolve_surfaces(level).surface);
    write_mesh(out, *level.mesh);
    std::string bytes(magic);
    const auto size = static_cast<std::uint64_t>(out.bytes.size());
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    return bytes + pack(out.bytes, pack_smallest);
}

Result<Level> decode_digest(std::string_view bytes, const std::string& location) try {
    const Error damaged{location,
                        "is damaged, expected a level's digest; `slipface snapshot approve` writes it again"};
    std::uint64_t size = 0;
    if (!bytes.starts_with(magic) || bytes.size() < magic.size() + sizeof size) return damaged;
    std::memcpy(&size, bytes.data() + magic.size(), sizeof size);
    if (size > largest_digest) return damaged;
    const auto unpacked = unpack(bytes.substr(magic.size() + sizeof size), static_cast<std::size_t>(size));
    if (!unpacked) return damaged;
    Reader in(*unpacked);
    const std::string json = in.get_text();
    const std::vector<SurfaceId> surfaces = in.get_list<SurfaceId>();
    auto mesh = std::make_shared<Mesh>();
    if (!read_mesh(in, *mesh) || !in.at_end() || !consistent(*mesh, surfaces.size())) return damaged;
    Result<LoadedLevel> loaded = level_from_json(json, location, mesh);
    if (!loaded) return loaded.error();
    Level level = std::move(loaded->level);
    level.overrides.assign(surfaces.begin(), surfaces.end());
    return level;
} catch (const std::exception&) {
    return Error{location, "is damaged, or needs more memory than there is"};
}

}  // namespace slipface
