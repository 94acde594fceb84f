// Small helpers over the GL function table, shared by the renderers of this module.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <string>

#include "slipface/base/result.h"
#include "slipface/render/gl_context.h"
#include "slipface/view/camera.h"

namespace slipface {

using Mat4f = Eigen::Matrix4f;

// Asserts in debug builds that no GL call has failed since the last call; `where` is shown.
void assert_no_gl_error(const GladGLContext& gl, const char* where);

// A linked program. The shaders are part of this module and valid GLSL 3.30, so an error means that the
// driver refused them; it contains the driver's log.
Result<unsigned> link_program(const GladGLContext& gl, const char* name, const std::string& vertex,
                              const std::string& fragment);

void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Mat4f& value);
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Eigen::Matrix3f& value);
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Eigen::Vector4f& value);
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Vec3f& value);
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, const Vec2f& value);
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, float value);
void set_uniform(const GladGLContext& gl, unsigned program, const char* name, int value);

// clip_from_world for positions relative to `origin`, which keeps single precision exact far from zero.
Mat4f clip_from_local(const Camera& camera, int width, int height, const Vec3& origin);

// What to add to a clip-space z to move a point nearer to the eye by `pixels` times the size of a pixel at
// its position. For a perspective with z_clip = A z_view + B, scaling a point by (1 - e) towards the eye
// changes z_clip by B e / (1 - e) at an unchanged w; for an orthographic camera it is A times the distance.
float depth_bias(const Camera& camera, int height, double pixels);

enum class LineKind {
    butt,
    round,
    arrow
};  // ends cut off at a and b; half-round beyond them; a head whose tip is b

// One segment of a line, an instance for the vertex shader of line_shaders.h.
struct LineInstance {
    float a[3];
    float b[3];
    std::uint8_t color[4];
    float width;  // pixels
    float kind;   // LineKind
    // Normals of the faces on both sides, packed as in LevelVertex; zero: none, which counts as facing the
    // eye.
    std::uint32_t normals[2];
};

// Binds `vertex_array` and describes `buffer` to it as LineInstance records for attributes 0 to 6.
void describe_line_instances(const GladGLContext& gl, unsigned vertex_array, unsigned buffer);

}  // namespace slipface
