// Draws the background, faces, borders and outlines.
#include <algorithm>
#include <cmath>

#include "gl_util.h"
#include "level_renderer_impl.h"

namespace slipface {

namespace {

constexpr std::uint8_t border_color[4] = {14, 17, 22, 135};
constexpr float border_width = 1.2f;
constexpr float shortest_border = 2.5f;  // pixels; keeps dense geometry from turning black
constexpr double line_bias = 2.0;        // pixels by which lines lie in front of their faces
constexpr std::size_t triangles_per_piece = std::size_t{1} << 15U;
// Of a call with triangles that reach over the image's border, Mesa's clipping visits all vertices again and
// again.
constexpr std::size_t triangles_per_call = 512;
constexpr GLuint64 longest_wait_ns = 100'000'000;

}  // namespace

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
    // A building has no sky: around it is the same background as around levels without baked light.
    const bool sky = lit(style) && !camera.orthographic && !(light->sky_zenith + light->sky_horizon).isZero();
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
    const double own_extent = mesh->bounds.empty() ? 1.0 : mesh->bounds.size().norm();
    const double extent = std::max(extent_around, own_extent);
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

void LevelRenderer::Impl::set_place(unsigned program, const Place& place) {
    Eigen::Matrix3d linear;
    for (int column = 0; column < 3; ++column)
        linear.col(column) = place.at.columns[static_cast<std::size_t>(column)];
    const Vec3 offset = linear * mesh_origin + place.at.offset - origin;
    set_uniform(*gl, program, "world_from_mesh", Eigen::Matrix3f(linear.cast<float>()));
    set_uniform(*gl, program, "normal_from_mesh",
                Eigen::Matrix3f(linear.inverse().transpose().cast<float>()));
    set_uniform(*gl, program, "mesh_offset", Vec3f(offset.cast<float>()));
    set_uniform(*gl, program, "first_state", place.first_state);
    set_uniform(*gl, program, "uv_change", place.uv);
    gl->FrontFace(place.at.mirrors() ? GL_CW : GL_CCW);
}

void LevelRenderer::Impl::draw_faces(const Camera& camera, int height, const Mat4f& clip,
                                     const LevelStyle& style) {
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D, face_state.texture());
    gl->ActiveTexture(GL_TEXTURE2);
    gl->BindTexture(GL_TEXTURE_2D, table_texture);
    gl->ActiveTexture(GL_TEXTURE3);
    gl->BindTexture(GL_TEXTURE_2D, lit(style) ? light_map.image() : white_texture);
    gl->ActiveTexture(GL_TEXTURE4);
    gl->BindTexture(GL_TEXTURE_2D, lit(style) ? light_map.charts() : white_texture);
    gl->ActiveTexture(GL_TEXTURE0);

    if (style.back_faces) {
        gl->Disable(GL_CULL_FACE);
    } else {
        gl->Enable(GL_CULL_FACE);
        gl->CullFace(GL_BACK);
    }
    if (rig) {
        std::vector<const RigPose*> poses;
        for (const Place& place : places)
            poses.push_back(place.pose);
        rig->send(poses);
    }
    gl->BindVertexArray(level_array);
    const bool painted =
        highlights_shown || style.colors != FaceColors::types || (surfaces_shown && style.overlay > 0.0f);
    unsigned program = 0;
    for (const DrawBatch& batch : batches) {
        const bool textured = style.textured && batch.texture != LevelTextures::none;
        unsigned variant = painted ? LevelPrograms::painted : 0;
        if (!places.empty()) variant |= LevelPrograms::placed;
        if (rig) variant |= LevelPrograms::posed;
        if (lit(style)) variant |= LevelPrograms::lit;
        if (textured) variant |= LevelPrograms::textured;
        if (textured && !textures.opaque(batch.texture)) variant |= LevelPrograms::cutout;
        const Result<unsigned> wanted = level_programs->get(variant);
        if (!wanted) {
            if (status) status = wanted.error();
            continue;
        }
        if (*wanted != program) set_level_uniforms(*wanted, camera, height, clip, style);
        program = *wanted;
        gl->BindTexture(GL_TEXTURE_2D, textured ? textures.name(batch.texture) : white_texture);
        if (places.empty()) draw_in_pieces(batch);
        for (std::size_t i = 0; i < places.size(); ++i) {
            set_place(program, places[i]);
            if (rig) rig->bind(program, i);
            draw_in_pieces(batch);
        }
    }
    gl->Disable(GL_CULL_FACE);
    gl->FrontFace(GL_CCW);
}

// A software rasteriser stores its commands, some hundred bytes per triangle, until it has drawn them. So at
// most two pieces are in flight: one that is being drawn, and the next.
void LevelRenderer::Impl::draw_in_pieces(const DrawBatch& batch) {
    GLsync last = nullptr;
    for (std::size_t done = 0; done < batch.count; done += triangles_per_piece) {
        const std::size_t count = std::min(triangles_per_piece, batch.count - done);
        for (std::size_t called = 0; called < count; called += triangles_per_call) {
            gl->DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * (batch.first + done + called)),
                           static_cast<GLsizei>(3 * std::min(triangles_per_call, count - called)));
        }
        if (batch.count <= triangles_per_piece) return;
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

// Sets the state that draw() needs, whatever was drawn before.
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
    if (props) props->draw_faces(camera, width, height, clip, style, origin, extent_around, table_texture);
    if (style.wireframe && !borders_built) {
        std::vector<LineInstance> lines =
            face_border_lines(*mesh, highlights, origin, border_color, border_width);
        if (props) props->add_borders(origin, border_color, border_width, lines);
        upload_lines(borders, lines);
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

}  // namespace slipface
