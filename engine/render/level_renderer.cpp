#include "slipface/render/level_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "gl_util.h"
#include "level_renderer_impl.h"

namespace slipface {

namespace {

// No surface type and no colour of slopes has the selection's. Light lines with a dark casing: whatever the
// ground's brightness, one of the two is more than three times as bright or as dark.
constexpr std::uint8_t selected_color[4] = {255, 150, 255, 255};
constexpr std::uint8_t hovered_color[4] = {255, 255, 255, 255};
constexpr std::uint8_t casing_color[4] = {8, 4, 10, 235};
constexpr float outline_width = 2.4f, casing_width = 5.4f;

// Of the faces, and of the highlighted faces of props. `bits`: which outlines changed.
template <class Renderer, class Impl>
void upload_outlines(Renderer& renderer, Impl& impl, unsigned bits) {
    const auto outline = [&](std::uint8_t bit, const std::uint8_t(&color)[4], auto& buffer) {
        if ((bits & bit) == 0 || !impl.mesh) return;
        renderer.prepare_outlines();
        std::vector<LineInstance> lines =
            impl.outlines->lines(*impl.mesh, impl.highlights, bit, impl.origin, color, outline_width);
        if (impl.props) impl.props->add_outlines(bit, impl.origin, color, outline_width, lines);
        std::vector<LineInstance> casing = lines;
        for (LineInstance& line : casing) {
            std::copy(std::begin(casing_color), std::end(casing_color), line.color);
            line.width = casing_width;
        }
        lines.insert(lines.begin(), casing.begin(), casing.end());  // under them
        impl.upload_lines(buffer, lines);
    };
    outline(2, selected_color, impl.selected_outline);
    outline(1, hovered_color, impl.hovered_outline);
}

}  // namespace

LevelRenderer::LevelRenderer(GlTable gl) : LevelRenderer(std::make_unique<Impl>(std::move(gl))) {}

LevelRenderer::LevelRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
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
    for (const Impl::LineBuffer* lines :
         {&impl_->borders, &impl_->selected_outline, &impl_->hovered_outline}) {
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

Warnings LevelRenderer::set_mesh(MeshPtr mesh, const std::filesystem::path& folder) {
    return set(std::move(mesh), folder, false);
}

Warnings LevelRenderer::set_instances(MeshPtr mesh, const std::filesystem::path& folder) {
    return set(std::move(mesh), folder, true);
}

Warnings LevelRenderer::set(MeshPtr mesh, const std::filesystem::path& folder, bool instances) {
    Warnings warnings;
    impl_->mesh = std::move(mesh);
    impl_->batches.clear();
    impl_->parts.clear();
    impl_->moving.clear();
    impl_->borders_built = false;
    impl_->textures.clear();
    impl_->light_map.clear();
    impl_->outlines.reset();
    impl_->props.reset();
    impl_->rig.reset();
    impl_->drawn_apart.clear();
    impl_->extent_around = 0.0;
    if (impl_->mesh) {
        const bool moves = instances && impl_->mesh->rig;
        impl_->origin = moves ? Vec3(Vec3::Zero()) : drawing_origin(*impl_->mesh);
        warnings = impl_->textures.load(*impl_->mesh, folder);
        if (moves)
            impl_->upload_geometry(before_bones(*impl_->mesh), warnings);
        else
            impl_->upload_geometry(*impl_->mesh, warnings);
    }
    impl_->reset_faces();
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_mesh");
    return warnings;
}

void LevelRenderer::move_faces(std::span<const std::uint32_t> parts, std::span<const Pose> poses) {
    Impl& impl = *impl_;
    if (!impl.mesh || impl.batches.empty()) return;
    const auto send = [&](const Impl::MovingRun& run, const Pose& pose) {
        std::vector<LevelVertex> vertices;
        append_moved_vertices(*impl.mesh, run.triangles, pose, impl.origin, vertices);
        impl.gl->BindBuffer(GL_ARRAY_BUFFER, impl.level_buffer);
        impl.gl->BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(3 * run.first * sizeof(LevelVertex)),
                               static_cast<GLsizeiptr>(vertices.size() * sizeof(LevelVertex)),
                               vertices.data());
    };
    if (!std::equal(parts.begin(), parts.end(), impl.parts.begin(), impl.parts.end())) {
        for (const Impl::MovingRun& run : impl.moving)
            send(run, Pose{});
        impl.find_moving(parts);
    }
    for (const Impl::MovingRun& run : impl.moving) {
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

void LevelRenderer::set_face_highlights(std::span<const std::uint8_t> given) {
    std::vector<std::uint8_t> highlights(given.begin(), given.end());
    for (const auto& [begin, end] : impl_->drawn_apart)
        for (FaceId face = begin; face < std::min<std::size_t>(end, highlights.size()); ++face)
            highlights[face] = 4;
    std::uint8_t changed = 0;
    const std::size_t faces = std::min(highlights.size(), impl_->highlights.size());
    constexpr std::size_t block = 4096;
    for (std::size_t begin = 0; begin < faces; begin += block) {
        const std::size_t count = std::min(block, faces - begin);
        if (std::memcmp(&impl_->highlights[begin], &highlights[begin], count) == 0) continue;
        for (std::size_t face = begin; face < begin + count; ++face)
            changed = static_cast<std::uint8_t>(changed | (impl_->highlights[face] ^ highlights[face]));
    }
    if (changed == 0) return;
    std::copy_n(highlights.begin(), faces, impl_->highlights.begin());
    impl_->highlights_shown = std::any_of(impl_->highlights.begin(), impl_->highlights.end(),
                                          [](std::uint8_t bits) { return bits != 0; });
    impl_->face_state.change(impl_->highlights, FaceState::Channel::highlight);
    if ((changed & 4) != 0) impl_->borders_built = false;
    upload_outlines(*this, *impl_, changed);
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_face_highlights");
}

Warnings LevelRenderer::set_props(const Level& level, const PropSurfaces& types) {
    Warnings warnings;
    if (!impl_->props) impl_->props = std::make_unique<LevelProps>(impl_->gl, impl_->level_programs);
    const Aabb bounds = level.mesh.bounds();
    impl_->extent_around = bounds.empty() ? 0.0 : bounds.size().norm();
    impl_->borders_built = false;
    impl_->props->set(level, types, warnings);
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_props");
    return warnings;
}

Warnings LevelRenderer::set_animated_props(const Level& level, PropSurfaces types) {
    impl_->drawn_apart.clear();
    types.resize(level.props.size());
    for (std::size_t i = 0; i < types.size(); ++i) {
        if (!level.props[i].animation.moves())
            types[i] = nullptr;
        else if (types[i] != nullptr)
            impl_->drawn_apart.emplace_back(level.placed.first_face[i], level.placed.first_face[i + 1]);
    }
    Warnings warnings = set_props(level, types);
    set_face_highlights(std::vector<std::uint8_t>(impl_->highlights.size(), 0));
    return warnings;
}

void LevelRenderer::set_prop_highlights(
    const std::map<std::uint32_t, std::vector<std::uint8_t>>& highlights) {
    if (!impl_->props) return;
    impl_->props->highlight(highlights);
    impl_->borders_built = false;
    upload_outlines(*this, *impl_, 3);
    assert_no_gl_error(*impl_->gl, "LevelRenderer::set_prop_highlights");
}

void LevelRenderer::animate_props(double time_s) {
    if (impl_->props) impl_->props->animate(time_s);
}

void LevelRenderer::move_props(const std::map<std::uint32_t, Pose>& poses) {
    if (impl_->props) impl_->props->move(poses);
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

void LevelRenderer::draw_placed(const Camera& camera, int width, int height, const LevelStyle& style,
                                const PosedMesh& placed, double extent_around) {
    if (width <= 0 || height <= 0 || !impl_->status || !impl_->mesh) return;
    const Vec3 own_origin = impl_->origin;
    const Placement& at = placed.at;
    // The vertices are relative to the mesh's drawing origin.
    const Impl::Place place{at, 0, &placed.pose, placed.uv};
    impl_->places = {&place, 1};
    impl_->mesh_origin = own_origin;
    impl_->extent_around = extent_around;
    impl_->origin = at.columns[0] * own_origin.x() + at.columns[1] * own_origin.y() +
                    at.columns[2] * own_origin.z() + at.offset;
    LevelStyle plain = style;
    plain.wireframe = false;
    draw_over(camera, width, height, plain);
    impl_->origin = own_origin;
    impl_->places = {};
    impl_->extent_around = 0.0;
}

}  // namespace slipface
