#include "slipface/render/gl_context.h"

#include <glad/gl.h>

namespace slipface {

// The version string decides, not the pointers: OSMesa returns stubs for functions that it does not have.
Result<GlTable> load_gl_table(GlGetProc get_proc) {
    auto table = std::make_shared<GladGLContext>();
    const int version = get_proc == nullptr ? 0 : gladLoadGLContext(table.get(), get_proc);
    if (version == 0)
        return Error{"OpenGL", "found no usable OpenGL context, expected version 3.3 core or later"};
    if (!table->VERSION_3_3) {
        const auto* text = reinterpret_cast<const char*>(table->GetString(GL_VERSION));
        return Error{"OpenGL", std::string("found version ") + (text == nullptr ? "unknown" : text) +
                                   ", expected 3.3 core or later"};
    }
    return GlTable(std::move(table));
}

}  // namespace slipface
