#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>

#include "gl_util.h"
#include "line_shaders.h"
#include "overlay_geometry.h"
#include "overlay_shaders.h"
#include "slipface/render/overlay.h"

namespace slipface {

namespace {

constexpr float hidden_opacity = 0.16f;  // of parts behind the level
constexpr double overlay_bias = 2.5;     // pixels by which shapes on a face lie in front of it

struct TriangleVertex {
    float position[3];
    std::uint8_t color[4];
};

bool finite(const Overlay::Line& line) {
    return line.a.allFinite() && line.b.allFinite();
}
bool finite(const Overlay::Triangle& t) {
    return t.a.allFinite() && t.b.allFinite() && t.c.allFinite();
}
bool drawable(const Overlay::Ellipsoid& e) {
    return e.centre.allFinite() && e.radii.allFinite() && e.radii.minCoeff() > 0.0;
}

// Indices of `items` from the farthest to the nearest; a stable order.
template <class Item, class Position>
std::vector<std::size_t> far_to_near(const std::vector<Item>& items, const Camera& camera,
                                     const Position& position) {
    std::vector<double> depth(items.size());
    const Vec3 forward = camera.target - camera.eye;
    for (std::size_t i = 0; i < items.size(); ++i)
        depth[i] = forward.dot(position(items[i]) - camera.eye);
    std::vector<std::size_t> order(items.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    return order;
}

}  // namespace

struct OverlayRenderer::Impl {
    explicit Impl(GlTable table) : gl(std::move(table)) {}

    GlTable gl;
    Status status;
    unsigned line_program = 0, triangle_program = 0, ellipsoid_program = 0;
    unsigned line_array = 0, line_buffer = 0, triangle_array = 0, triangle_buffer = 0;
    unsigned sphere_array = 0, sphere_buffer = 0, sphere_indices = 0;
    GLsizei sphere_index_count = 0;

    void build();
    void begin(unsigned program, const Camera& camera, int width, int height, double bias);
    void draw_hidden_then_visible(unsigned program, const std::function<void()>& draw_all);
    void draw_triangles(const Overlay& overlay, const Camera& camera, int width, int height);
    void draw_ellipsoids(const Overlay& overlay, const Camera& camera, int width, int height);
    void draw_lines(const std::vector<LineInstance>& lines, bool on_top, const Camera& camera, int width,
                    int height);
};

void OverlayRenderer::Impl::build() {
    const auto link = [&](const char* name, const char* vertex, const char* fragment) {
        Result<unsigned> program = link_program(*gl, name, vertex, fragment);
        if (program) return *program;
        if (status) status = program.error();
        return 0U;
    };
    line_program = link("line", line_vertex_shader, line_fragment_shader);
    triangle_program =
        link("overlay triangle", overlay_triangle_vertex_shader, overlay_triangle_fragment_shader);
    ellipsoid_program = link("ellipsoid", ellipsoid_vertex_shader, ellipsoid_fragment_shader);

    gl->GenVertexArrays(1, &line_array);
    gl->GenBuffers(1, &line_buffer);
    describe_line_instances(*gl, line_array, line_buffer);

    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    gl->GenVertexArrays(1, &triangle_array);
    gl->GenBuffers(1, &triangle_buffer);
    gl->BindVertexArray(triangle_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, triangle_buffer);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(TriangleVertex),
                            offset(offsetof(TriangleVertex, position)));
    gl->VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(TriangleVertex),
                            offset(offsetof(TriangleVertex, color)));
    gl->EnableVertexAttribArray(0);
    gl->EnableVertexAttribArray(1);

    const SphereMesh sphere = unit_sphere(32, 64);
    gl->GenVertexArrays(1, &sphere_array);
    gl->GenBuffers(1, &sphere_buffer);
    gl->GenBuffers(1, &sphere_indices);
    gl->BindVertexArray(sphere_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, sphere_buffer);
    gl->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(sphere.positions.size() * sizeof(Vec3f)),
                   sphere.positions.data(), GL_STATIC_DRAW);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, sphere_indices);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER,
                   static_cast<GLsizeiptr>(sphere.indices.size() * sizeof(std::uint16_t)),
                   sphere.indices.data(), GL_STATIC_DRAW);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vec3f), nullptr);
    gl->EnableVertexAttribArray(0);
    gl->BindVertexArray(0);
    sphere_index_count = static_cast<GLsizei>(sphere.indices.size());
}

// Positions are relative to the eye, which keeps their precision far from zero.
void OverlayRenderer::Impl::begin(unsigned program, const Camera& camera, int width, int height,
                                  double bias) {
    gl->UseProgram(program);
    set_uniform(*gl, program, "clip_from_local", clip_from_local(camera, width, height, camera.eye));
    set_uniform(*gl, program, "depth_bias", depth_bias(camera, height, bias));
}

// The two depth tests are opposites, so every pixel is drawn in exactly one of the passes.
void OverlayRenderer::Impl::draw_hidden_then_visible(unsigned program,
                                                     const std::function<void()>& draw_all) {
    gl->DepthFunc(GL_GREATER);
    set_uniform(*gl, program, "opacity", hidden_opacity);
    draw_all();
    gl->DepthFunc(GL_LEQUAL);
    set_uniform(*gl, program, "opacity", 1.0f);
    draw_all();
}

void OverlayRenderer::Impl::draw_triangles(const Overlay& overlay, const Camera& camera, int width,
                                           int height) {
    std::vector<TriangleVertex> vertices;
    const auto centroid = [](const Overlay::Triangle& t) { return Vec3((t.a + t.b + t.c) / 3.0); };
    std::vector<Overlay::Triangle> triangles;
    std::copy_if(overlay.triangles.begin(), overlay.triangles.end(), std::back_inserter(triangles),
                 [](const Overlay::Triangle& t) { return finite(t); });
    for (const std::size_t i : far_to_near(triangles, camera, centroid)) {
        const Overlay::Triangle& triangle = triangles[i];
        const LineInstance packed =
            line_instance(triangle.a, triangle.b, triangle.color, 0.0f, LineKind::butt);
        for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) {
            const Vec3f p = (corner - camera.eye).cast<float>();
            vertices.push_back({{p.x(), p.y(), p.z()},
                                {packed.color[0], packed.color[1], packed.color[2], packed.color[3]}});
        }
    }
    if (vertices.empty()) return;
    gl->BindBuffer(GL_ARRAY_BUFFER, triangle_buffer);
    gl->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(TriangleVertex)),
                   vertices.data(), GL_STREAM_DRAW);
    begin(triangle_program, camera, width, height, overlay_bias);
    gl->BindVertexArray(triangle_array);
    draw_hidden_then_visible(triangle_program,
                             [&] { gl->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size())); });
}

void OverlayRenderer::Impl::draw_ellipsoids(const Overlay& overlay, const Camera& camera, int width,
                                            int height) {
    std::vector<Overlay::Ellipsoid> filled;
    std::copy_if(overlay.ellipsoids.begin(), overlay.ellipsoids.end(), std::back_inserter(filled),
                 [](const Overlay::Ellipsoid& e) { return drawable(e) && e.fill.alpha > 0.0f; });
    if (filled.empty()) return;
    const auto order = far_to_near(filled, camera, [](const Overlay::Ellipsoid& e) { return e.centre; });
    const Vec3f towards_eye = (camera.eye - camera.target).normalized().cast<float>();

    begin(ellipsoid_program, camera, width, height, 0.0);
    const Eigen::Vector4f eye = camera.orthographic
                                    ? Eigen::Vector4f(towards_eye.x(), towards_eye.y(), towards_eye.z(), 0)
                                    : Eigen::Vector4f(0, 0, 0, 1);
    set_uniform(*gl, ellipsoid_program, "eye", eye);
    const GLint centre_uniform = gl->GetUniformLocation(ellipsoid_program, "centre");
    const GLint radii_uniform = gl->GetUniformLocation(ellipsoid_program, "radii");
    const GLint fill_uniform = gl->GetUniformLocation(ellipsoid_program, "fill");
    gl->BindVertexArray(sphere_array);
    gl->Enable(GL_CULL_FACE);
    gl->CullFace(GL_BACK);
    gl->FrontFace(GL_CCW);
    draw_hidden_then_visible(ellipsoid_program, [&] {
        for (const std::size_t i : order) {
            const Overlay::Ellipsoid& e = filled[i];
            const Vec3f centre = (e.centre - camera.eye).cast<float>();
            const Vec3f radii = e.radii.cast<float>();
            gl->Uniform3f(centre_uniform, centre.x(), centre.y(), centre.z());
            gl->Uniform3f(radii_uniform, radii.x(), radii.y(), radii.z());
            gl->Uniform4f(fill_uniform, e.fill.red, e.fill.green, e.fill.blue, e.fill.alpha);
            gl->DrawElements(GL_TRIANGLES, sphere_index_count, GL_UNSIGNED_SHORT, nullptr);
        }
    });
    gl->Disable(GL_CULL_FACE);
}

void OverlayRenderer::Impl::draw_lines(const std::vector<LineInstance>& lines, bool on_top,
                                       const Camera& camera, int width, int height) {
    if (lines.empty()) return;
    gl->BindBuffer(GL_ARRAY_BUFFER, line_buffer);
    gl->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lines.size() * sizeof(LineInstance)),
                   lines.data(), GL_STREAM_DRAW);
    begin(line_program, camera, width, height, overlay_bias);
    set_uniform(*gl, line_program, "viewport", Vec2f(static_cast<float>(width), static_cast<float>(height)));
    set_uniform(*gl, line_program, "shortest", 0.0f);
    set_uniform(*gl, line_program, "cull_eye", Eigen::Vector4f(Eigen::Vector4f::Zero()));
    gl->BindVertexArray(line_array);
    const auto draw_all = [&] {
        gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines.size()));
    };
    if (on_top) {
        gl->DepthFunc(GL_ALWAYS);
        set_uniform(*gl, line_program, "opacity", 1.0f);
        draw_all();
    } else {
        draw_hidden_then_visible(line_program, draw_all);
    }
}

OverlayRenderer::OverlayRenderer(GlTable gl) : impl_(std::make_unique<Impl>(std::move(gl))) {
    impl_->build();
    assert_no_gl_error(*impl_->gl, "OverlayRenderer");
}

OverlayRenderer::~OverlayRenderer() {
    const GladGLContext& gl = *impl_->gl;
    for (const unsigned program : {impl_->line_program, impl_->triangle_program, impl_->ellipsoid_program}) {
        gl.DeleteProgram(program);
    }
    for (const unsigned* array : {&impl_->line_array, &impl_->triangle_array, &impl_->sphere_array}) {
        gl.DeleteVertexArrays(1, array);
    }
    for (const unsigned* buffer :
         {&impl_->line_buffer, &impl_->triangle_buffer, &impl_->sphere_buffer, &impl_->sphere_indices}) {
        gl.DeleteBuffers(1, buffer);
    }
}

Status OverlayRenderer::status() const {
    return impl_->status;
}

void OverlayRenderer::draw(const Overlay& overlay, const Camera& camera, int width, int height) {
    if (!impl_->status || width <= 0 || height <= 0) return;
    const GladGLContext& gl = *impl_->gl;
    gl.Viewport(0, 0, width, height);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Disable(GL_STENCIL_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthMask(GL_FALSE);

    std::vector<LineInstance> in_scene, on_top;
    for (const Overlay::Ellipsoid& e : overlay.ellipsoids) {
        if (drawable(e) && e.outline.alpha > 0.0f) append_ellipsoid_outline(e, camera, camera.eye, in_scene);
    }
    for (const Overlay::Line& line : overlay.lines) {
        if (!finite(line) || !(line.width > 0.0f)) continue;
        // Round ends of translucent segments would overlap visibly where the segments join.
        const LineKind kind = line.arrow                 ? LineKind::arrow
                              : line.color.alpha >= 1.0f ? LineKind::round
                                                         : LineKind::butt;
        const LineInstance instance = line_instance(line.a - camera.eye, line.b - camera.eye, line.color,
                                                    std::min(line.width, 64.0f), kind);
        (line.on_top ? on_top : in_scene).push_back(instance);
    }
    impl_->draw_triangles(overlay, camera, width, height);
    impl_->draw_ellipsoids(overlay, camera, width, height);
    impl_->draw_lines(in_scene, false, camera, width, height);
    impl_->draw_lines(on_top, true, camera, width, height);

    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_BLEND);
    gl.BindVertexArray(0);
    gl.UseProgram(0);
    assert_no_gl_error(gl, "OverlayRenderer::draw");
}

}  // namespace slipface
