// Lines as screen-space quads: drivers of a core profile need not draw lines wider than one pixel.
#pragma once

namespace slipface {

// Attributes: LineInstance (gl_util.h). Uniforms: clip_from_local, viewport (pixels), shortest (pixels:
// shorter segments fade out; 0: none do), opacity, depth_bias (clip space, added: negative is towards the
// eye).
inline constexpr const char* line_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 end_a;
layout(location = 1) in vec3 end_b;
layout(location = 2) in vec4 color;
layout(location = 3) in float width;
layout(location = 4) in float kind;
layout(location = 5) in vec4 normal_left;
layout(location = 6) in vec4 normal_right;
uniform mat4 clip_from_local;
uniform vec2 viewport;
uniform float shortest;
uniform float opacity;
uniform float depth_bias;
uniform vec4 cull_eye;  // as the level's `eye`: lines between faces that all look away are left out; 0: none are
flat out vec4 line_color;
flat out float half_width;
flat out float line_kind;
flat out float head;
flat out float segment_length;
noperspective out vec2 pixel_position;  // pixels: along the segment from a, across it

// The part of a segment behind the near plane has no position on the screen.
vec4 clipped(vec4 a, vec4 b) {
    float da = a.z + a.w;
    float db = b.z + b.w;
    return da < 0.0 && db > 0.0 ? mix(a, b, da / (da - db)) : a;
}

bool away(vec3 normal, vec3 to_eye) {
    return dot(to_eye, to_eye) > 0.0 && dot(normal, normal) > 0.5 && dot(normal, to_eye) <= 0.0;
}

void main() {
    vec4 raw_a = clip_from_local * vec4(end_a, 1.0);
    vec4 raw_b = clip_from_local * vec4(end_b, 1.0);
    vec4 a = clipped(raw_a, raw_b);
    vec4 b = clipped(raw_b, raw_a);
    vec2 pixel_a = 0.5 * viewport * a.xy / a.w;
    vec2 pixel_b = 0.5 * viewport * b.xy / b.w;
    vec2 along = pixel_b - pixel_a;
    segment_length = length(along);
    along = segment_length > 1e-6 ? along / segment_length : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);

    half_width = 0.5 * width;
    line_kind = kind;
    head = kind > 1.5 ? min(4.0 + 4.0 * width, 0.8 * segment_length) : 0.0;
    float reach = max(half_width, 0.45 * head) + 1.0;
    bool at_b = (gl_VertexID & 1) != 0;
    float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;
    float extension = kind > 0.5 ? reach : 0.0;
    pixel_position = vec2(at_b ? segment_length + extension : -extension, side * reach);

    line_color = vec4(color.rgb, color.a * opacity);
    if (shortest > 0.0) line_color.a *= smoothstep(shortest, 4.0 * shortest, segment_length);
    vec4 end = at_b ? b : a;
    vec2 offset = along * (at_b ? extension : -extension) + across * (side * reach);
    gl_Position = vec4(end.xy + offset * 2.0 / viewport * end.w, end.z + depth_bias, end.w);
    vec3 to_eye = cull_eye.xyz - cull_eye.w * end_a;
    bool looks_away = away(normal_left.xyz, to_eye) && away(normal_right.xyz, to_eye);
    bool behind = raw_a.z + raw_a.w < 0.0 && raw_b.z + raw_b.w < 0.0;
    if (behind || looks_away || line_color.a <= 0.0) gl_Position = vec4(2, 2, 2, 1);
}
)";

// Soft edges of one pixel: the distance to the segment against half the width. An arrow's head narrows to its
// point at b.
inline constexpr const char* line_fragment_shader = R"(#version 330 core
flat in vec4 line_color;
flat in float half_width;
flat in float line_kind;
flat in float head;
flat in float segment_length;
noperspective in vec2 pixel_position;
out vec4 out_color;

void main() {
    float end = segment_length - 0.7 * head;
    float beyond = line_kind > 0.5 ? max(max(-pixel_position.x, pixel_position.x - end), 0.0) : 0.0;
    float coverage = clamp(half_width + 0.5 - length(vec2(beyond, pixel_position.y)), 0.0, 1.0);
    if (head > 0.0) {
        float sides = (0.45 * (segment_length - pixel_position.x) - abs(pixel_position.y)) * 0.912 + 0.5;
        float base = pixel_position.x - (segment_length - head) + 0.5;
        coverage = max(coverage, clamp(min(sides, base), 0.0, 1.0));
    }
    if (coverage <= 0.0) discard;
    out_color = vec4(line_color.rgb, line_color.a * coverage);
}
)";

}  // namespace slipface
