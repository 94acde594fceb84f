#include "app/ui_renderer.h"

#include <glad/gl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "widgets/imgui_compat.h"

namespace slipface {
namespace {

constexpr const char* vertex_source = R"(#version 330 core
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
uniform mat4 projection;
out vec2 fragment_uv;
out vec4 fragment_color;
void main() {
    fragment_uv = uv;
    fragment_color = color;
    gl_Position = projection * vec4(position, 0.0, 1.0);
}
)";

constexpr const char* fragment_source = R"(#version 330 core
in vec2 fragment_uv;
in vec4 fragment_color;
uniform sampler2D picture;
out vec4 result;
void main() { result = fragment_color * texture(picture, fragment_uv); }
)";

GLuint compile(const GladGLContext& gl, GLenum kind, const char* source) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    return shader;
}

const void* byte_offset(std::size_t offset) {
    return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset));
}

void fill(const GladGLContext& gl, GLuint texture, int row) {
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, row);
}

ui::TextureStore texture_store(const GlTable& table) {
    return {
        .make = [table](int width, int height, const void* pixels) -> unsigned {
            const GladGLContext& gl = *table;
            GLuint texture = 0;
            gl.GenTextures(1, &texture);
            fill(gl, texture, 0);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
            gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
            gl.BindTexture(GL_TEXTURE_2D, 0);
            return texture;
        },
        .update =
            [table](unsigned texture, int x, int y, int width, int height, const void* pixels, int row) {
                const GladGLContext& gl = *table;
                fill(gl, texture, row);
                gl.TexSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
                gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
                gl.BindTexture(GL_TEXTURE_2D, 0);
            },
        .remove =
            [table](unsigned texture) {
                const GLuint name = texture;
                table->DeleteTextures(1, &name);
            },
    };
}

}  // namespace

UiRenderer::UiRenderer(GlTable table) : gl_(std::move(table)), textures_(texture_store(gl_)) {
    const GladGLContext& gl = *gl_;
    const GLuint vertex = compile(gl, GL_VERTEX_SHADER, vertex_source);
    const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_source);
    program_ = gl.CreateProgram();
    gl.AttachShader(program_, vertex);
    gl.AttachShader(program_, fragment);
    gl.LinkProgram(program_);
    gl.DeleteShader(vertex);
    gl.DeleteShader(fragment);
    projection_location_ = gl.GetUniformLocation(program_, "projection");
    texture_location_ = gl.GetUniformLocation(program_, "picture");

    gl.GenVertexArrays(1, &vertex_array_);
    gl.GenBuffers(1, &vertices_);
    gl.GenBuffers(1, &indices_);
    gl.BindVertexArray(vertex_array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    constexpr GLsizei stride = sizeof(ImDrawVert);
    gl.EnableVertexAttribArray(0);
    gl.EnableVertexAttribArray(1);
    gl.EnableVertexAttribArray(2);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, byte_offset(offsetof(ImDrawVert, pos)));
    gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, byte_offset(offsetof(ImDrawVert, uv)));
    gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, byte_offset(offsetof(ImDrawVert, col)));
    gl.BindVertexArray(0);

    ImGuiIO& io = ImGui::GetIO();
    io.BackendRendererName = "slipface";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

UiRenderer::~UiRenderer() {
    const GladGLContext& gl = *gl_;
    ui::remove_textures(textures_);
    gl.DeleteBuffers(1, &vertices_);
    gl.DeleteBuffers(1, &indices_);
    gl.DeleteVertexArrays(1, &vertex_array_);
    gl.DeleteProgram(program_);
}

void UiRenderer::draw(const ImDrawData& data) {
    const GladGLContext& gl = *gl_;
    const float width = data.DisplaySize.x * data.FramebufferScale.x;
    const float height = data.DisplaySize.y * data.FramebufferScale.y;
    if (width < 1.0f || height < 1.0f) return;
    ui::serve_textures(data, textures_);

    gl.Viewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_STENCIL_TEST);
    gl.Enable(GL_SCISSOR_TEST);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    const float left = data.DisplayPos.x, top = data.DisplayPos.y;
    const float sx = 2.0f / data.DisplaySize.x, sy = -2.0f / data.DisplaySize.y;
    const float projection[16] = {sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, -1, 0, -1 - left * sx, 1 - top * sy, 0, 1};
    gl.UseProgram(program_);
    gl.Uniform1i(texture_location_, 0);
    gl.UniformMatrix4fv(projection_location_, 1, GL_FALSE, projection);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindSampler(0, 0);
    gl.BindVertexArray(vertex_array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);

    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        gl.BufferData(
            GL_ARRAY_BUFFER,
            static_cast<GLsizeiptr>(list.VtxBuffer.Size) * static_cast<GLsizeiptr>(sizeof(ImDrawVert)),
            list.VtxBuffer.Data, GL_STREAM_DRAW);
        gl.BufferData(
            GL_ELEMENT_ARRAY_BUFFER,
            static_cast<GLsizeiptr>(list.IdxBuffer.Size) * static_cast<GLsizeiptr>(sizeof(ImDrawIdx)),
            list.IdxBuffer.Data, GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback) {
                if (command.UserCallback != ImDrawCallback_ResetRenderState)
                    command.UserCallback(&list, &command);
                continue;
            }
            const float x0 = (command.ClipRect.x - left) * data.FramebufferScale.x;
            const float y0 = (command.ClipRect.y - top) * data.FramebufferScale.y;
            const float x1 = (command.ClipRect.z - left) * data.FramebufferScale.x;
            const float y1 = (command.ClipRect.w - top) * data.FramebufferScale.y;
            if (x1 <= x0 || y1 <= y0) continue;
            gl.Scissor(static_cast<GLint>(x0), static_cast<GLint>(height - y1), static_cast<GLsizei>(x1 - x0),
                       static_cast<GLsizei>(y1 - y0));
            gl.BindTexture(GL_TEXTURE_2D, ui::texture_name(command.GetTexID()));
            gl.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                                      sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                                      byte_offset(command.IdxOffset * sizeof(ImDrawIdx)),
                                      static_cast<GLint>(command.VtxOffset));
        }
    }
    gl.BindVertexArray(0);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.UseProgram(0);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Disable(GL_BLEND);
}

}  // namespace slipface
