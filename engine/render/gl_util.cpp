#include "gl_util.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace slipface {

void assert_no_gl_error([[maybe_unused]] const GladGLContext& gl, [[maybe_unused]] const char* where) {
#ifndef NDEBUG
    const GLenum error = gl.GetError();
    if (error != GL_NO_ERROR) {
        std::fprintf(stderr, "slipface: GL error 0x%04x in %s\n", error, where);
        assert(error == GL_NO_ERROR);
    }
#endif
}

namespace {

Result<unsigned> compile_shader(const GladGLContext& gl, GLenum kind, const char* name,
                                const std::string& source) {
    const unsigned shader = gl.CreateShader(kind);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint compiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteShader(shader);
    return Error{std::string("shader ") + name, "the graphics driver rejects the shader: " + log};
}

}  // namespace

Result<unsigned> link_program(const GladGLContext& gl, const char* name, const std::string& vertex,
                              const std::string& fragment) {
    Result<unsigned> vertex_shader = compile_shader(gl, GL_VERTEX_SHADER, name, vertex);
    if (!vertex_shader) return vertex_shader.error();
    Result<unsigned> fragment_shader = compile_shader(gl, GL_FRAGMENT_SHADER, name, fragment);
    if (!fragment_shader) {
        gl.DeleteShader(*vertex_shader);
        return fragment_shader.error();
    }
    const unsigned program = gl.CreateProgram();
    gl.AttachShader(program, *vertex_shader);
    gl.AttachShader(program, *fragment_shader);
    gl.LinkProgram(program);
    gl.DeleteShader(*vertex_shader);
    gl.DeleteShader(*fragment_shader);
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteProgram(program);
    return Error{std::string("shader ") + name, "the graphics driver does not link it: " + log};
}

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Eigen::Matrix3f& value) {
    gl.UniformMatrix3fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, value.data());
}
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Mat4f& value) {
    gl.UniformMatrix4fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, value.data());
}

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Eigen::Vector4f& value) {
    gl.Uniform4f(gl.GetUniformLocation(program, name), value.x(), value.y(), value.z(), value.w());
}

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Vec3f& value) {
    gl.Uniform3f(gl.GetUniformLocation(program, name), value.x(), value.y(), value.z());
}

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Vec2f& value) {
    gl.Uniform2f(gl.GetUniformLocation(program, name), value.x(), value.y());
}

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, float value) {
    gl.Uniform1f(gl.GetUniformLocation(program, name), value);
}

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, int value) {
    gl.Uniform1i(gl.GetUniformLocation(program, name), value);
}

Mat4f clip_from_local(const Camera& camera, int width, int height, const Vec3& origin) {
    Mat4 view = view_from_world(camera);
    view.col(3).head<3>() += view.topLeftCorner<3, 3>() * origin;
    const double aspect = static_cast<double>(width) / static_cast<double>(height);
    return (clip_from_view(camera, aspect) * view).cast<float>();
}

float depth_bias(const Camera& camera, int height, double pixels) {
    const Mat4 clip = clip_from_view(camera, 1.0);
    if (camera.orthographic) return static_cast<float>(clip(2, 2) * pixels * camera.ortho_height / height);
    const double fraction = std::min(0.5, pixels * 2.0 * std::tan(0.5 * camera.fov_y) / height);
    return static_cast<float>(clip(2, 3) * fraction / (1.0 - fraction));
}

void describe_line_instances(const GladGLContext& gl, unsigned vertex_array, unsigned buffer) {
    constexpr GLsizei stride = sizeof(LineInstance);
    gl.BindVertexArray(vertex_array);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(LineInstance, a)));
    gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(LineInstance, b)));
    gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(LineInstance, color)));
    gl.VertexAttribPointer(3, 1, GL_FLOAT, GL_FALSE, stride, offset(offsetof(LineInstance, width)));
    gl.VertexAttribPointer(4, 1, GL_FLOAT, GL_FALSE, stride, offset(offsetof(LineInstance, kind)));
    for (unsigned side = 0; side < 2; ++side) {
        gl.VertexAttribPointer(5 + side, 4, GL_INT_2_10_10_10_REV, GL_TRUE, stride,
                               offset(offsetof(LineInstance, normals) + side * sizeof(std::uint32_t)));
    }
    for (unsigned attribute = 0; attribute < 7; ++attribute) {
        gl.EnableVertexAttribArray(attribute);
        gl.VertexAttribDivisor(attribute, 1);
    }
    gl.BindVertexArray(0);
}

}  // namespace slipface
