#include <algorithm>
#include <bit>
#include <limits>

#include "export_parts.h"

namespace slipface {
namespace {

constexpr std::size_t name_size = 32;

void put_u32(std::string& bytes, std::size_t value) {
    for (int i = 0; i < 4; ++i)
        bytes.push_back(static_cast<char>(value >> (8 * i)));
}

void put_f32(std::string& bytes, double value) {
    put_u32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

// Appends the name, cut at a whole UTF-8 character and always zero-terminated.
void put_name(std::string& bytes, std::string name) {
    std::size_t size = std::min(name.size(), name_size - 1);
    while (size < name.size() && size > 0 && (static_cast<unsigned char>(name[size]) & 0xC0) == 0x80)
        --size;
    name.resize(size);
    name.resize(name_size, '\0');
    bytes += name;
}

// Calls number(name, value) for each number of a type, three times for a vector.
template <class Number>
void for_each_number(const SurfaceType& type, const Number& number) {
    for (const SurfaceField& field : surface_fields()) {
        const std::string name = field.name;
        if (const auto* flag = std::get_if<bool SurfaceType::*>(&field.member)) {
            number(name, type.**flag ? 1.0 : 0.0);
        } else if (const auto* value = std::get_if<double SurfaceType::*>(&field.member)) {
            number(name, type.**value);
        } else if (const auto* vector = std::get_if<Vec3 SurfaceType::*>(&field.member)) {
            for (int axis = 0; axis < 3; ++axis)
                number(name + "." + "xyz"[axis], (type.**vector)[axis]);
        } else if (const auto* maybe = std::get_if<std::optional<double> SurfaceType::*>(&field.member)) {
            number(name, (type.**maybe).value_or(std::numeric_limits<double>::quiet_NaN()));
        }
    }
}

std::string flat_bytes(const Level& level) {
    const Mesh& mesh = *level.mesh;
    std::string fields;
    std::size_t field_count = 0;
    for_each_number(level.surfaces.front(), [&](const std::string& name, double) {
        put_name(fields, name);
        ++field_count;
    });

    std::string bytes = "slipflat";
    for (const std::size_t count :
         {std::size_t{1}, level.surfaces.size(), field_count, mesh.positions.size(), mesh.triangle_count()})
        put_u32(bytes, count);
    bytes += fields;
    for (const SurfaceType& type : level.surfaces) {
        put_name(bytes, type.name);
        for_each_number(type, [&](const std::string&, double value) { put_f32(bytes, value); });
    }
    for (const Vec3f& position : mesh.positions)
        for (const float coordinate : position)
            put_f32(bytes, static_cast<double>(coordinate));
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            put_u32(bytes, mesh.corner_vertex[corner]);
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    for (const FaceId face : mesh.triangle_face)
        bytes.push_back(static_cast<char>(resolved.surface[face]));
    return bytes;
}

}  // namespace

Result<std::vector<ExportedFile>> flat_files(const Level& level, const std::filesystem::path& path) {
    return std::vector<ExportedFile>{{path, flat_bytes(level)}};
}

}  // namespace slipface
