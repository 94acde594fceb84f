// GLSL of the overlay's surfaces; its lines use line_shaders.h.
#pragma once

namespace slipface {

inline constexpr const char* overlay_triangle_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 clip_from_local;
uniform float opacity;
uniform float depth_bias;
flat out vec4 fill;
void main() {
    fill = vec4(color.rgb, color.a * opacity);
    gl_Position = clip_from_local * vec4(position, 1.0);
    gl_Position.z += depth_bias;
}
)";

inline constexpr const char* overlay_triangle_fragment_shader = R"(#version 330 core
flat in vec4 fill;
out vec4 out_color;
void main() { out_color = fill; }
)";

// The mesh is the unit sphere; normals of an ellipsoid divide by the radii where positions multiply.
inline constexpr const char* ellipsoid_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 clip_from_local;
uniform vec3 centre;
uniform vec3 radii;
out vec3 surface_position;
out vec3 normal;
void main() {
    surface_position = centre + radii * position;
    normal = position / radii;
    gl_Position = clip_from_local * vec4(surface_position, 1.0);
}
)";

// Like a soap bubble: clear in the middle, denser towards the rim.
inline constexpr const char* ellipsoid_fragment_shader = R"(#version 330 core
in vec3 surface_position;
in vec3 normal;
uniform vec4 fill;
uniform vec4 eye;  // w 1: the eye is the origin; w 0: direction towards it
uniform float opacity;
out vec4 out_color;
void main() {
    vec3 n = normalize(normal);
    vec3 to_eye = normalize(eye.xyz - eye.w * surface_position);
    float facing = clamp(dot(n, to_eye), 0.0, 1.0);
    float rim = (1.0 - facing) * (1.0 - facing);
    float light = 0.72 + 0.28 * clamp(dot(n, vec3(0.3714, 0.7985, 0.4737)), -0.6, 1.0);
    vec3 color = fill.rgb * light + vec3(0.10) * rim;
    float alpha = clamp(fill.a * (0.6 + 2.2 * rim), 0.0, 1.0);
    out_color = vec4(min(color, vec3(1.0)), alpha * opacity);
}
)";

}  // namespace slipface
