// Contexts without a window. OSMesa and EGL are opened with dlopen: if libOSMesa were linked beside libGL,
// its exported gl* names would replace libGL's. The libraries stay open, because Mesa registers clean-up code
// that runs at exit.
#include <dlfcn.h>
#include <glad/gl.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "slipface/base/text.h"
#include "slipface/render/gl_context.h"

namespace slipface {

namespace {

// The software rasteriser crashes with 512-bit vectors in every tested Mesa release (22.3 to 26.2), and with
// 128-bit ones on some processors with wide vectors. 256 is its own default.
constexpr std::int64_t safe_vector_width = 256;

Warnings make_environment_safe() {
    Warnings warnings;
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    if (width == nullptr) return warnings;
    const auto value = parse_int(width);
    if (value == safe_vector_width) return warnings;
    warnings.push_back({"LP_NATIVE_VECTOR_WIDTH", std::string("found \"") + width +
                                                      "\", which crashes Mesa's software renderer; expected "
                                                      "256; the variable was unset"});
    unsetenv("LP_NATIVE_VECTOR_WIDTH");
    return warnings;
}

void* open_library(const std::vector<const char*>& names, std::string& tried) {
    for (const char* name : names) {
        if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
        tried += (tried.empty() ? "" : ", ") + std::string(name);
    }
    return nullptr;
}

template <class Function>
bool find_function(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    return function != nullptr;
}

class LoadedContext : public OffscreenContext {
  public:
    const GlTable& gl() const override { return gl_; }
    std::string renderer() const override { return text(GL_RENDERER); }
    std::string version() const override { return text(GL_VERSION); }
    const Warnings& warnings() const override { return warnings_; }

    Status load(Warnings warnings) {
        warnings_ = std::move(warnings);
        Result<GlTable> table = load_gl_table(get_proc());
        if (!table) return table.error();
        gl_ = *std::move(table);
        return {};
    }

  private:
    std::string text(unsigned name) const {
        const auto* value = reinterpret_cast<const char*>(gl_->GetString(name));
        return value == nullptr ? std::string() : value;
    }

    GlTable gl_;
    Warnings warnings_;
};

// The used part of OSMesa's interface (Mesa's osmesa.h, stable since version 11.2).
struct OsmesaLibrary {
    using Context = struct osmesa_context*;
    static constexpr int format = 0x22, rgba = 0x1908, depth_bits = 0x30, stencil_bits = 0x31, profile = 0x33,
                         core_profile = 0x34, major_version = 0x36, minor_version = 0x37;

    Context (*create_context_attribs)(const int* attributes, Context share) = nullptr;
    void (*destroy_context)(Context) = nullptr;
    unsigned char (*make_current)(Context, void* buffer, GLenum type, GLsizei width,
                                  GLsizei height) = nullptr;
    GlProc (*get_proc_address)(const char* name) = nullptr;
};

Result<const OsmesaLibrary*> osmesa_library() {
    static const Result<OsmesaLibrary> library = []() -> Result<OsmesaLibrary> {
        std::string tried;
        void* handle = open_library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, tried);
        if (handle == nullptr) {
            return Error{"OSMesa", "cannot open " + tried + " (Debian package libosmesa6)"};
        }
        OsmesaLibrary found;
        if (!find_function(handle, "OSMesaCreateContextAttribs", found.create_context_attribs) ||
            !find_function(handle, "OSMesaDestroyContext", found.destroy_context) ||
            !find_function(handle, "OSMesaMakeCurrent", found.make_current) ||
            !find_function(handle, "OSMesaGetProcAddress", found.get_proc_address)) {
            return Error{"OSMesa",
                         "the library lacks OSMesaCreateContextAttribs, expected version 11.2 or later"};
        }
        return found;
    }();
    if (!library) return library.error();
    return &library.value();
}

class OsmesaContext final : public LoadedContext {
  public:
    OsmesaContext(const OsmesaLibrary& library, OsmesaLibrary::Context context)
        : library_(library), context_(context) {}
    ~OsmesaContext() override {
        library_.make_current(nullptr, nullptr, 0, 0, 0);
        library_.destroy_context(context_);
    }
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    // All drawing goes to framebuffer objects, so the context's own buffer is one pixel.
    bool make_current() override {
        return library_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != 0;
    }
    GlGetProc get_proc() const override { return library_.get_proc_address; }
    std::string backend_name() const override { return "OSMesa"; }

  private:
    const OsmesaLibrary& library_;
    OsmesaLibrary::Context context_;
    std::array<unsigned char, 4> pixel_{};
};

Result<std::unique_ptr<OffscreenContext>> make_osmesa(const Warnings& warnings) {
    const auto library = osmesa_library();
    if (!library) return library.error();
    using L = OsmesaLibrary;
    const std::array attributes{L::format,  L::rgba,         L::depth_bits,    24, L::stencil_bits,  8,
                                L::profile, L::core_profile, L::major_version, 3,  L::minor_version, 3,
                                0};
    const L::Context handle = (*library)->create_context_attribs(attributes.data(), nullptr);
    if (handle == nullptr) return Error{"OSMesa", "the library refuses an OpenGL 3.3 core context"};
    auto context = std::make_unique<OsmesaContext>(**library, handle);
    if (!context->make_current()) return Error{"OSMesa", "the context cannot be made current on this thread"};
    if (Status status = context->load(warnings); !status) return status.error();
    return std::unique_ptr<OffscreenContext>(std::move(context));
}

// The used part of EGL's interface (Khronos EGL 1.5 and EGL_MESA_platform_surfaceless).
struct EglLibrary {
    using Handle = void*;
    static constexpr int platform_surfaceless = 0x31DD, opengl_api = 0x30A2, major_version = 0x3098,
                         minor_version = 0x30FB, profile_mask = 0x30FD, core_profile = 1, none = 0x3038;

    GlProc (*get_proc_address)(const char* name) = nullptr;
    unsigned (*bind_api)(unsigned api) = nullptr;
    unsigned (*initialize)(Handle display, int* major, int* minor) = nullptr;
    Handle (*create_context)(Handle display, Handle config, Handle share, const int* attributes) = nullptr;
    unsigned (*destroy_context)(Handle display, Handle context) = nullptr;
    unsigned (*make_current)(Handle display, Handle draw, Handle read, Handle context) = nullptr;
    Handle display = nullptr;  // initialised once, never terminated: contexts share it
};

Result<const EglLibrary*> egl_library() {
    static const Result<EglLibrary> library = []() -> Result<EglLibrary> {
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        std::string tried;
        void* handle = open_library({"libEGL.so.1", "libEGL.so"}, tried);
        if (handle == nullptr) return Error{"EGL", "cannot open " + tried + " (Debian package libegl1)"};
        EglLibrary found;
        if (!find_function(handle, "eglGetProcAddress", found.get_proc_address) ||
            !find_function(handle, "eglBindAPI", found.bind_api) ||
            !find_function(handle, "eglInitialize", found.initialize) ||
            !find_function(handle, "eglCreateContext", found.create_context) ||
            !find_function(handle, "eglDestroyContext", found.destroy_context) ||
            !find_function(handle, "eglMakeCurrent", found.make_current)) {
            return Error{"EGL", "the library lacks functions, expected EGL 1.4 or later"};
        }
        using GetPlatformDisplay =
            EglLibrary::Handle (*)(unsigned platform, void* native, const int* attributes);
        const auto get_display =
            reinterpret_cast<GetPlatformDisplay>(found.get_proc_address("eglGetPlatformDisplayEXT"));
        if (get_display == nullptr) return Error{"EGL", "the library lacks eglGetPlatformDisplayEXT"};
        found.display = get_display(EglLibrary::platform_surfaceless, nullptr, nullptr);
        if (found.display == nullptr || found.initialize(found.display, nullptr, nullptr) == 0) {
            return Error{"EGL", "no surfaceless display (Debian package libegl-mesa0)"};
        }
        return found;
    }();
    if (!library) return library.error();
    return &library.value();
}

class EglContext final : public LoadedContext {
  public:
    EglContext(const EglLibrary& library, EglLibrary::Handle context)
        : library_(library), context_(context) {}
    ~EglContext() override {
        library_.make_current(library_.display, nullptr, nullptr, nullptr);
        library_.destroy_context(library_.display, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    bool make_current() override {
        return library_.make_current(library_.display, nullptr, nullptr, context_) != 0;
    }
    GlGetProc get_proc() const override { return library_.get_proc_address; }
    std::string backend_name() const override { return "EGL surfaceless"; }

  private:
    const EglLibrary& library_;
    EglLibrary::Handle context_;
};

Result<std::unique_ptr<OffscreenContext>> make_egl(const Warnings& warnings) {
    const auto library = egl_library();
    if (!library) return library.error();
    using L = EglLibrary;
    (*library)->bind_api(L::opengl_api);
    const std::array attributes{L::major_version, 3,      L::minor_version, 3, L::profile_mask,
                                L::core_profile,  L::none};
    const L::Handle handle =
        (*library)->create_context((*library)->display, nullptr, nullptr, attributes.data());
    if (handle == nullptr)
        return Error{"EGL", "the library refuses an OpenGL 3.3 core context without a config"};
    auto context = std::make_unique<EglContext>(**library, handle);
    if (!context->make_current()) return Error{"EGL", "the context cannot be made current without a surface"};
    if (Status status = context->load(warnings); !status) return status.error();
    return std::unique_ptr<OffscreenContext>(std::move(context));
}

}  // namespace

// The backend that SLIPFACE_GL names, for a whole run and all its processes.
static OffscreenBackend wanted_backend() {
    const char* name = std::getenv("SLIPFACE_GL");
    if (name == nullptr) return OffscreenBackend::automatic;
    const std::string_view wanted = name;
    return wanted == "osmesa" ? OffscreenBackend::osmesa
           : wanted == "egl"  ? OffscreenBackend::egl
                              : OffscreenBackend::automatic;
}

Result<std::unique_ptr<OffscreenContext>> make_offscreen_context(OffscreenBackend backend) {
    const Warnings warnings = make_environment_safe();
    if (backend == OffscreenBackend::automatic) backend = wanted_backend();
    if (backend == OffscreenBackend::osmesa) return make_osmesa(warnings);
    if (backend == OffscreenBackend::egl) return make_egl(warnings);
    auto osmesa = make_osmesa(warnings);
    if (osmesa) return osmesa;
    auto egl = make_egl(warnings);
    if (egl) return egl;
    return Error{"off-screen rendering", "no context: " + osmesa.error().text() + "; " + egl.error().text()};
}

}  // namespace slipface
