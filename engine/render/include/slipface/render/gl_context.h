// OpenGL 3.3 core through one function table per context, and off-screen contexts without a display.
#pragma once

#include <memory>
#include <string>

#include "slipface/base/result.h"
#include "slipface/image/image.h"

struct GladGLContext;

namespace slipface {

using GlProc = void (*)();
using GlGetProc = GlProc (*)(const char* name);

// The functions of one context; valid while that context is current.
using GlTable = std::shared_ptr<const GladGLContext>;

// Loads the function table of the context that is current on this thread. Error: a version below 3.3.
Result<GlTable> load_gl_table(GlGetProc get_proc);

enum class OffscreenBackend { automatic, osmesa, egl };

// A context without a window. Its libraries are opened at run time. Use only one kind of context (off-screen
// or GLFW) in a process, because they would share Mesa's dispatch.
class OffscreenContext {
  public:
    virtual ~OffscreenContext() = default;
    virtual const GlTable& gl() const = 0;
    virtual GlGetProc get_proc() const = 0;
    virtual std::string backend_name() const = 0;  // "OSMesa", "EGL surfaceless"
    virtual std::string renderer() const = 0;      // GL_RENDERER
    virtual std::string version() const = 0;       // GL_VERSION
    virtual bool make_current() = 0;               // on this thread; false: the library refused
    virtual const Warnings& warnings() const = 0;  // about the environment, for the user
};

// Opens a context and makes it current on this thread. `automatic`: the backend in the environment variable
// SLIPFACE_GL (osmesa or egl), else OSMesa, else EGL surfaceless. The error lists the attempts and the
// packages that provide the libraries.
Result<std::unique_ptr<OffscreenContext>> make_offscreen_context(
    OffscreenBackend backend = OffscreenBackend::automatic);

inline constexpr int max_framebuffer_side = 8192;  // pixels

// A colour (RGBA8) and depth target with 4x multisampling that is resolved into a texture. Sides are clamped
// to 1..max_framebuffer_side and to the driver's maximum. Use and destroy it only while its context is
// current.
class Framebuffer {
  public:
    Framebuffer(GlTable gl, int width, int height);
    ~Framebuffer();
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;

    int width() const { return width_; }
    int height() const { return height_; }
    void bind();        // for drawing; sets the viewport
    void bind_draft();  // likewise, but straight into the texture with one sample per pixel: no resolve()
    void resolve();     // multisampled colour into the texture
    unsigned texture() const { return resolve_texture_; }  // as of the last resolve(); rows from the bottom
    Image read();                                          // resolves; rows from the top, alpha 255

  private:
    GlTable gl_;
    int width_, height_;
    unsigned msaa_framebuffer_ = 0, msaa_color_ = 0, msaa_depth_ = 0, resolve_framebuffer_ = 0,
             resolve_texture_ = 0, draft_depth_ = 0;
};

}  // namespace slipface
