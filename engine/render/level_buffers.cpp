// Uploads the level to the graphics card: programs, vertices, lines.
#include <algorithm>
#include <array>
#include <cstddef>

#include "gl_util.h"
#include "level_renderer_impl.h"
#include "level_shaders.h"
#include "line_shaders.h"

namespace slipface {

namespace {

constexpr std::size_t triangles_per_upload = std::size_t{1} << 16U;

}  // namespace

void LevelRenderer::Impl::build_programs() {
    const auto link = [&](const char* name, const std::string& vertex, const std::string& fragment) {
        Result<unsigned> program = link_program(*gl, name, vertex, fragment);
        if (program) return *program;
        if (status) status = program.error();
        return 0U;
    };
    if (only_faces) return;
    background_program = link("background", background_vertex_shader, background_fragment_shader);
    if (const Result<unsigned> plain = level_programs->get(0); !plain && status) status = plain.error();
    line_program = link("line", line_vertex_shader, line_fragment_shader);
}

void LevelRenderer::Impl::build_objects() {
    gl->GenVertexArrays(1, &empty_array);
    gl->GenVertexArrays(1, &level_array);
    gl->GenBuffers(1, &level_buffer);
    gl->BindVertexArray(level_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, level_buffer);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    constexpr GLsizei stride = sizeof(LevelVertex);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(LevelVertex, position)));
    gl->VertexAttribPointer(1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, stride,
                            offset(offsetof(LevelVertex, normal)));
    gl->VertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(LevelVertex, uv)));
    gl->VertexAttribIPointer(3, 1, GL_UNSIGNED_INT, stride, offset(offsetof(LevelVertex, face)));
    gl->VertexAttribPointer(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(LevelVertex, color)));
    for (unsigned attribute = 0; attribute < 5; ++attribute)
        gl->EnableVertexAttribArray(attribute);
    gl->BindVertexArray(0);
    for (LineBuffer* lines : {&borders, &selected_outline, &hovered_outline}) {
        gl->GenVertexArrays(1, &lines->vertex_array);
        gl->GenBuffers(1, &lines->buffer);
        describe_line_instances(*gl, lines->vertex_array, lines->buffer);
    }
    for (unsigned* texture : {&table_texture, &white_texture}) {
        gl->GenTextures(1, texture);
        gl->BindTexture(GL_TEXTURE_2D, *texture);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    constexpr std::array<std::uint8_t, 4> white{255, 255, 255, 255};
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, white.data());
    gl->BindTexture(GL_TEXTURE_2D, 0);
}

// Vertices are made and uploaded in pieces, so that a large level is not in memory twice.
bool LevelRenderer::Impl::upload_geometry(const Mesh& from, Warnings& warnings) {
    const DrawOrder order = draw_order(from, textures.material_texture(), textures.count());
    while (gl->GetError() != GL_NO_ERROR) {
    }
    const std::size_t bytes = 3 * order.triangles.size() * sizeof(LevelVertex);
    gl->BindBuffer(GL_ARRAY_BUFFER, level_buffer);
    gl->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
    if (gl->GetError() != GL_NO_ERROR) {
        warnings.push_back({"graphics", "no memory for " + std::to_string(order.triangles.size()) +
                                            " triangles (" + std::to_string(bytes >> 20U) +
                                            " MiB); nothing is drawn"});
        return false;
    }
    std::vector<LevelVertex> vertices;
    vertices.reserve(std::min(3 * order.triangles.size(), 3 * triangles_per_upload));
    for (std::size_t first = 0; first < order.triangles.size(); first += triangles_per_upload) {
        const std::size_t count = std::min(triangles_per_upload, order.triangles.size() - first);
        vertices.clear();
        append_vertices(from, std::span(order.triangles).subspan(first, count), origin, vertices);
        gl->BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(3 * first * sizeof(LevelVertex)),
                          static_cast<GLsizeiptr>(vertices.size() * sizeof(LevelVertex)), vertices.data());
    }
    batches = order.batches;
    if (&from != mesh.get()) rig = std::make_unique<RigBuffers>(gl, level_array, *mesh, order);
    return true;
}

void LevelRenderer::Impl::find_moving(std::span<const std::uint32_t> face_parts) {
    parts.assign(face_parts.begin(), face_parts.end());
    moving.clear();
    if (!mesh || parts.empty()) return;
    const DrawOrder order = draw_order(*mesh, textures.material_texture(), textures.count());
    for (std::size_t i = 0; i < order.triangles.size(); ++i) {
        const FaceId face = mesh->triangle_face[order.triangles[i]];
        const std::uint32_t part = face < parts.size() ? parts[face] : no_id;
        if (part == no_id) continue;
        const bool goes_on = !moving.empty() && moving.back().part == part &&
                             moving.back().first + moving.back().triangles.size() == i;
        if (!goes_on) moving.push_back({.part = part, .first = i, .triangles = {}});
        moving.back().triangles.push_back(order.triangles[i]);
    }
}

void LevelRenderer::Impl::reset_faces() {
    const std::size_t faces = mesh ? mesh->face_count() : 0;
    highlights.assign(faces, 0);
    surfaces_shown = highlights_shown = false;
    face_state.resize(faces);
    upload_lines(selected_outline, {});
    upload_lines(hovered_outline, {});
}

void LevelRenderer::Impl::upload_lines(LineBuffer& lines, const std::vector<LineInstance>& instances) {
    gl->BindBuffer(GL_ARRAY_BUFFER, lines.buffer);
    gl->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size() * sizeof(LineInstance)),
                   instances.data(), GL_STATIC_DRAW);
    lines.count = static_cast<GLsizei>(instances.size());
}

}  // namespace slipface
