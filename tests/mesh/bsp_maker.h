// Quake 3 maps, made byte by byte.
#pragma once

#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "slipface/base/types.h"

namespace slipface::bsp_maker {

inline std::string u32(std::uint32_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text.push_back(static_cast<char>(value >> (8 * i)));
    return text;
}
inline std::string i32(int value) {
    return u32(static_cast<std::uint32_t>(value));
}
inline std::string f32(double value) {
    return u32(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}
inline std::string vec3(const Vec3& v) {
    return f32(v.x()) + f32(v.y()) + f32(v.z());
}

inline std::string vertex(const Vec3& at) {
    std::string record = vec3(at) + f32(at.x()) + f32(at.y());
    record.resize(44, '\0');
    return record;
}

inline std::string face(std::uint32_t texture, std::uint32_t kind, std::uint32_t first, std::uint32_t count,
                        std::uint32_t first_index = 0, std::uint32_t indices = 0, std::uint32_t width = 0,
                        std::uint32_t height = 0) {
    std::string record =
        u32(texture) + u32(0) + u32(kind) + u32(first) + u32(count) + u32(first_index) + u32(indices);
    record.resize(96, '\0');
    return record + u32(width) + u32(height);
}

struct Box {
    Vec3 min, max;
    bool contains(const Vec3& p) const {
        return (p.array() > min.array()).all() && (p.array() < max.array()).all();
    }
};

struct Map {
    std::string entities, textures, planes, nodes, leaves, models, brushes, sides, vertices, indices, faces;

    std::uint32_t add_texture(std::string name, std::uint32_t flags, std::uint32_t contents) {
        name.resize(64, '\0');
        textures += name + u32(flags) + u32(contents);
        return static_cast<std::uint32_t>(textures.size() / 72 - 1);
    }
    std::uint32_t add_plane(const Vec3& normal, double distance) {
        planes += vec3(normal) + f32(distance);
        return static_cast<std::uint32_t>(planes.size() / 16 - 1);
    }
    // A brush bounded by planes, each a normal and a distance.
    void add_brush(const std::vector<std::pair<Vec3, double>>& bounds, std::uint32_t texture) {
        brushes += u32(static_cast<std::uint32_t>(sides.size() / 8)) +
                   u32(static_cast<std::uint32_t>(bounds.size())) + u32(texture);
        for (const auto& [normal, distance] : bounds)
            sides += u32(add_plane(normal, distance)) + u32(texture);
    }
    void add_box(const Box& box, std::uint32_t texture) {
        std::vector<std::pair<Vec3, double>> bounds;
        for (int axis = 0; axis < 3; ++axis) {
            bounds.emplace_back(-Vec3::Unit(axis), -box.min[axis]);
            bounds.emplace_back(Vec3::Unit(axis), box.max[axis]);
        }
        add_brush(bounds, texture);
    }
    // A drawn polygon of kind 1, its corners clockwise seen from the front as Quake has them, cut into a fan.
    void add_polygon(const std::vector<Vec3>& corners, std::uint32_t texture) {
        const auto first = static_cast<std::uint32_t>(vertices.size() / 44);
        const auto first_index = static_cast<std::uint32_t>(indices.size() / 4);
        for (const Vec3& corner : corners)
            vertices += vertex(corner);
        for (std::uint32_t i = 2; i < corners.size(); ++i)
            indices += u32(0) + u32(i - 1) + u32(i);
        const auto count = static_cast<std::uint32_t>(corners.size());
        faces += face(texture, 1, first, count, first_index, 3 * (count - 2));
    }
    // All brushes and faces that are there.
    void add_world() {
        models = std::string(24, '\0') + u32(0) + u32(static_cast<std::uint32_t>(faces.size() / 104)) +
                 u32(0) + u32(static_cast<std::uint32_t>(brushes.size() / 12));
    }
    void add_leaf(int cluster) {
        std::string record = i32(cluster);
        record.resize(48, '\0');
        leaves += record;
    }
    void add_node(std::uint32_t plane, int front, int back) {
        std::string record = u32(plane) + i32(front) + i32(back);
        record.resize(36, '\0');
        nodes += record;
    }

    std::string bytes() const {
        std::string header = "IBSP" + u32(46);
        std::string data;
        const std::string* lumps[17] = {&entities, &textures, &planes,  &nodes,  &leaves,   nullptr,
                                        nullptr,   &models,   &brushes, &sides,  &vertices, &indices,
                                        nullptr,   &faces,    nullptr,  nullptr, nullptr};
        for (const std::string* lump : lumps) {
            header += u32(static_cast<std::uint32_t>(144 + data.size())) +
                      u32(static_cast<std::uint32_t>(lump != nullptr ? lump->size() : 0));
            if (lump != nullptr) data += *lump;
        }
        return header + data;
    }
};

// Six brushes around `inside`, `thickness` thick.
inline void add_shell(Map& map, const Box& inside, double thickness, std::uint32_t texture) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool high : {false, true}) {
            Box wall{inside.min - Vec3::Constant(thickness), inside.max + Vec3::Constant(thickness)};
            (high ? wall.min : wall.max)[axis] = (high ? inside.max : inside.min)[axis];
            map.add_box(wall, texture);
        }
    }
}

// The tree of a sealed room: leaf 0 is inside, leaf 1 solid.
inline void add_room_tree(Map& map, const Box& inside) {
    map.add_leaf(0);
    map.add_leaf(-1);
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const bool high = side % 2 != 0;
        const std::uint32_t plane = map.add_plane(Vec3::Unit(axis), (high ? inside.max : inside.min)[axis]);
        const int next = side == 5 ? -1 : side + 1;
        map.add_node(plane, high ? -2 : next, high ? next : -2);
    }
}

}  // namespace slipface::bsp_maker
