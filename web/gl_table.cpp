// The function table of a WebGL 2 context: OpenGL ES 3.0, with what the renderers take from OpenGL 3.3 put
// into terms of it.
#include <emscripten/html5.h>
#include <glad/gl.h>

#include <string>

#include "slipface/render/gl_context.h"

namespace slipface {
namespace {

const GladGLContext* es = nullptr;  // a page has one context

void replace_all(std::string& text, std::string_view before, std::string_view after) {
    for (std::size_t at = text.find(before); at != std::string::npos;
         at = text.find(before, at + after.size()))
        text.replace(at, before.size(), after);
}

// GLSL 3.30 as GLSL ES 3.00. There everything that a fragment reads is interpolated in perspective: what
// should not be is multiplied by w before and divided by it afterwards.
std::string as_es(std::string text) {
    replace_all(text, "#version 330 core\n",
                "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
                "precision highp usampler2D;\n");
    constexpr std::string_view out = "noperspective out vec2 ", in = "noperspective in vec2 ";
    if (const std::size_t at = text.find(out); at != std::string::npos) {
        const std::size_t end = text.find(';', at);
        const std::string name = text.substr(at + out.size(), end - at - out.size());
        text.insert(text.rfind('}'), name + "_times_w = vec3(" + name + ", 1.0) * gl_Position.w;\n");
        text.replace(at, end - at, "out vec3 " + name + "_times_w;\nvec2 " + name);
    }
    if (const std::size_t at = text.find(in); at != std::string::npos) {
        const std::size_t end = text.find(';', at);
        const std::string name = text.substr(at + in.size(), end - at - in.size());
        const std::string divided = "(" + name + "_times_w.xy / " + name + "_times_w.z)";
        text.replace(at, end + 1 - at, "in vec3 " + name + "_times_w;\n#define " + name + " " + divided);
    }
    return text;
}

void shader_source(GLuint shader, GLsizei count, const GLchar* const* parts, const GLint*) {
    std::string text;
    for (GLsizei i = 0; i < count; ++i)
        text += parts[i];
    text = as_es(std::move(text));
    const char* const whole = text.c_str();
    static const auto original =
        reinterpret_cast<PFNGLSHADERSOURCEPROC>(emscripten_webgl_get_proc_address("glShaderSource"));
    original(shader, 1, &whole, nullptr);
}

GlProc get_proc_of_browser(const char* name) {
    return reinterpret_cast<GlProc>(emscripten_webgl_get_proc_address(name));
}

}  // namespace

Result<GlTable> load_gl_table(GlGetProc) {
    auto table = std::make_shared<GladGLContext>();
    if (gladLoadGLES2Context(table.get(), get_proc_of_browser) == 0 || !table->ES_VERSION_3_0)
        return Error{"WebGL", "found no usable context, expected WebGL 2"};
    es = table.get();
    table->ShaderSource = shader_source;
    table->PolygonMode = [](GLenum, GLenum) {};  // only ever asked to fill
    table->ClearDepth = [](GLdouble depth) { es->ClearDepthf(static_cast<GLfloat>(depth)); };
    table->DrawElementsBaseVertex = [](GLenum mode, GLsizei count, GLenum type, const void* first, GLint) {
        es->DrawElements(mode, count, type, first);  // indices of 32 bits need no base
    };
    // A browser waits for no fence; the fences only bound a software rasteriser's memory.
    table->ClientWaitSync = [](GLsync, GLbitfield, GLuint64) -> GLenum { return GL_ALREADY_SIGNALED; };
    return GlTable(std::move(table));
}

}  // namespace slipface
