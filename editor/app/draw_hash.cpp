#include "app/draw_hash.h"

#include "widgets/imgui_compat.h"

namespace slipface {
namespace {

void add(Hasher& hasher, const Vec3& v) {
    for (int i = 0; i < 3; ++i)
        hasher.f64(v[i]);
}

void add(Hasher& hasher, const Color& color) {
    for (const float part : {color.red, color.green, color.blue, color.alpha})
        hasher.f64(static_cast<double>(part));
}

void add(Hasher& hasher, const Vec3f& color) {
    for (int i = 0; i < 3; ++i)
        hasher.f64(static_cast<double>(color[i]));
}

template <class T>
void add(Hasher& hasher, const ImVector<T>& items) {
    hasher.bytes(items.Data, static_cast<std::size_t>(items.Size) * sizeof(T));
}

}  // namespace

std::uint64_t hash_draw_data(const ImDrawData& data) {
    Hasher hasher;
    hasher.f64(static_cast<double>(data.DisplaySize.x));
    hasher.f64(static_cast<double>(data.DisplaySize.y));
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        add(hasher, list.VtxBuffer);
        add(hasher, list.IdxBuffer);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            for (const float edge :
                 {command.ClipRect.x, command.ClipRect.y, command.ClipRect.z, command.ClipRect.w})
                hasher.f64(static_cast<double>(edge));
            hasher.u64(command.ElemCount);
            hasher.u64(command.VtxOffset);
            hasher.u64(ui::texture_key(command));
        }
    }
    return hasher.value();
}

void hash_camera(Hasher& hasher, const Camera& camera) {
    add(hasher, camera.eye);
    add(hasher, camera.target);
    for (const double number : {camera.fov_y, camera.near_plane, camera.far_plane, camera.ortho_height})
        hasher.f64(number);
    hasher.u64(camera.orthographic);
}

void hash_style(Hasher& hasher, const LevelStyle& style) {
    hasher.u64(style.textured);
    hasher.u64(style.baked_light);
    hasher.f64(static_cast<double>(style.overlay));
    hasher.u64(style.wireframe);
    hasher.u64(static_cast<std::uint64_t>(style.colors));
    hasher.f64(style.max_slope);
    hasher.u64(style.back_faces);
    add(hasher, style.background_top);
    add(hasher, style.background_bottom);
}

void hash_overlay(Hasher& hasher, const Overlay& overlay) {
    for (const Overlay::Line& line : overlay.lines) {
        add(hasher, line.a);
        add(hasher, line.b);
        add(hasher, line.color);
        hasher.f64(static_cast<double>(line.width));
        hasher.u64(line.on_top);
    }
    hasher.u64(overlay.lines.size());
    for (const Overlay::Ellipsoid& ellipsoid : overlay.ellipsoids) {
        add(hasher, ellipsoid.centre);
        add(hasher, ellipsoid.radii);
        add(hasher, ellipsoid.fill);
        add(hasher, ellipsoid.outline);
    }
    hasher.u64(overlay.ellipsoids.size());
    for (const Overlay::Triangle& triangle : overlay.triangles) {
        add(hasher, triangle.a);
        add(hasher, triangle.b);
        add(hasher, triangle.c);
        add(hasher, triangle.color);
    }
}

}  // namespace slipface
