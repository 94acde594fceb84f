#include "slipface/render/level_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "face_state.h"
#include "gl_util.h"
#include "level_geometry.h"
#include "level_programs.h"
#include "level_shaders.h"
#include "level_textures.h"
#include "light_map.h"
#include "line_shaders.h"

namespace slipface {

namespace {

constexpr std::uint8_t border_color[4] = {14, 17, 22, 135};
constexpr std::uint8_t selected_color[4] = {255, 166, 64, 255};
constexpr std::uint8_t hovered_color[4] = {255, 255, 255, 235};
constexpr float border_width = 1.2f;
constexpr float outline_width = 2.2f;
constexpr float shortest_border = 2.5f;  // pixels; keeps dense geometry from turning black
constexpr double line_bias = 2.0;        // pixels by which lines lie in front of the faces they border
constexpr std::size_t triangles_per_draw = std::size_t{1} << 15U;
constexpr GLuint64 longest_wait_ns = 100'000'000;
constexpr std::size_t triangles_per_upload = std::size_t{1} << 16U;

struct LineBuffer {
    unsigned vertex_array = 0, buffer = 0;
    GLsizei count = 0;
};

// Triangles of one moving part, side by side in the vertex buffer.
struct MovingRun {
    std::uint32_t part = no_id;
    std::size_t first = 0;
    std::vector<TriangleId> triangles;
};

}  // namespace

struct LevelRenderer::Impl {
    explicit Impl(GlTable table)
        : gl(std::move(table)), textures(gl), face_state(gl), light_map(gl), level_programs(gl) {}

    GlTable gl;
    LevelTextures textures;
    FaceState face_state;
    LightMap light_map;
    LevelPrograms level_programs;
    std::optional<LevelLight> light;
    Status status;
    MeshPtr mesh;
    Vec3 origin = Vec3::Zero();
    std::vector<DrawBatch> batches;
    std::vector<std::uint8_t> highlights;  // [face]
    std::vector<std::uint32_t> parts;      // [face] that moves with it, or no_id; empty: none moves
    std::vector<MovingRun> moving;         // of parts, in drawing order

    bool surfaces_shown = false;  // of some face, other than `default`
    bool highlights_shown = false;

    unsigned background_program = 0, line_program = 0;
    unsigned empty_array = 0, level_array = 0, level_buffer = 0;
    unsigned table_texture = 0, white_texture = 0;
    LineBuffer borders, selected_outline, hovered_outline;
    bool borders_built = false;
    std::optional<OutlineFinder> outlines;

    void build_programs();
    void build_objects();
    bool upload_geometry(Warnings& warnings);
    void find_moving(std::span<const std::uint32_t> face_parts);
    void reset_faces();
    void upload_lines(LineBuffer& lines, const std::vector<LineInstance>& instances);
    bool lit(const LevelStyle& style) const {
        return style.textured && style.baked_light && light_map.loaded();
    }
    void draw_background(const Camera& camera, double aspect, const LevelStyle& style);
    void set_sky(const Camera& camera, double aspect);
    void set_level_uniforms(unsigned program, const Camera& camera, int height, const Mat4f& clip,
                            const LevelStyle& style);
    void draw_faces(const Camera& camera, int height, const Mat4f& clip, const LevelStyle& style);
    void draw_in_pieces(const DrawBatch& batch);
    void draw_lines(const LineBuffer& lines, float shortest);
    void reset_state(int width, int height);
    void draw_level(const Camera& camera, int width, int height, const LevelStyle& style);
    Eigen::Vector4f eye_uniform(const Camera& camera) const;
};

void LevelRenderer::Impl::build_programs() {
    const auto link = [&](const char* name, const std::string& vertex, const std::string& fragment) {
        Result<unsigned> program = link_program(*gl, name, vertex, fragment);
        if (program) return *program;
        if (status) status = program.error();
        return 0U;
    };
    background_program = link("background", background_vertex_shader, background_fragment_shader);
    if (const Result<unsigned> plain = level_programs.get(0); !plain && status) status = plain.error();
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

// Vertices are made and sent piece by piece, so that a large level does not need its geometry twice in
// memory.
bool LevelRenderer::Impl::upload_geometry(Warnings& warnings) {
    const DrawOrder order = draw_order(*mesh, textures.material_texture(), textures.count());
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
        append_vertices(*mesh, std::span(order.triangles).subspan(first, count), origin, vertices);
        gl->BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(3 * first * sizeof(LevelVertex)),
                          static_cast<GLsizeiptr>(vertices.size() * sizeof(LevelVertex)), vertices.data());
    }
    batches = order.batches;
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

// The level's sky around `camera`.
void LevelRenderer::Impl::set_sky(const Camera& camera, double aspect) {
    const Mat4 view = view_from_world(camera);
    const double tangent = std::tan(0.5 * camera.fov_y);
    Mat4f directions = Mat4f::Zero();
    directions.col(0).head<3>() = (tangent * aspect * view.row(0).head<3>()).transpose().cast<float>();
    directions.col(1).head<3>() = (tangent * view.row(1).head<3>()).transpose().cast<float>();
    directions.col(2).head<3>() = -view.row(2).head<3>().transpose().cast<float>();
    const bool sun = light->sun_color.maxCoeff() > 0.0 && light->sun_direction.norm() > 0.0;
    set_uniform(*gl, background_program, "direction_from_screen", directions);
    set_uniform(*gl, background_program, "sky_zenith", Vec3f(light->sky_zenith.cast<float>()));
    set_uniform(*gl, background_program, "sky_horizon", Vec3f(light->sky_horizon.cast<float>()));
    set_uniform(*gl, background_program, "sun",
                sun ? Vec3f(light->sun_direction.normalized().cast<float>()) : Vec3f(Vec3f::Zero()));
    set_uniform(*gl, background_program, "sun_color", Vec3f(light->sun_color.cast<float>()));
}

void LevelRenderer::Impl::draw_background(const Camera& camera, double aspect, const LevelStyle& style) {
    gl->Disable(GL_DEPTH_TEST);
    gl->UseProgram(background_program);
    const bool sky = lit(style) && !camera.orthographic;
    set_uniform(*gl, background_program, "sky", sky ? 1 : 0);
    if (sky) set_sky(camera, aspect);
    set_uniform(*gl, background_program, "top", style.background_top);
    set_uniform(*gl, background_program, "bottom", style.background_bottom);
    gl->BindVertexArray(empty_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

// The eye relative to the drawing origin with w = 1; for an orthographic camera the direction towards it with
// w = 0.
Eigen::Vector4f LevelRenderer::Impl::eye_uniform(const Camera& camera) const {
    const Vec3 eye =
        camera.orthographic ? Vec3((camera.eye - camera.target).normalized()) : Vec3(camera.eye - origin);
    const Vec3f e = eye.cast<float>();
    return {e.x(), e.y(), e.z(), camera.orthographic ? 0.0f : 1.0f};
}

void LevelRenderer::Impl::set_level_uniforms(unsigned program, const Camera& camera, int height,
                                             const Mat4f& clip, const LevelStyle& style) {
    const double extent = mesh->bounds.empty() ? 1.0 : mesh->bounds.size().norm();
    gl->UseProgram(program);
    set_uniform(*gl, program, "clip_from_local", clip);
    set_uniform(*gl, program, "overlay", std::clamp(style.overlay, 0.0f, 1.0f));
    set_uniform(*gl, program, "face_colors", static_cast<int>(style.colors));
    set_uniform(*gl, program, "slope_cosine", static_cast<float>(std::cos(style.max_slope)));
    set_uniform(*gl, program, "eye", eye_uniform(camera));
    set_uniform(*gl, program, "depth_bias", depth_bias(camera, height, 0.1));
    const Vec3f background = 0.5f * (style.background_top + style.background_bottom);
    set_uniform(*gl, program, "fade_color",
                lit(style) ? Vec3f(light->sky_horizon.cast<float>().cwiseMin(1.0f).cwiseSqrt()) : background);
    set_uniform(*gl, program, "haze", lit(style) ? static_cast<float>(light->haze_m) : 0.0f);
    set_uniform(*gl, program, "use_color", style.textured ? 1 : 0);
    const double fade_start = 0.8 * extent;
    set_uniform(*gl, program, "fade_range",
                Vec2f(static_cast<float>(fade_start), static_cast<float>(4.0 * fade_start)));
    set_uniform(*gl, program, "material_texture", 0);
    set_uniform(*gl, program, "face_state", 1);
    set_uniform(*gl, program, "surface_table", 2);
    set_uniform(*gl, program, "light_map", 3);
    set_uniform(*gl, program, "light_charts", 4);
}

void LevelRenderer::Impl::draw_faces(const Camera& camera, int height, const Mat4f& clip,
                                     const LevelStyle& style) {
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D, face_state.texture());
    gl->ActiveTexture(GL_TEXTURE2);
    gl->BindTexture(GL_TEXTURE_2D, table_texture);
    gl->ActiveTexture(GL_TEXTURE3);
    gl->BindTexture(GL_TEXTURE_2D, lit(style) ? light_map.picture() : white_texture);
    gl->ActiveTexture(GL_TEXTURE4);
    gl->BindTexture(GL_TEXTURE_2D, lit(style) ? light_map.charts() : white_texture);
    gl->ActiveTexture(GL_TEXTURE0);

    if (style.back_faces) {
        gl->Disable(GL_CULL_FACE);
    } else {
        gl->Enable(GL_CULL_FACE);
        gl->CullFace(GL_BACK);
        gl->FrontFace(GL_CCW);
    }
    gl->BindVertexArray(level_array);
    const bool painted =
        highlights_shown || style.colors != FaceColors::types || (surfaces_shown && style.overlay > 0.0f);
    unsigned program = 0;
    for (const DrawBatch& batch : batches) {
        const bool textured = style.textured && batch.texture != LevelTextures::none;
        unsigned variant = painted ? LevelPrograms::painted : 0;
        if (lit(style)) variant |= LevelPrograms::lit;
        if (textured) variant |= LevelPrograms::textured;
        if (textured && !textures.opaque(batch.texture)) variant |= LevelPrograms::cutout;
        const Result<unsigned> wanted = level_programs.get(variant);
        if (!wanted) {
            if (status) status = wanted.error();
            continue;
        }
        if (*wanted != program) set_level_uniforms(*wanted, camera, height, clip, style);
        program = *wanted;
        gl->BindTexture(GL_TEXTURE_2D, textured ? textures.name(batch.texture) : white_texture);
        draw_in_pieces(batch);
    }
    gl->Disable(GL_CULL_FACE);
}

// A software rasteriser keeps what it was told to draw, some hundred bytes a triangle, until it has drawn it:
// while it draws one piece it is told the next, and no more.
void LevelRenderer::Impl::draw_in_pieces(const DrawBatch& batch) {
    GLsync last = nullptr;
    for (std::size_t done = 0; done < batch.count; done += triangles_per_draw) {
        const std::size_t count = std::min(triangles_per_draw, batch.count - done);
        gl->DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * (batch.first + done)),
                       static_cast<GLsizei>(3 * count));
        if (batch.count <= triangles_per_draw) return;
        GLsync now = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl->Flush();
        if (last != nullptr) {
            gl->ClientWaitSync(last, 0, longest_wait_ns);
            gl->DeleteSync(last);
        }
        last = now;
    }
    gl->DeleteSync(last);
}

void LevelRenderer::Impl::draw_lines(const LineBuffer& lines, float shortest) {
    if (lines.count == 0) return;
    set_uniform(*gl, line_program, "shortest", shortest);
    gl->BindVertexArray(lines.vertex_array);
    gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lines.count);
}

// What draw() needs of the context, whatever was drawn before.
void LevelRenderer::Impl::reset_state(int width, int height) {
    gl->Viewport(0, 0, width, height);
    for (const int off : {GL_SCISSOR_TEST, GL_BLEND, GL_STENCIL_TEST, GL_CULL_FACE})
        gl->Disable(static_cast<GLenum>(off));
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

// Faces, borders and outlines.
void LevelRenderer::Impl::draw_level(const Camera& camera, int width, int height, const LevelStyle& style) {
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LEQUAL);
    const Mat4f clip = clip_from_local(camera, width, height, origin);
    draw_faces(camera, height, clip, style);
    if (style.wireframe && !borders_built) {
        upload_lines(borders, face_border_lines(*mesh, highlights, origin, border_color, border_width));
        borders_built = true;
    }
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    gl->DepthMask(GL_FALSE);
    gl->UseProgram(line_program);
    set_uniform(*gl, line_program, "clip_from_local", clip);
    set_uniform(*gl, line_program, "viewport", Vec2f(static_cast<float>(width), static_cast<float>(height)));
    set_uniform(*gl, line_program, "opacity", 1.0f);
    set_uniform(*gl, line_program, "depth_bias", depth_bias(camera, height, line_bias));
    const Eigen::Vector4f nobody = Eigen::Vector4f::Zero();
    set_uniform(*gl, line_program, "cull_eye", style.back_faces ? nobody : eye_uniform(camera));
    if (style.wireframe) draw_lines(borders, shortest_border);
    set_uniform(*gl, line_program, "cull_eye", nobody);
    draw_lines(selected_outline, 0.0f);
    draw_lines(hovered_outline, 0.0f);
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_BLEND);
    gl->Disable(GL_DEPTH_TEST);
}

LevelRenderer::LevelRenderer(GlTable gl) : impl_(std::make_unique<Impl>(std::move(gl))) {
    impl_->build_programs();
    impl_->build_objects();
    impl_->reset_faces();
    set_surface_types({});
    assert_no_gl_error(*impl_->gl, "LevelRenderer");
}

LevelRenderer::~LevelRenderer() {
    const GladGLContext& gl = *impl_->gl;
    for (const unsigned program : {impl_->background_program, impl_->line_program}) {
        gl.DeleteProgram(program);
    }
    for (const LineBuffer* lines : {&impl_->borders, &impl_->selected_outline, &impl_->hovered_outline}) {
        gl.DeleteVertexArrays(1, &lines->vertex_array);
        gl.DeleteBuffers(1, &lines->buffer);
    }
    for (const unsigned* array : {&impl_->empty_array, &impl_->level_array})
        gl.DeleteVertexArrays(1, array);
    gl.DeleteBuffers(1, &impl_->level_buffer);
    for (const unsigned* texture : {&impl_->table_texture, &impl_->white_texture}) {
        gl.DeleteTextures(1, texture);
    }
}

Status LevelRenderer::status() const {
    return impl_->status;
}

std::size_t LevelRenderer::face_state_bytes_uploaded() const {
    return impl_->face_state.bytes_uploaded();
}

Warnings LevelRenderer::set_mesh(MeshPtr mesh, const std::filesystem::path& folder, TextureAccess textures) {
    Warnings warnings;
    impl_->mesh = std::move(mesh);
    impl_->batches.clear();
    impl_->parts.clear();
    impl_->moving.clear();
    impl_->borders_built = false;
    impl_->textures.clear();
    impl_->light_map.clear();
    impl_->outlines.reset();
    if (impl_->mesh) {
        impl_->origin = drawing_origin(*impl_->mesh);
        warnings = impl_->textures.load(*impl_->mesh, folder, textures);
        impl_->upload_geometry(warnings);
    }
    impl_->reset_faces();
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_mesh");
    return warnings;
}

void LevelRenderer::move_faces(std::span<const std::uint32_t> parts, std::span<const Pose> poses) {
    Impl& impl = *impl_;
    if (!impl.mesh || impl.batches.empty()) return;
    const auto send = [&](const MovingRun& run, const Pose& pose) {
        std::vector<LevelVertex> vertices;
        append_moved_vertices(*impl.mesh, run.triangles, pose, impl.origin, vertices);
        impl.gl->BindBuffer(GL_ARRAY_BUFFER, impl.level_buffer);
        impl.gl->BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(3 * run.first * sizeof(LevelVertex)),
                               static_cast<GLsizeiptr>(vertices.size() * sizeof(LevelVertex)),
                               vertices.data());
    };
    if (!std::equal(parts.begin(), parts.end(), impl.parts.begin(), impl.parts.end())) {
        for (const MovingRun& run : impl.moving)
            send(run, Pose{});
        impl.find_moving(parts);
    }
    for (const MovingRun& run : impl.moving) {
        if (run.part < poses.size()) send(run, poses[run.part]);
    }
    assert_no_gl_error(*impl.gl, "LevelRenderer::move_faces");
}

Warnings LevelRenderer::set_light(const std::optional<LevelLight>& light, const MeshPtr& lit,
                                  const std::filesystem::path& folder) {
    impl_->light = light;
    impl_->light_map.clear();
    if (!light || !lit || !impl_->mesh) return {};
    Warnings warnings = impl_->light_map.load(*lit, impl_->mesh->face_count(), *light, folder, impl_->origin);
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_light");
    return warnings;
}

void LevelRenderer::set_face_surfaces(std::span<const SurfaceId> surfaces) {
    impl_->surfaces_shown =
        std::any_of(surfaces.begin(), surfaces.end(), [](SurfaceId surface) { return surface != 0; });
    impl_->face_state.change(surfaces, FaceState::Channel::surface);
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_face_surfaces");
}

void LevelRenderer::set_face_highlights(std::span<const std::uint8_t> highlights) {
    std::uint8_t changed = 0;
    const std::size_t faces = std::min(highlights.size(), impl_->highlights.size());
    for (std::size_t face = 0; face < faces; ++face)
        changed = static_cast<std::uint8_t>(changed | (impl_->highlights[face] ^ highlights[face]));
    if (changed == 0) return;
    std::copy_n(highlights.begin(), faces, impl_->highlights.begin());
    impl_->highlights_shown = std::any_of(impl_->highlights.begin(), impl_->highlights.end(),
                                          [](std::uint8_t bits) { return bits != 0; });
    impl_->face_state.change(impl_->highlights, FaceState::Channel::highlight);
    const auto outline = [&](std::uint8_t bit, const std::uint8_t(&color)[4], LineBuffer& lines) {
        if ((changed & bit) == 0) return;
        prepare_outlines();
        impl_->upload_lines(lines, impl_->outlines->lines(*impl_->mesh, impl_->highlights, bit, impl_->origin,
                                                          color, outline_width));
    };
    if ((changed & 4) != 0) impl_->borders_built = false;
    outline(2, selected_color, impl_->selected_outline);
    outline(1, hovered_color, impl_->hovered_outline);
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_face_highlights");
}

void LevelRenderer::prepare_outlines() {
    if (impl_->mesh && !impl_->outlines) impl_->outlines.emplace(*impl_->mesh);
}

void LevelRenderer::set_surface_types(SurfaceTable surfaces) {
    std::array<std::uint8_t, 2 * 4 * 256> table{};
    for (std::size_t i = 0; i < std::min<std::size_t>(surfaces.size(), 256); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const float value = std::clamp(surfaces[i].color[channel], 0.0f, 1.0f);
            table[4 * i + channel] = static_cast<std::uint8_t>(std::lround(value * 255.0f));
        }
        table[4 * i + 3] = static_cast<std::uint8_t>(surfaces[i].hatch);
        const std::size_t limit = 4 * (256 + i);
        if (!surfaces[i].max_slope) continue;
        const auto cosine = static_cast<unsigned>(
            std::lround(std::clamp(std::cos(*surfaces[i].max_slope), 0.0, 1.0) * 65535.0));
        table[limit] = static_cast<std::uint8_t>(cosine >> 8U);
        table[limit + 1] = static_cast<std::uint8_t>(cosine & 0xffU);
        table[limit + 2] = 255;
    }
    const GladGLContext& gl = *impl_->gl;
    gl.BindTexture(GL_TEXTURE_2D, impl_->table_texture);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 256, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, table.data());
    gl.BindTexture(GL_TEXTURE_2D, 0);
}

void LevelRenderer::draw(const Camera& camera, int width, int height, const LevelStyle& style) {
    if (width <= 0 || height <= 0) return;
    const GladGLContext& gl = *impl_->gl;
    impl_->reset_state(width, height);
    gl.ClearColor(style.background_bottom.x(), style.background_bottom.y(), style.background_bottom.z(),
                  1.0f);
    gl.ClearDepth(1.0);
    gl.ClearStencil(0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    if (!impl_->status) return;
    impl_->draw_background(camera, static_cast<double>(width) / height, style);
    draw_over(camera, width, height, style);
}

void LevelRenderer::draw_over(const Camera& camera, int width, int height, const LevelStyle& style) {
    if (width <= 0 || height <= 0 || !impl_->status) return;
    const GladGLContext& gl = *impl_->gl;
    impl_->reset_state(width, height);
    if (impl_->mesh) impl_->draw_level(camera, width, height, style);
    gl.BindVertexArray(0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.UseProgram(0);
    assert_no_gl_error(gl, "LevelRenderer::draw");
}

}  // namespace slipface
