// GLSL of the level's faces and of the background. The faces' shaders are compiled in variants without the
// branches that an image does not need (LevelPrograms): a software rasteriser runs every branch for every
// pixel, taken or not.
//   PAINTED   faces may have surface types or highlights, or are coloured by slope
//   LIT       by the baked light
//   TEXTURED  with the material's texture
//   CUTOUT    which may be transparent
//   PLACED    an instance of a mesh
//   POSED     which follows bones
#pragma once

namespace slipface {

inline constexpr const char* background_vertex_shader = R"(#version 330 core
out float height;
out vec2 screen_position;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    height = 0.5 + 0.5 * corner.y;
    screen_position = corner;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// A gradient over the image, or the level's sky in the direction of each pixel.
inline constexpr const char* background_fragment_shader = R"(#version 330 core
in float height;
in vec2 screen_position;
uniform vec3 top;
uniform vec3 bottom;
uniform int sky;
uniform mat4 direction_from_screen;  // of a point (x, y, 1) of the picture, both -1..1
uniform vec3 sky_zenith;             // linear
uniform vec3 sky_horizon;
uniform vec3 sun;                    // unit; zero: none
uniform vec3 sun_color;
out vec4 out_color;
void main() {
    out_color = vec4(mix(bottom, top, smoothstep(0.0, 1.0, height)), 1.0);
    if (sky == 0) return;
    vec3 d = normalize((direction_from_screen * vec4(screen_position, 1.0, 0.0)).xyz);
    float up = clamp(d.y, 0.0, 1.0);
    vec3 color = mix(sky_horizon, sky_zenith, up * (2.0 - up));
    color *= 1.0 - 0.45 * smoothstep(0.0, 0.35, -d.y);
    float near_sun = clamp(dot(d, sun), 0.0, 1.0);
    float glow = near_sun * near_sun;
    glow *= glow;
    glow *= glow;
    color += sun_color * (0.10 * glow + 0.25 * glow * glow * glow * glow + smoothstep(0.9990, 0.9994, near_sun));
    out_color = vec4(sqrt(clamp(color, 0.0, 1.0)), 1.0);
}
)";

// face_state: red = surface type, green = highlight bits, faces in rows of the texture's width.
// light_charts: see LightMap; three texels per face, in rows of the texture's width.
inline constexpr const char* level_vertex_shader = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in uint face;
layout(location = 4) in vec4 color;
uniform mat4 clip_from_local;
#ifdef PLACED
uniform mat3 world_from_mesh;     // of an instance
uniform mat3 normal_from_mesh;
uniform vec3 mesh_offset;
uniform int first_state;          // of the instance, in face_state
uniform vec4 uv_change;           // factors, then offsets
#endif
#ifdef POSED
layout(location = 5) in uvec4 bones;
layout(location = 6) in vec4 bone_weights;
layout(location = 7) in uvec2 deltas;  // of morph targets: the first, and how many
uniform sampler2D poses;               // three texels for each bone, then one for each weight
uniform int first_pose;
uniform int first_weight;
uniform sampler2D morph_deltas;        // what is added, and by which weight
vec4 texel_of(sampler2D list, int i) {
    int row = textureSize(list, 0).x;
    return texelFetch(list, ivec2(i % row, i / row), 0);
}
#endif
uniform usampler2D face_state;
uniform sampler2D light_charts;
uniform vec4 eye;                 // w 1: position; w 0: direction towards an orthographic camera
uniform float depth_bias;         // clip space, towards the eye if added
out vec3 world_position;
out vec2 texture_position;
flat out vec3 face_normal;
flat out vec3 face_color;
#ifdef PAINTED
flat out uvec2 state;
#endif
#ifdef LIT
out vec2 light_texel;             // texels from the chart's first texel centre
flat out vec4 light_chart;        // first texel centre, texels to the last one
#endif

void main() {
#ifdef LIT
    int faces = textureSize(light_charts, 0).x / 3;
    ivec2 at = ivec2(3 * (int(face) % faces), int(face) / faces);
    vec4 u = texelFetch(light_charts, at, 0);
    vec4 v = texelFetch(light_charts, at + ivec2(1, 0), 0);
    light_chart = texelFetch(light_charts, at + ivec2(2, 0), 0);
    light_texel = vec2(dot(u.xyz, position) + u.w, dot(v.xyz, position) + v.w);
#endif
    vec3 in_mesh = position;
    vec3 mesh_normal = normal.xyz;
#ifdef POSED
    for (int i = 0; i < int(deltas.y); ++i) {
        vec4 delta = texel_of(morph_deltas, int(deltas.x) + i);
        in_mesh += delta.xyz * texel_of(poses, first_weight + int(delta.w)).x;
    }
    mat3x4 rows = mat3x4(0.0);
    for (int i = 0; i < 4; ++i)
        if (bone_weights[i] > 0.0)
            for (int row = 0; row < 3; ++row)
                rows[row] += bone_weights[i] * texel_of(poses, first_pose + 3 * int(bones[i]) + row);
    in_mesh = vec4(in_mesh, 1.0) * rows;
    // The cofactors turn normals, whatever the scale.
    mat3 m = transpose(mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz));
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    mesh_normal = cofactors * mesh_normal * sign(dot(m[0], cofactors[0]));
#endif
#ifdef PLACED
    world_position = world_from_mesh * in_mesh + mesh_offset;
    face_normal = normalize(normal_from_mesh * mesh_normal);
#else
    world_position = position;
    face_normal = normal.xyz;
#endif
#ifdef PLACED
    texture_position = uv * uv_change.xy + uv_change.zw;
#else
    texture_position = uv;
#endif
    face_color = color.rgb;
    gl_Position = clip_from_local * vec4(world_position, 1.0);
    // Where two faces lie back to back at one position, the front is shown.
    if (dot(face_normal, eye.xyz - eye.w * world_position) < 0.0) gl_Position.z -= depth_bias;
#ifdef PAINTED
    int row = textureSize(face_state, 0).x;
    int at_state = int(face);
#ifdef PLACED
    at_state += first_state;
#endif
    state = texelFetch(face_state, ivec2(at_state % row, at_state / row), 0).rg;
    // A hidden face has all its corners at one position outside the picture.
    if ((state.y & 4u) != 0u) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
#endif
}
)";

// Colours are squared to be lit and take the square root at the end: close to sRGB, and exact operations, so
// that every processor gives the same pixels.
inline constexpr const char* level_fragment_shader_head = R"(
in vec3 world_position;
in vec2 texture_position;
flat in vec3 face_normal;
flat in vec3 face_color;
#ifdef PAINTED
flat in uvec2 state;
#endif
uniform sampler2D surface_table;  // row 0: colour, and the hatch in 255ths; row 1: cosine of the slope limit in two bytes, whether it has one
uniform int face_colors;          // 0: types, 1: slope, 2: walkable
uniform float slope_cosine;       // of types without a limit of their own
uniform sampler2D material_texture;
uniform int use_color;            // 1: the material's
uniform float overlay;
uniform vec4 eye;
uniform vec3 fade_color;
uniform vec2 fade_range;          // metres
uniform sampler2D light_map;
uniform float haze;               // metres; 0: none
out vec4 out_color;

// Tone: what is lit brightly comes near white and never reaches it, so that marks are seen on it; what is dark
// gains a little.
// Scaled by its brightness as a whole: each channel for itself would turn bright sand into grey.
vec3 toned(vec3 light) { return 1.25 * light / (1.0 + 1.5 * dot(light, vec3(0.2126, 0.7152, 0.0722))); }

#ifdef LIT
in vec2 light_texel;
flat in vec4 light_chart;
// The baked light at this position. Clamped to the face's own texels: where a pixel is drawn at the border of a face, its position
// may lie beside it.
vec3 baked_light() {
    vec2 texel = light_chart.xy + clamp(light_texel, vec2(0.0), light_chart.zw);
    vec3 encoded = texture(light_map, texel / vec2(textureSize(light_map, 0))).rgb;
    return 2.0 * encoded * encoded;
}
#endif

// Fraction of ink of a stripe of `width` (of period 1) at x; `change` is how far x moves from pixel to pixel. Stripes too dense
// to be seen become their mean.
float stripe(float x, float width, float change) {
    float ink = clamp((0.5 * width - abs(fract(x) - 0.5)) / max(change, 1e-6) + 0.5, 0.0, 1.0);
    return mix(ink, width, smoothstep(0.3, 0.7, change));
}

float stripe(float x, float width) { return stripe(x, width, length(vec2(dFdx(x), dFdy(x)))); }

float hatch(int pattern, vec2 p, float change) {
    vec2 cell = fract(p) - 0.5;
    float seen = 1.0 - smoothstep(0.25, 0.6, change);
    float along = pattern == 4 ? p.y : pattern == 5 ? p.x : p.x + p.y;
    float first = stripe(along, pattern == 2 ? 0.22 : 0.32);
    if (pattern == 2) return max(first, stripe(p.x - p.y, 0.22));
    if (pattern == 1 || pattern == 4 || pattern == 5) return first;
    if (pattern == 3) return mix(0.2, clamp((0.25 - length(cell)) / change + 0.5, 0.0, 1.0), seen);
    if (pattern == 6) {
        vec2 side = clamp((abs(cell) - 0.25) / change, -0.5, 0.5);
        return mix(0.5, 0.5 - 2.0 * side.x * side.y, seen);
    }
    if (pattern == 7) {
        float ring = abs(length(cell) - 0.3);
        return mix(0.38, clamp((0.10 - ring) / change + 0.5, 0.0, 1.0), seen);
    }
    return 0.0;
}
)";

inline constexpr const char* level_fragment_shader_main = R"(
// World planes, not the face's own: neighbours continue each other's pattern. Floors win ties, so that a ramp of 45 degrees
// has one pattern.
vec2 plane_position(vec3 n) {
    vec3 a = abs(n);
    if (a.y * 1.1 >= max(a.x, a.z)) return vec2(world_position.x, -world_position.z);
    return a.x > a.z * 1.001 ? vec2(-world_position.z, world_position.y) : vec2(world_position.x, world_position.y);
}

// The pattern at the power-of-two size that suits the distance, blended from one size to the next.
float hatch_at_distance(int pattern, vec2 p) {
    vec2 across = vec2(length(vec2(dFdx(p.x), dFdy(p.x))), length(vec2(dFdx(p.y), dFdy(p.y))));
    float metres_per_pixel = max(max(across.x, across.y) * 0.6 + min(across.x, across.y) * 0.4, 1e-7);
    float level = clamp(log2(metres_per_pixel * 18.0 / 0.5), -2.0, 5.0);
    float size = 0.5 * exp2(floor(level));
    float change = max(across.x, across.y) / size;
    float fine = hatch(pattern, p / size, change);
    float coarse = hatch(pattern, p / (2.0 * size), 0.5 * change);
    return mix(fine, coarse, smoothstep(0.6, 1.0, fract(level)));
}

// Lines a metre apart, stronger every eighth: scale for levels without textures.
float metre_grid(vec2 p) {
    vec2 change = vec2(length(vec2(dFdx(p.x), dFdy(p.x))), length(vec2(dFdx(p.y), dFdy(p.y))));
    vec2 one = clamp(1.0 - abs(fract(p + 0.5) - 0.5) / max(change, 1e-6), 0.0, 1.0);
    vec2 eight = clamp(1.0 - abs(fract(p / 8.0 + 0.5) - 0.5) * 8.0 / max(change, 1e-6), 0.0, 1.0);
    float near = 1.0 - smoothstep(0.08, 0.35, max(change.x, change.y));
    float far = 1.0 - smoothstep(0.5, 2.5, max(change.x, change.y));
    return max(max(one.x, one.y) * near * 0.5, max(eight.x, eight.y) * far);
}

float slope_limit(int surface) {
    vec4 own = texelFetch(surface_table, ivec2(surface, 1), 0);
    return own.b > 0.5 ? (own.r * 65280.0 + own.g * 255.0) / 65535.0 : slope_cosine;
}

// Blue where it is flat, pale at the limit, then from light to dark red; violet where one cannot stand at all.
vec3 slope_color(float up, float limit) {
    if (up < -1e-4) return vec3(0.36, 0.27, 0.50);
    if (up + 2e-5 >= limit) return mix(vec3(0.86, 0.88, 0.80), vec3(0.10, 0.36, 0.66), clamp((up - limit) / max(1.0 - limit, 1e-4), 0.0, 1.0));
    return mix(vec3(0.95, 0.55, 0.50), vec3(0.55, 0.05, 0.10), clamp((limit - up) / max(limit, 1e-4), 0.0, 1.0));
}

vec3 walk_color(float up, float limit) {
    if (up < -1e-4) return vec3(0.36, 0.27, 0.50);
    return up + 2e-5 >= limit ? vec3(0.20, 0.56, 0.78) : vec3(0.80, 0.20, 0.25);
}

void main() {
    bool back = !gl_FrontFacing;
    vec3 n = back ? -face_normal : face_normal;
    vec2 p = plane_position(face_normal);

    float sky = 0.5 + 0.5 * n.y;
    float key = max(dot(n, vec3(0.6015, 0.7018, 0.3810)) * 0.8 + 0.2, 0.0);
    vec3 light = mix(vec3(0.20, 0.19, 0.20), vec3(0.42, 0.45, 0.50), sky) + key * vec3(0.60, 0.57, 0.52);

#ifdef LIT
    bool lit = light_chart.x > 0.0;  // terrain has no chart
    vec3 baked = baked_light();
#else
    const bool lit = false;
    const vec3 baked = vec3(1.0);
#endif
#ifdef TEXTURED
    vec4 texel = texture(material_texture, texture_position);
    vec3 base = texel.rgb * texel.rgb;
    base = lit ? toned(base * baked) : base * mix(vec3(1.0), light, 0.72);
#else
    vec3 albedo = use_color == 1 ? face_color * face_color : vec3(0.46, 0.47, 0.49);
    vec3 base = lit ? toned(albedo * baked) : albedo * light * (1.0 - 0.16 * metre_grid(p));
#endif
#ifdef CUTOUT
#ifdef PAINTED
    if (texel.a < 0.5 && state == uvec2(0)) discard;
#else
    if (texel.a < 0.5) discard;
#endif
#endif

#ifdef PAINTED
    int surface = int(state.x);
    bool hovered = (state.y & 1u) != 0u;
    bool selected = (state.y & 2u) != 0u;
    vec4 type = texelFetch(surface_table, ivec2(surface, 0), 0);
    float limit = slope_limit(surface);
    bool steep = face_normal.y + 2e-5 < limit;
    int pattern = int(type.a * 255.0 + 0.5);
    if (face_colors != 0) pattern = !steep ? 0 : face_normal.y < -1e-4 ? 2 : 1;
    float ink = hatch_at_distance(pattern, p);
    if (face_colors != 0) {
        vec3 paint = face_colors == 1 ? slope_color(face_normal.y, limit) : walk_color(face_normal.y, limit);
        float strength = max(overlay, 0.6);
        base = mix(base, paint * paint * mix(vec3(0.95), light, 0.8), strength);
        if (face_colors == 2) base = mix(base, base * 0.45, ink * strength);
    } else if (surface != 0) {
        vec3 paint = type.rgb * type.rgb * mix(vec3(0.95), light, 0.8);
        // The hatch differs from the ground, not only from the type's own colour: a floor of ice is pale blue
        // before it is painted. The ground's mean, or the hatch would change within a texture.
#ifdef TEXTURED
        vec3 mean = textureLod(material_texture, texture_position, 16.0).rgb;
        mean *= mean;
        vec3 ground = lit ? toned(mean * baked) : mean * mix(vec3(1.0), light, 0.72);
#else
        vec3 ground = base;
#endif
        vec3 stroke = dot(ground, vec3(0.2126, 0.7152, 0.0722)) > 0.24 ? paint * 0.04 : mix(paint, vec3(1.0), 0.85);
        base = mix(base, paint, min(overlay * 1.15, 1.0));
        base = mix(base, stroke, ink * min(1.55 * overlay, 1.0));
    }
    if (selected) base = mix(base, vec3(0.85, 0.05, 1.0) * mix(vec3(0.9), light, 0.6), 0.5);
    if (hovered) base = mix(base, vec3(1.0), 0.30);
#endif
    if (back) {
        float warning = stripe((gl_FragCoord.x + gl_FragCoord.y) / 14.0, 0.5, 1.0 / 14.0);
        base = base * vec3(0.42, 0.20, 0.18) + vec3(0.035, 0.004, 0.004) + warning * vec3(0.030, 0.0, 0.0);
    }

    vec3 shown = sqrt(clamp(base, 0.0, 1.0));
    float away = distance(eye.xyz, world_position) * eye.w;
    float fade = 0.30 * smoothstep(fade_range.x, fade_range.y, away);
#ifdef LIT
    fade = haze > 0.0 ? 0.9 * away * away / (away * away + haze * haze) : 0.0;
#endif
    out_color = vec4(mix(shown, fade_color, fade), 1.0);
}
)";

}  // namespace slipface
